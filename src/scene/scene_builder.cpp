#include <algorithm>
#include <limits>
#include <memory>

#include "base/checks.h"
#include "base/free_memory.h"
#include "base/lazy.h"
#include "detectors/catalogue.h"
#include "scene/assembly.h"
#include "scene/ground.h"
#include "scene/organ_areas.h"
#include "scene/overlap/covered.h"
#include "scene/scene.h"
#include "scene/scene_checks.h"
#include "scene/scene_draft.h"

namespace quasimc {
namespace {

/// Checks that concern all organs together.
void check_whole(const SceneDraft& draft, const Bounds& bounds, Faults& faults) {
    if (draft.organs.empty()) {
        faults.add({"scene", "there are no organs", "light falls on organs", "add one"});
    }
    constexpr std::size_t kMostTriangles = std::numeric_limits<std::uint32_t>::max() - 1;
    if (draft.triangle_count() > kMostTriangles) {
        faults.add({"scene", "there are more than 4294967294 triangles", "", "divide it"});
    }
    constexpr double kSmallestSize = 1 / kLargestCoordinate;
    if (!bounds.empty() && !(bounds.radius() > kSmallestSize)) {
        faults.add(
            {"scene", "all corners lie in one point", "such a scene has no size",
             "check the coordinates"});
    }
}

}  // namespace

SceneBuilder::SceneBuilder(std::vector<Band> bands, Orientation orientation)
    : bands_(std::move(bands)), orientation_(orientation), draft_(std::make_unique<SceneDraft>()) {}

SceneBuilder::SceneBuilder(const SceneBuilder& other)
    : bands_(other.bands_),
      orientation_(other.orientation_),
      length_unit_(other.length_unit_),
      materials_(other.materials_),
      draft_(std::make_unique<SceneDraft>(*other.draft_)),
      ground_(other.ground_),
      detectors_(other.detectors_),
      cell_(other.cell_) {}

SceneBuilder& SceneBuilder::operator=(const SceneBuilder& other) {
    return *this = SceneBuilder(other);
}

SceneBuilder::SceneBuilder(SceneBuilder&& other) noexcept = default;
SceneBuilder& SceneBuilder::operator=(SceneBuilder&& other) noexcept = default;
SceneBuilder::~SceneBuilder() = default;

void SceneBuilder::set_length_unit(std::string unit) {
    length_unit_ = std::move(unit);
}

void SceneBuilder::add_material(MaterialSpec material, std::string place) {
    materials_.emplace_back(std::move(material), std::move(place));
}

void SceneBuilder::add_organ(OrganSpec organ) {
    draft_->add(std::move(organ));
}

void SceneBuilder::set_ground(GroundSpec ground) {
    ground_ = std::move(ground);
}

void SceneBuilder::add_detector(DetectorSpec detector) {
    detectors_.push_back(std::move(detector));
}

void SceneBuilder::set_cell(const Cell& cell) {
    cell_ = cell;
}

std::vector<std::int64_t> SceneBuilder::organ_ids() const {
    return quasimc::organ_ids(*draft_);
}

void SceneBuilder::check_organs(const std::vector<OrganSpec>& organs) const {
    SceneDraft draft;
    for (const OrganSpec& organ : organs) {
        draft.add(organ);
    }
    Faults faults;
    OrganFaults organ_faults(faults);
    static_cast<void>(number_organs(draft, organ_faults));
    turn_inward(draft, orientation_);
    static_cast<void>(check_triangles(draft, 0, orientation_, organ_faults));
    check_fields_of_view(draft, materials_, organ_faults);
    organ_faults.finish();
    static_cast<void>(resolve_materials(materials_, draft, bands_.size(), faults));
    faults.throw_if_any();
}

Scene SceneBuilder::build() && {
    Scene scene = std::move(*this).build_after(nullptr);
    give_back_free_memory(scene.organs_.size());
    return scene;
}

Scene SceneBuilder::build_after(KnownOverlaps* known) && {
    SceneDraft& draft = *draft_;
    Faults faults;
    OrganFaults organ_faults(faults);
    check_bands(bands_, faults);
    check_north(orientation_, faults);

    const std::int64_t free_id = number_organs(draft, organ_faults);
    turn_inward(draft, orientation_);
    Bounds bounds = check_triangles(draft, 0, orientation_, organ_faults);
    const std::size_t before = faults.size();
    check_cell(cell_, bounds, faults);
    if (ground_) {
        if (!ground_->triangles.empty()) {
            for (Vec3& corner : ground_->triangles.vertices) {
                corner = orientation_.inward(corner);
            }
        }
        OrganSpec ground = make_ground_organ(std::move(*ground_), cell_, bounds, faults);
        ground.id = free_id;
        draft.add(std::move(ground));
        if (faults.size() == before) {
            const std::size_t last = draft.organs.size() - 1;
            bounds.include(check_triangles(draft, last, orientation_, organ_faults));
        }
    }
    if (faults.size() == before) {
        check_images(cell_, draft, bounds, faults);
    }
    check_fields_of_view(draft, materials_, organ_faults);
    organ_faults.finish();
    check_whole(draft, bounds, faults);
    const std::vector<MaterialId> materials =
        resolve_materials(materials_, draft, bands_.size(), faults);
    detectors_ = check_detectors(std::move(detectors_), faults);
    faults.throw_if_any();

    Scene scene;
    for (const auto& [material, place] : materials_) {
        scene.materials_.push_back(make_material(material, bands_.size()));
    }
    DraftAssembly assembly = assemble(std::move(draft), materials);
    CutGeometry cut = cut_covered(assembly, cell_, scene.materials_, known);
    scene.geometry_ = std::move(cut.geometry);
    scene.coincidences_ = std::make_shared<const Coincidences>(std::move(cut.coincidences));
    scene.organs_ = std::move(assembly.organs);
    scene.regions_ = std::move(assembly.regions);
    scene.triangle_regions_ =
        std::make_shared<const std::vector<RegionIndex>>(std::move(assembly.triangle_regions));
    scene.instance_regions_ = std::move(assembly.instance_regions);
    scene.areas_ = std::make_shared<const Lazy<OrganAreas>>();
    scene.organs_.back().is_ground = ground_.has_value();
    scene.bands_ = std::move(bands_);
    scene.detectors_ = std::move(detectors_);
    scene.cell_ = cell_;
    scene.bounds_ = bounds;
    scene.orientation_ = orientation_;
    scene.length_unit_ = std::move(length_unit_);
    return scene;
}

bool SceneBuilder::can_build_on(const Scene& scene) const {
    const std::vector<Material>& known = scene.materials();
    return bands_ == scene.bands() && materials_.size() == known.size() &&
           std::equal(
               materials_.begin(), materials_.end(), known.begin(),
               [](const auto& stated, const Material& of_scene) {
                   const MaterialSpec& material = stated.first;
                   return material.name == of_scene.name() &&
                          passes_everything(material) == of_scene.is_transparent();
               });
}

Scene SceneBuilder::build_on(const Scene& scene) && {
    EXPECT(can_build_on(scene));
    Faults faults;
    for (const auto& [material, place] : materials_) {
        check_material(material, bands_.size(), place_of(material, place), faults);
    }
    detectors_ = check_detectors(std::move(detectors_), faults);
    faults.throw_if_any();
    Scene other = scene;
    other.materials_.clear();
    for (const auto& [material, place] : materials_) {
        other.materials_.push_back(make_material(material, bands_.size()));
    }
    other.detectors_ = std::move(detectors_);
    other.length_unit_ = std::move(length_unit_);
    return other;
}

}  // namespace quasimc

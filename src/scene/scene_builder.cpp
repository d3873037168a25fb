#include <algorithm>
#include <limits>
#include <memory>

#include "base/checks.h"
#include "base/free_memory.h"
#include "base/lazy.h"
#include "detectors/catalogue.h"
#include "scene/assembly.h"
#include "scene/build_scene.h"
#include "scene/ground.h"
#include "scene/organ_areas.h"
#include "scene/overlap/covered.h"
#include "scene/scene.h"
#include "scene/scene_checks.h"
#include "scene/scene_draft.h"
#include "scene/sensors.h"

namespace quasimc {
namespace {

/// Checks that concern all organs together.
void check_whole(const SceneDraft& draft, const Bounds& bounds, Faults& faults) {
    if (draft.organs.empty()) {
        faults.add({"scene", "there are no organs", "results are computed for organs", "add one"});
    }
    constexpr std::size_t kMaxTriangles = std::numeric_limits<std::uint32_t>::max() - 1;
    if (draft.triangle_count() > kMaxTriangles) {
        faults.add({"scene", "there are more than 4294967294 triangles", "", "divide it"});
    }
    constexpr double kSmallestSize = 1 / kLargestCoordinate;
    if (!bounds.empty() && !(bounds.radius() > kSmallestSize)) {
        faults.add(
            {"scene", "all corners are one point", "the scene has no size",
             "check the coordinates"});
    }
}

std::vector<Material> make_materials(const BuilderData& given) {
    std::vector<Material> materials;
    for (const auto& [material, where] : given.materials) {
        materials.push_back(make_material(material, given.bands.size()));
    }
    return materials;
}

}  // namespace

SceneBuilder::SceneBuilder(std::vector<Band> bands, Orientation orientation)
    : data_(std::make_unique<BuilderData>()) {
    data_->bands = std::move(bands);
    data_->orientation = orientation;
}

SceneBuilder::SceneBuilder(const SceneBuilder& other)
    : data_(std::make_unique<BuilderData>(*other.data_)) {}

SceneBuilder& SceneBuilder::operator=(const SceneBuilder& other) {
    return *this = SceneBuilder(other);
}

SceneBuilder::SceneBuilder(SceneBuilder&& other) noexcept = default;
SceneBuilder& SceneBuilder::operator=(SceneBuilder&& other) noexcept = default;
SceneBuilder::~SceneBuilder() = default;

void SceneBuilder::set_length_unit(std::string unit) {
    data_->length_unit = std::move(unit);
}

void SceneBuilder::add_material(MaterialSpec material, std::string where) {
    data_->materials.emplace_back(std::move(material), std::move(where));
}

void SceneBuilder::add_organ(OrganSpec organ) {
    data_->draft.add(std::move(organ));
}

void SceneBuilder::set_ground(GroundSpec ground) {
    data_->ground = std::move(ground);
}

void SceneBuilder::add_detector(DetectorSpec detector) {
    data_->detectors.push_back(std::move(detector));
}

void SceneBuilder::add_sensors(SensorSet sensors) {
    data_->sensors.push_back(std::move(sensors));
}

void SceneBuilder::set_cell(const Cell& cell) {
    data_->cell = cell;
}

std::vector<std::int64_t> SceneBuilder::organ_ids() const {
    return quasimc::organ_ids(data_->draft);
}

void SceneBuilder::check_organs(const std::vector<OrganSpec>& organs) const {
    SceneDraft draft;
    for (const OrganSpec& organ : organs) {
        draft.add(organ);
    }
    Faults faults;
    OrganFaults organ_faults(faults);
    static_cast<void>(number_organs(draft, organ_faults));
    turn_inward(draft, data_->orientation);
    static_cast<void>(check_triangles(draft, 0, data_->orientation, organ_faults));
    check_fields_of_view(draft, data_->materials, organ_faults);
    organ_faults.finish();
    static_cast<void>(resolve_materials(data_->materials, draft, data_->bands.size(), faults));
    faults.throw_if_any();
}

Scene SceneBuilder::build() const& {
    return SceneBuilder(*this).build();
}

Scene SceneBuilder::build() && {
    Scene scene = SceneAccess::build(std::move(*data_), nullptr);
    give_back_free_memory(scene.organs().size());
    return scene;
}

Scene build_after(SceneBuilder builder, KnownOverlaps* known) {
    return SceneAccess::build(std::move(SceneAccess::data(builder)), known);
}

bool can_build_on(const SceneBuilder& builder, const Scene& scene) {
    const BuilderData& given = SceneAccess::data(builder);
    const std::vector<Material>& known = data_of(scene).materials;
    return given.bands == scene.bands() &&
           std::equal(
               given.materials.begin(), given.materials.end(), known.begin(), known.end(),
               [](const auto& of_builder, const Material& of_scene) {
                   const MaterialSpec& material = of_builder.first;
                   return material.name == of_scene.name() &&
                          passes_everything(material) == of_scene.is_transparent();
               });
}

Scene build_on(const SceneBuilder& builder, const Scene& scene) {
    EXPECT(can_build_on(builder, scene));
    return SceneAccess::build_on(SceneAccess::data(builder), scene);
}

Scene SceneAccess::build(BuilderData given, KnownOverlaps* known) {
    SceneDraft& draft = given.draft;
    Faults faults;
    OrganFaults organ_faults(faults);
    check_bands(given.bands, faults);
    check_north(given.orientation, faults);

    const std::int64_t free_id = number_organs(draft, organ_faults);
    turn_inward(draft, given.orientation);
    Bounds bounds = check_triangles(draft, 0, given.orientation, organ_faults);
    const std::size_t before = faults.size();
    check_cell(given.cell, bounds, faults);
    if (given.ground) {
        for (Vec3& corner : given.ground->triangles.vertices) {
            corner = given.orientation.inward(corner);
        }
        OrganSpec ground = make_ground_organ(std::move(*given.ground), given.cell, bounds, faults);
        ground.id = free_id;
        draft.add(std::move(ground));
        if (faults.size() == before) {
            const std::size_t last = draft.organs.size() - 1;
            bounds.include(check_triangles(draft, last, given.orientation, organ_faults));
        }
    }
    if (faults.size() == before) {
        check_images(given.cell, draft, bounds, faults);
    }
    check_fields_of_view(draft, given.materials, organ_faults);
    organ_faults.finish();
    check_whole(draft, bounds, faults);
    const std::vector<MaterialId> materials =
        resolve_materials(given.materials, draft, given.bands.size(), faults);
    given.detectors = check_detectors(std::move(given.detectors), faults);
    given.sensors = check_sensors(std::move(given.sensors), given.orientation, faults);
    faults.throw_if_any();
    return assembled(std::move(given), materials, bounds, known);
}

Scene SceneAccess::assembled(
    BuilderData given,
    const std::vector<MaterialId>& materials,
    const Bounds& bounds,
    KnownOverlaps* known) {
    SceneData data;
    data.materials = make_materials(given);
    DraftAssembly assembly = assemble(std::move(given.draft), materials);
    CutGeometry cut = cut_covered(assembly, given.cell, data.materials, known);
    data.geometry = std::move(cut.geometry);
    data.coincidences = std::make_shared<const Coincidences>(std::move(cut.coincidences));
    data.triangle_regions =
        std::make_shared<const std::vector<RegionIndex>>(std::move(assembly.triangle_regions));
    data.instance_regions = std::move(assembly.instance_regions);
    data.areas = std::make_shared<const Lazy<OrganAreas>>();
    assembly.organs.back().is_ground = given.ground.has_value();

    Scene scene;
    scene.names_ =
        std::make_shared<const SceneNames>(std::move(given.bands), std::move(assembly.organs));
    scene.data_ = std::make_shared<const SceneData>(std::move(data));
    scene.regions_ = std::move(assembly.regions);
    scene.detectors_ = std::move(given.detectors);
    scene.sensors_ = std::make_shared<const std::vector<SensorSet>>(std::move(given.sensors));
    scene.cell_ = given.cell;
    scene.bounds_ = bounds;
    scene.orientation_ = given.orientation;
    scene.length_unit_ = std::move(given.length_unit);
    return scene;
}

Scene SceneAccess::build_on(const BuilderData& given, const Scene& scene) {
    Faults faults;
    for (const auto& [material, where] : given.materials) {
        check_material(material, given.bands.size(), location_of(material, where), faults);
    }
    std::vector<DetectorSpec> detectors = check_detectors(given.detectors, faults);
    std::vector<SensorSet> sensors = check_sensors(given.sensors, given.orientation, faults);
    faults.throw_if_any();
    SceneData data = data_of(scene);
    data.materials = make_materials(given);
    Scene other = scene;
    other.data_ = std::make_shared<const SceneData>(std::move(data));
    other.detectors_ = std::move(detectors);
    other.sensors_ = std::make_shared<const std::vector<SensorSet>>(std::move(sensors));
    other.length_unit_ = given.length_unit;
    return other;
}

}  // namespace quasimc

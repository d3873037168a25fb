#include "scene/scene_builder.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>

#include "scene/ground.h"
#include "scene/scene_checks.h"

namespace quasimc {
namespace {

void extend(Bounds& bounds, const Bounds& by) {
    if (!by.empty()) {
        bounds.add(by.low);
        bounds.add(by.high);
    }
}

std::size_t count_triangles(std::span<const OrganSpec> organs) {
    std::size_t count = 0;
    for (const OrganSpec& organ : organs) {
        for (const OrganPart& part : organ.parts) {
            count += part.triangles.size();
        }
    }
    return count;
}

/// Checks that concern all organs together.
void check_whole(std::span<const OrganSpec> organs, const Bounds& bounds, Faults& faults) {
    if (organs.empty()) {
        faults.add({"scene", "there are no organs", "light falls on organs", "add one"});
    }
    constexpr std::size_t kMostTriangles = std::numeric_limits<std::uint32_t>::max() - 1;
    if (count_triangles(organs) > kMostTriangles) {
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

/// Moves checked organs, their triangles z up, into a scene.
class SceneBuilder::Assembly {
  public:
    Assembly(Scene& scene, std::size_t triangles)
        : scene_(scene), region_of_(scene.materials_.size(), kNone) {
        scene_.triangles_->reserve(triangles);
        scene_.triangle_regions_.reserve(triangles);
    }

    /// @param materials  of each part
    void append(OrganSpec spec, std::span<const MaterialId> materials) {
        Organ organ;
        organ.id = *spec.id;
        organ.name = std::move(spec.name);
        organ.labels = std::move(spec.labels);
        organ.measured = spec.measured;
        organ.least_cosine = least_cosine(spec.field_of_view_deg);
        organ.first_region = static_cast<std::uint32_t>(scene_.regions_.size());
        organ.first_triangle = static_cast<std::uint32_t>(scene_.triangles_->size());
        for (const std::uint32_t part : add_regions(spec, materials)) {
            append_part(std::move(spec.parts[part].triangles), region_of_[materials[part].value]);
        }
        for (const MaterialId material : materials) {
            region_of_[material.value] = kNone;
        }
        const std::size_t regions = scene_.regions_.size();
        organ.region_count = static_cast<std::uint32_t>(regions) - organ.first_region;
        organ.triangle_count =
            static_cast<std::uint32_t>(scene_.triangles_->size()) - organ.first_triangle;
        for (std::size_t e = organ.first_region; e < regions; ++e) {
            organ.area += scene_.regions_[e].area;
        }
        scene_.organs_.push_back(std::move(organ));
    }

  private:
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    /// Adds an element for each material of the organ's parts that have triangles. Returns these
    /// parts, those of one element together.
    std::vector<std::uint32_t> add_regions(
        const OrganSpec& spec, std::span<const MaterialId> materials) {
        const OrganIndex organ{static_cast<std::uint32_t>(scene_.organs_.size())};
        std::vector<std::uint32_t> parts;
        for (std::uint32_t i = 0; i < spec.parts.size(); ++i) {
            if (spec.parts[i].triangles.empty()) {
                continue;
            }
            parts.push_back(i);
            std::uint32_t& region = region_of_[materials[i].value];
            if (region == kNone) {
                region = static_cast<std::uint32_t>(scene_.regions_.size());
                scene_.regions_.push_back({organ, materials[i], 0});
            }
        }
        std::stable_sort(parts.begin(), parts.end(), [&](std::uint32_t a, std::uint32_t b) {
            return region_of_[materials[a].value] < region_of_[materials[b].value];
        });
        return parts;
    }

    void append_part(std::vector<Triangle> triangles, std::uint32_t region) {
        scene_.regions_[region].area += area(triangles);
        scene_.triangle_regions_.insert(
            scene_.triangle_regions_.end(), triangles.size(), RegionIndex{region});
        if (scene_.triangles_->empty() && triangles.size() == scene_.triangles_->capacity()) {
            *scene_.triangles_ = std::move(triangles);  // a scene of one mesh is not copied
        } else {
            scene_.triangles_->insert(scene_.triangles_->end(), triangles.begin(), triangles.end());
        }
    }

    Scene& scene_;
    std::vector<std::uint32_t> region_of_;  // of the organ at hand, for each material
};

SceneBuilder::SceneBuilder(std::vector<Band> bands, Orientation orientation)
    : bands_(std::move(bands)), orientation_(orientation) {}

void SceneBuilder::set_length_unit(std::string unit) {
    length_unit_ = std::move(unit);
}

void SceneBuilder::add_material(MaterialSpec material, std::string place) {
    materials_.emplace_back(std::move(material), std::move(place));
}

void SceneBuilder::add_organ(OrganSpec organ) {
    organs_.push_back(std::move(organ));
}

void SceneBuilder::set_ground(GroundSpec ground) {
    ground_ = std::move(ground);
}

void SceneBuilder::set_cell(const Cell& cell) {
    cell_ = cell;
}

Scene SceneBuilder::build() && {
    Faults faults;
    OrganFaults organ_faults(faults);
    check_bands(bands_, faults);
    check_north(orientation_, faults);

    const std::int64_t free_id = number_organs(organs_, organ_faults);
    Bounds bounds;
    for (OrganSpec& organ : organs_) {
        extend(bounds, take_inward(organ, orientation_, organ_faults));
    }
    const std::size_t before = faults.size();
    check_cell(cell_, bounds, faults);
    if (ground_) {
        const bool is_given = !ground_->triangles.empty();
        organs_.push_back(make_ground_organ(std::move(*ground_), cell_, bounds, faults));
        organs_.back().id = free_id;
        if (faults.size() == before) {
            const Orientation axes = is_given ? orientation_ : Orientation();
            extend(bounds, take_inward(organs_.back(), axes, organ_faults));
        }
    }
    if (faults.size() == before) {
        check_images(cell_, organs_, faults);
    }
    check_fields_of_view(organs_, materials_, organ_faults);
    organ_faults.finish();
    check_whole(organs_, bounds, faults);
    const std::vector<MaterialId> part_materials =
        resolve_materials(materials_, organs_, bands_.size(), faults);
    faults.throw_if_any();

    Scene scene;
    for (const auto& [material, place] : materials_) {
        scene.materials_.push_back(make_material(material, bands_.size()));
    }
    Assembly assembly(scene, count_triangles(organs_));
    std::size_t first_part = 0;
    for (OrganSpec& organ : organs_) {
        const std::size_t parts = organ.parts.size();
        assembly.append(std::move(organ), std::span(part_materials).subspan(first_part, parts));
        first_part += parts;
    }
    scene.organs_.back().is_ground = ground_.has_value();
    scene.bands_ = std::move(bands_);
    scene.cell_ = cell_;
    scene.bounds_ = bounds;
    scene.orientation_ = orientation_;
    scene.length_unit_ = std::move(length_unit_);
    return scene;
}

}  // namespace quasimc

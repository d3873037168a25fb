#include "scene/lint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <unordered_map>

#include <fmt/format.h>

#include "base/length_units.h"
#include "scene/scene.h"

namespace quasimc {
namespace {

/// @param instances  bounds of each instance
Bounds bounds_of(const Scene& scene, const Organ& organ, const std::vector<Bounds>& instances) {
    const SceneGeometry& triangles = data_of(scene).triangles();
    const std::size_t end = organ.first_triangle + organ.triangle_count;
    Bounds bounds;
    for (std::size_t i = organ.first_triangle; i < end;) {
        if (i >= triangles.mesh().size()) {
            const std::uint32_t k = triangles.ranges().find(static_cast<std::uint32_t>(i));
            bounds.include(instances[k]);
            i += triangles.ranges().count(k);
            continue;
        }
        for (const Vec3& corner : triangles[i]) {
            bounds.add(corner);
        }
        ++i;
    }
    return bounds;
}

bool is_black(const Material& material) {
    const auto all_zero = [](std::span<const double> albedo) {
        return std::all_of(albedo.begin(), albedo.end(), [](double a) { return a == 0; });
    };
    return all_zero(material.side(SurfaceSide::upper).albedo()) &&
           all_zero(material.side(SurfaceSide::lower).albedo());
}

}  // namespace

Survey survey_of(const Scene& scene) {
    Survey survey{scene, {}, {}};
    survey.organ_bounds.reserve(scene.organs().size());
    const std::vector<Bounds> instances = instance_bounds(data_of(scene).triangles().instances());
    for (const Organ& organ : scene.organs()) {
        const Bounds bounds = bounds_of(scene, organ, instances);
        survey.organ_bounds.push_back(bounds);
        if (!organ.is_ground) {
            survey.canopy.include(bounds);
        }
    }
    return survey;
}

double median_size(const Survey& survey) {
    std::vector<double> sizes;
    for (std::size_t i = 0; i < survey.organ_bounds.size(); ++i) {
        if (!survey.scene.organs()[i].is_ground) {
            sizes.push_back(2 * survey.organ_bounds[i].radius());
        }
    }
    if (sizes.empty()) {
        return 0;
    }
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    return *middle;
}

std::vector<Warning> lint_unit(const Survey& survey) {
    const std::string& unit = survey.scene.length_unit();
    const std::optional<double> metres = metres_per(unit);
    const double size = median_size(survey);
    if (!metres || size == 0) {
        return {};
    }
    const auto doubt = [&](std::string_view what, double value, std::string_view how) {
        const std::string in_metres = fmt::format(", {:.4g} m", value * *metres);
        return std::vector<Warning>{
            {"length_unit", fmt::format(
                                "{} {:.4g} {}{} {}: is length_unit = \"{}\" right?", what, value,
                                unit, unit == "m" ? "" : in_metres, how, unit)}};
    };
    constexpr double kSmallestOrgan = 10e-6, kLargestOrgan = 50;
    if (size * *metres < kSmallestOrgan || size * *metres > kLargestOrgan) {
        return doubt("the median organ is", size, "large");
    }
    constexpr double kTallestPlant = 130;  // a sequoia is 116 m tall
    const double height = survey.canopy.size().z;
    const Organ* ground = ground_of(survey.scene);
    const bool is_level = ground == nullptr || survey.organ_bounds.back().size().z == 0;
    if (is_level && height * *metres > kTallestPlant) {
        return doubt("the organs are within", height, "of height");
    }
    return {};
}

const Organ* ground_of(const Scene& scene) {
    const Organ& last = scene.organs().back();
    return last.is_ground ? &last : nullptr;
}

std::string describe_organ(const Organ& organ) {
    return fmt::format("organ '{}' (id {})", organ.name, organ.id);
}

double part_of_scene(const Survey& survey, std::size_t organ) {
    const Cell& cell = survey.scene.cell();
    Vec3 size = survey.scene.bounds().size();
    size.x = cell.along_x ? cell.size_x : size.x;
    size.y = cell.along_y ? cell.size_y : size.y;
    return 2 * survey.organ_bounds[organ].radius() / length(size);
}

void WarningKind::add(std::string where, std::string text) {
    if (++count_ <= kMaxNamed) {
        named_.push_back({std::move(where), std::move(text)});
    }
}

std::vector<Warning> WarningKind::finish() && {
    if (count_ > kMaxNamed) {
        const std::size_t more = count_ - kMaxNamed;
        named_.push_back({"scene", fmt::format("{} more {}", more, more == 1 ? one_ : many_)});
    }
    return std::move(named_);
}

bool is_degenerate(const Triangle& t) {
    const double longest =
        std::max({length(t[1] - t[0]), length(t[2] - t[1]), length(t[0] - t[2])});
    constexpr double kFlat = 1e-10;
    return area(t) <= kFlat * longest * longest;
}

std::vector<Warning> lint_sizes(const Survey& survey) {
    const Scene& scene = survey.scene;
    WarningKind blurred(
        "organ is too small compared with the scene",
        "organs are too small compared with the scene");
    for (std::size_t i = 0; i < scene.organs().size(); ++i) {
        const double part = part_of_scene(survey, i);
        if (part > 0 && part < kSmallestPart) {
            blurred.add(
                describe_organ(scene.organs()[i]),
                fmt::format(
                    "is {:.1g} times as large as the scene, and rounding changes its shape: do all "
                    "coordinates have the same unit?",
                    part));
        }
    }
    return std::move(blurred).finish();
}

std::vector<Warning> lint_materials(const Survey& survey) {
    const Scene& scene = survey.scene;
    const std::vector<bool> is_used = used_materials(scene);
    WarningKind black("material is black in every band", "materials are black in every band");
    for (std::size_t i = 0; i < is_used.size(); ++i) {
        const Material& material = data_of(scene).materials[i];
        if (is_used[i] && is_black(material)) {
            black.add(
                fmt::format("material '{}'", material.name()),
                "is black in every band (silent if 0 is written)");
        }
    }
    return std::move(black).finish();
}

namespace {

/// Counts the triangles of zero area. A mesh with many instances is examined once.
class DegenerateCount {
  public:
    explicit DegenerateCount(const Scene& scene) : triangles_(data_of(scene).triangles()) {}

    std::size_t count(const Organ& organ) {
        const std::size_t end = organ.first_triangle + organ.triangle_count;
        std::size_t count = 0;
        for (std::size_t i = organ.first_triangle; i < end;) {
            if (i < triangles_.mesh().size()) {
                count += is_degenerate(triangles_[i]) ? 1 : 0;
                ++i;
                continue;
            }
            const std::uint32_t k = triangles_.ranges().find(static_cast<std::uint32_t>(i));
            count += count_in(*triangles_.instances()[k].mesh);
            i += triangles_.ranges().count(k);
        }
        return count;
    }

  private:
    std::size_t count_in(const Mesh& mesh) {
        const auto [known, is_new] = known_.try_emplace(&mesh, 0);
        for (std::size_t i = 0; is_new && i < mesh.size(); ++i) {
            known->second += is_degenerate(mesh[i]) ? 1 : 0;
        }
        return known->second;
    }

    const SceneGeometry& triangles_;
    std::unordered_map<const Mesh*, std::size_t> known_;
};

}  // namespace

std::vector<Warning> lint_areas(const Survey& survey) {
    const Scene& scene = survey.scene;
    DegenerateCount degenerate(scene);
    WarningKind empty("organ has triangles without area", "organs have triangles without area");
    for (const Organ& organ : scene.organs()) {
        if (organ.covered_area > 0) {
            continue;  // lint_overlap reports such an organ
        }
        const std::size_t flat = degenerate.count(organ);
        if (flat == organ.triangle_count) {
            empty.add(describe_organ(organ), "has no area and receives no light");
        } else if (flat > 0) {
            empty.add(
                describe_organ(organ),
                fmt::format(
                    "{} of its {} triangles have no area and receive no light", flat,
                    organ.triangle_count));
        }
    }
    return std::move(empty).finish();
}

std::vector<LintFinding> lint_by_check(const Scene& scene) {
    struct Check {
        std::string_view name;
        std::vector<Warning> (*run)(const Survey& survey);
    };
    constexpr std::array<Check, 9> kChecks{
        {{"unit", lint_unit},
         {"sizes", lint_sizes},
         {"materials", lint_materials},
         {"cell", lint_cell},
         {"ground", lint_ground},
         {"areas", lint_areas},
         {"thin", lint_thin},
         {"overlap", lint_overlap},
         {"sensors", lint_sensors}}};
    const Survey survey = survey_of(scene);
    std::vector<LintFinding> findings;
    for (const Check& check : kChecks) {
        std::vector<Warning> found = check.run(survey);
        if (!found.empty()) {
            findings.push_back({check.name, std::move(found)});
        }
    }
    return findings;
}

namespace {

std::vector<Warning> lint_without(const Scene& scene, std::string_view omitted) {
    std::vector<Warning> all;
    for (LintFinding& finding : lint_by_check(scene)) {
        if (finding.check != omitted) {
            std::move(finding.warnings.begin(), finding.warnings.end(), std::back_inserter(all));
        }
    }
    return all;
}

}  // namespace

std::vector<Warning> lint(const Scene& scene) {
    return lint_without(scene, "");
}

std::vector<Warning> lint_geometry(const Scene& scene) {
    return lint_without(scene, "materials");
}

}  // namespace quasimc

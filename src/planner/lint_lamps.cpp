#include "planner/lint_lamps.h"

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>

#include "base/length_units.h"
#include "planner/near_lamp.h"
#include "scene/lint.h"

namespace quasimc {
namespace {

bool has_lamp(const Sources& sources) {
    return std::any_of(
        sources.begin(), sources.end(), [](const auto& source) { return source->is_lamp(); });
}

/// "the median organ is 10 m large" if plants are unlikely to have this size; otherwise "".
std::string strange_size(const Scene& scene) {
    constexpr double kLargeOrgan = 2, kSmallPlant = 5e-3;
    const std::optional<double> metres = metres_per(scene.length_unit());
    const Survey survey = survey_of(scene);
    if (!metres || survey.canopy.empty()) {
        return "";
    }
    const double organ = median_size(survey) * *metres;
    const double plant = 2 * survey.canopy.radius() * *metres;
    return organ > kLargeOrgan   ? fmt::format("the median organ is {:.3g} m large", organ)
           : plant < kSmallPlant ? fmt::format("all organs together are {:.3g} m large", plant)
                                 : "";
}

/// The centre of a lamp, searched from the centre of the scene's box or from far away on one of its
/// axes: a lamp below the ground mostly shines away from the box.
std::optional<Vec3> find_lamp(const Source& source, const Bounds& bounds) {
    constexpr std::array<Vec3, 7> kDirections{Vec3{0, 0, 0}, Vec3{0, 0, -1}, Vec3{0, 0, 1},
                                              Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0},
                                              Vec3{0, -1, 0}};
    const double far = 1000 * bounds.radius();
    for (const Vec3& direction : kDirections) {
        const Vec3 point = bounds.center() + far * direction;
        if (const std::optional<Vec3> position = position_of_lamp(source, {point, point})) {
            return position;
        }
    }
    return std::nullopt;
}

}  // namespace

std::vector<Warning> lint_lamp_unit(const Scene& scene, const Sources& sources, UnitOrigin origin) {
    if (!has_lamp(sources)) {
        return {};
    }
    const std::string size = strange_size(scene);
    if (origin == UnitOrigin::assumed) {
        return {
            {"length_unit",
             fmt::format(
                 "is missing, and metres are assumed{}; the irradiance from lamps depends on it; "
                 "set length_unit to the unit of the coordinates, \"m\" or \"cm\"",
                 size.empty() ? "" : " (" + size + ")")}};
    }
    if (size.empty()) {
        return {};
    }
    return {
        {"length_unit", fmt::format(
                            "{} if coordinates are in {}, and the irradiance from lamps depends on "
                            "it: is length_unit right?",
                            size, scene.length_unit())}};
}

std::vector<Warning> lint_lamp_positions(const Scene& scene, const Sources& sources) {
    if (ground_of(scene) == nullptr || !has_lamp(sources)) {
        return {};
    }
    const Bounds ground = survey_of(scene).organ_bounds.back();
    WarningKind below("lamp is below the ground", "lamps are below the ground");
    for (const auto& source : sources) {
        const std::optional<Vec3> position = find_lamp(*source, scene.bounds());
        if (position && ground.size().z == 0 && position->z < ground.low.z) {
            below.add(
                "source '" + source->name() + "'",
                fmt::format(
                    "is a lamp {:.3g} below the ground, which blocks its light; check its position",
                    ground.low.z - position->z));
        }
    }
    return std::move(below).finish();
}

}  // namespace quasimc

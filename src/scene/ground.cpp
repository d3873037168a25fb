#include "scene/ground.h"

#include <cmath>

#include <fmt/format.h>

#include "base/text.h"
#include "scene/scene_checks.h"

namespace quasimc {
namespace {

struct Interval {
    double low = 0, high = 0;
    [[nodiscard]] double size() const { return high - low; }
};

std::string text_of(const Interval& i) {
    return fmt::format("from {} to {}", shortest(i.low), shortest(i.high));
}

/// Bounds of a horizontal ground along one axis.
struct AxisRules {
    char axis;
    std::optional<Interval> cell;    ///< if the scene is periodic along the axis
    std::optional<Interval> given;   ///< if an extent was given
    std::optional<Interval> organs;  ///< if there are any
};

bool is_usable(double x) {
    return std::abs(x) <= kLargestCoordinate;
}

bool is_same(const Interval& a, const Interval& b) {
    const double rounding = 1e-9 * b.size();
    return std::abs(a.low - b.low) <= rounding && std::abs(a.high - b.high) <= rounding;
}

Interval extent_along(const AxisRules& rules, const std::string& where, Faults& faults) {
    const std::optional<Interval>& given = rules.given;
    if (given && !(is_usable(given->low) && is_usable(given->high) && given->size() > 0)) {
        faults.add(
            {where, fmt::format("the extent along {} is {}", rules.axis, text_of(*given)),
             "an extent is low x, low y, high x, high y, with low < high", ""});
        return {};
    }
    if (rules.cell && given && !is_same(*given, *rules.cell)) {
        faults.add(
            {where, fmt::format("the extent along {} is {}", rules.axis, text_of(*given)),
             "the scene is periodic along it " + text_of(*rules.cell),
             "remove the extent, or give the ground as triangles"});
        return {};
    }
    if (rules.cell || given) {
        return rules.cell ? *rules.cell : *given;
    }
    if (!rules.organs) {
        faults.add(
            {where, fmt::format("its size along {} is unknown", rules.axis),
             "there are no organs above it", "give its extent"});
        return {};
    }
    if (rules.organs->size() == 0) {
        faults.add(
            {where, fmt::format("its size along {} would be 0", rules.axis),
             "it extends as far as the organs", "give its extent"});
    }
    return *rules.organs;
}

std::vector<Triangle> rectangle(const Interval& x, const Interval& y, double z) {
    const Vec3 a{x.low, y.low, z};
    const Vec3 b{x.high, y.low, z};
    const Vec3 c{x.high, y.high, z};
    const Vec3 d{x.low, y.high, z};
    return {{a, b, c}, {a, c, d}};
}

std::vector<Triangle> horizontal_ground(
    const GroundSpec& ground, const Cell& cell, const Bounds& organs, Faults& faults) {
    AxisRules x{'x', {}, {}, {}};
    AxisRules y{'y', {}, {}, {}};
    if (cell.along_x) {
        x.cell = {cell.low_x, cell.low_x + cell.size_x};
    }
    if (cell.along_y) {
        y.cell = {cell.low_y, cell.low_y + cell.size_y};
    }
    if (ground.extent) {
        const auto& [low_x, low_y, high_x, high_y] = *ground.extent;
        x.given = {low_x, high_x};
        y.given = {low_y, high_y};
    }
    if (!organs.empty()) {
        x.organs = {organs.low.x, organs.high.x};
        y.organs = {organs.low.y, organs.high.y};
    }
    const Interval along_x = extent_along(x, ground.where, faults);
    const Interval along_y = extent_along(y, ground.where, faults);
    return rectangle(along_x, along_y, ground.height);
}

/// Checks that a ground with triangles has no keys of a horizontal ground.
void check_given_surface(const GroundSpec& ground, Faults& faults) {
    const std::string why = "it is given as triangles";
    if (ground.extent) {
        faults.add({ground.where, "it has an extent too", why, "remove one of them"});
    }
    if (ground.height != 0) {
        faults.add({ground.where, "it has a height too", why, "remove one of them"});
    }
}

}  // namespace

OrganSpec make_ground_organ(
    GroundSpec ground, const Cell& cell, const Bounds& organs, Faults& faults) {
    if (!ground.triangles.empty()) {
        check_given_surface(ground, faults);
    } else if (!is_usable(ground.height)) {
        faults.add(
            {ground.where, fmt::format("its height is {}", shortest(ground.height)),
             "heights must be finite", ""});
    }
    OrganSpec organ;
    organ.name = ground.name.empty() ? "ground" : ground.name;
    organ.where = ground.where;
    organ.measured = ground.measured;
    Mesh triangles = ground.triangles.empty()
                         ? Mesh(horizontal_ground(ground, cell, organs, faults))
                         : std::move(ground.triangles);
    organ.parts.push_back({std::move(ground.material), std::move(triangles)});
    return organ;
}

}  // namespace quasimc

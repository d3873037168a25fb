#include "growth/turtle/turtle_cylinder.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/function_ref.h"

namespace quasimc {

namespace {

/// A point of an axis: its derivative, the radius, and the fraction of the second contour.
struct AxisPoint {
    Vec3 position, derivative;
    double radius = 0, mix = 0;
};

using AxisCurve = FunctionRef<AxisPoint(double t)>;
using Contours = std::array<std::span<const ContourPoint>, 2>;  // of both ends, as many points

/// The points of a ring: x along its direction up, y opposite to its left.
std::vector<Vec3> ring_points(
    const Contours& contours, const AxisPoint& at, const HeadingAndUp& axes) {
    std::vector<Vec3> points;
    const Vec3 left = axes.left();
    for (std::size_t i = 0; i < contours[0].size(); ++i) {
        const ContourPoint &a = contours[0][i], &b = contours[1][i];
        const double x = a.x + at.mix * (b.x - a.x), y = a.y + at.mix * (b.y - a.y);
        points.push_back(at.position + at.radius * (x * axes.up - y * left));
    }
    return points;
}

HeadingAndUp turned_along(const HeadingAndUp& axes, const Vec3& derivative) {
    const double size = length(derivative);
    return size > 0 && std::isfinite(size) ? turned_to(axes, derivative / size) : axes;
}

/// Triangles of strips between rings along a curve, from t = 0 to 1.
CylinderStrips swept_strips(
    const AxisCurve& curve, const Contours& contours, CylinderRing ring, int strips) {
    std::vector<Triangle> triangles;
    std::vector<Vec3> before = ring_points(contours, curve(0), ring.axes);
    for (int k = 1; k <= strips; ++k) {
        const AxisPoint at = curve(static_cast<double>(k) / strips);
        ring.axes = turned_along(ring.axes, at.derivative);
        std::vector<Vec3> after = ring_points(contours, at, ring.axes);
        for (std::size_t j = 0; j + 1 < after.size(); ++j) {
            triangles.push_back({after[j], after[j + 1], before[j]});
            triangles.push_back({before[j], after[j + 1], before[j + 1]});
        }
        before = std::move(after);
    }
    return {std::move(triangles), ring};
}

/// A cubic Hermite curve between two values with their tangents.
template <typename Value>
struct HermiteCurve {
    Value from, leaving, arriving, to;

    [[nodiscard]] Value at(double t) const {
        const double u = 1 - t;
        return u * u * (1 + 2 * t) * from + u * u * t * leaving - u * t * t * arriving +
               t * t * (3 - 2 * t) * to;
    }
    [[nodiscard]] Value derivative(double t) const {
        const double u = 1 - t;
        return 6 * t * u * (to - from) + u * (1 - 3 * t) * leaving + t * (3 * t - 2) * arriving;
    }
};

/// The given tangent of a radius, or that of a linear change.
RadiusTangent radius_tangent(const RadiusTangent& given, double change) {
    return given.along == 0 && given.radius == 0 ? RadiusTangent{1, change} : given;
}

AxisPoint hermite_point(const CylinderPoint& from, const CylinderPoint& to, double t) {
    const double change = to.radius - from.radius, distance = length(to.position - from.position);
    const RadiusTangent start = radius_tangent(from.settings.radius_out, change);
    const RadiusTangent end = radius_tangent(to.settings.radius_in, change);
    const double along = HermiteCurve<double>{0, start.along, end.along, 1}.at(t);
    const HermiteCurve<Vec3> axis{
        from.position, (from.settings.tangent_out * distance) * from.axes.heading,
        (to.settings.tangent_in * distance) * to.axes.heading, to.position};
    const HermiteCurve<double> radius{from.radius, start.radius, end.radius, to.radius};
    return {axis.at(along), axis.derivative(along), radius.at(t), along};
}

AxisPoint b_spline_point(const std::array<const CylinderPoint*, 4>& points, double t) {
    const double u = 1 - t, t2 = t * t, t3 = t2 * t;
    const std::array<double, 4> values{
        u * u * u / 6, (3 * t3 - 6 * t2 + 4) / 6, (-3 * t3 + 3 * t2 + 3 * t + 1) / 6, t3 / 6};
    const std::array<double, 4> slopes{
        -u * u / 2, (3 * t2 - 4 * t) / 2, (-3 * t2 + 2 * t + 1) / 2, t2 / 2};
    AxisPoint at;
    at.mix = t;
    for (std::size_t i = 0; i < points.size(); ++i) {
        at.position += values[i] * points[i]->position;
        at.derivative += slopes[i] * points[i]->position;
        at.radius += values[i] * points[i]->radius;
    }
    return at;
}

}  // namespace

CylinderStrips CylinderMaker::segment(
    const CylinderPoint& from, const CylinderPoint& to, const CylinderRing& ring) {
    if (from.position == to.position) {
        return {{}, ring};
    }
    return swept_strips(
        [&](double t) { return hermite_point(from, to, t); },
        {outline(from, ring.sides), outline(to, ring.sides)}, ring, to.strips);
}

std::vector<Triangle> CylinderMaker::whole(
    std::span<const CylinderPoint> points, CylinderCurve curve) {
    const bool is_spline = curve >= CylinderCurve::b_spline;
    const bool is_closed =
        curve == CylinderCurve::closed_hermite || curve == CylinderCurve::closed_b_spline;
    const std::size_t count = points.size(), open_ends = is_closed ? 0 : is_spline ? 3 : 1;
    std::vector<Triangle> all;
    if (count < (is_spline ? 3U : 2U)) {
        return all;
    }
    CylinderRing ring{points[0].axes, points[0].settings.sides};
    if (is_spline) {
        ring.axes = turned_along(ring.axes, points[2].position - points[0].position);
    }
    for (std::size_t i = 0; i + open_ends < count; ++i) {
        std::array<const CylinderPoint*, 4> near{};
        for (std::size_t k = 0; k < near.size(); ++k) {
            near[k] = &points[(i + k) % count];
        }
        const CylinderStrips strips =
            is_spline ? swept_strips(
                            [&near](double t) { return b_spline_point(near, t); },
                            {outline(*near[1], ring.sides), outline(*near[2], ring.sides)}, ring,
                            near[3]->strips)
                      : segment(*near[0], *near[1], ring);
        all.insert(all.end(), strips.triangles.begin(), strips.triangles.end());
        ring = strips.ring;
    }
    return all;
}

const CylinderMaker::Outline& CylinderMaker::outline(const CylinderPoint& point, int sides) {
    const int contour = point.settings.contour;
    const auto [entry, is_new] = outlines_.try_emplace({contour, sides});
    Outline& outline = entry->second;
    if (!is_new) {
        return outline;
    }
    if (const auto found = view_.contours.find(contour); found != view_.contours.end()) {
        outline = found->second.divided(sides);
    } else if (contour != CylinderSettings::kCircle) {
        notices_.once(fmt::format("turtle: there is no contour {}; a circle is drawn", contour));
    }
    for (int k = 0; outline.size() <= static_cast<std::size_t>(sides); ++k) {
        const double theta = kFullTurn * (k % sides) / sides;
        outline.push_back({std::cos(theta), std::sin(theta)});
    }
    return outline;
}

}  // namespace quasimc

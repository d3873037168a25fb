#include "raster/projected_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

namespace quasimc {
namespace {

/// Position and extent of the scene along one coordinate.
std::pair<double, double> extent_of(const ProjectedScene& scene, const Vec3& coordinate) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    const auto add = [&](const Vec3& p) {
        const double at = dot(coordinate, p);
        low = std::min(low, at);
        high = std::max(high, at);
    };
    for (const Vec3& p : scene.outline) {
        add(p);
    }
    for (std::uint32_t i = 0; scene.outline.empty() && i < scene.mesh->triangle_count(); ++i) {
        for (int corner = 0; corner < 3; ++corner) {
            add(scene.mesh->vertex(i, corner));
        }
    }
    return {low, high - low};
}

/// Projects `v` along the beam, so that it is the coordinate where the ray through a point meets
/// the plane dot(across, p) = 0.
Vec3 sheared(const Vec3& v, const Vec3& across, const Vec3& direction) {
    return v - (dot(v, direction) / dot(across, direction)) * across;
}

}  // namespace

Barycentric ProjectedTriangle::barycentric(double at_x, double at_y) const {
    const double ax = x[1] - x[0];
    const double ay = y[1] - y[0];
    const double bx = x[2] - x[0];
    const double by = y[2] - y[0];
    const double px = at_x - x[0];
    const double py = at_y - y[0];
    const double twice_area = ax * by - ay * bx;
    return {
        static_cast<float>((px * by - py * bx) / twice_area),
        static_cast<float>((ax * py - ay * px) / twice_area)};
}

double ProjectedScene::cosine(std::uint32_t triangle, const Vec3& direction) const {
    const Vec3 up = mesh->across(triangle);
    const double size = length(up);
    return size > 0 ? dot(up, direction) / size : 0;
}

std::pair<double, double> ProjectedScene::extent(std::uint32_t triangle, const Vec3& along) const {
    const double a = dot(along, mesh->vertex(triangle, 0));
    const double b = dot(along, mesh->vertex(triangle, 1));
    const double c = dot(along, mesh->vertex(triangle, 2));
    return {std::min({a, b, c}), std::max({a, b, c})};
}

ProjectedTriangle ProjectedScene::seen(
    std::uint32_t triangle, const BeamAxis& x, const BeamAxis& y, const BeamAxis& z) const {
    ProjectedTriangle seen{};
    for (int i = 0; i < 3; ++i) {
        const Vec3 p = mesh->vertex(triangle, i);
        seen.x[i] = dot(x.along, p) + x.offset;
        seen.y[i] = dot(y.along, p) + y.offset;
        seen.z[i] = dot(z.along, p) + z.offset;
    }
    return seen;
}

ProjectionPlane::ProjectionPlane(
    const ProjectedScene& scene, const Vec3& direction, double rotation, AlongPeriods periods) {
    const Cell& cell = scene.cell;
    if (!cell.periodic()) {
        const Frame frame = frame_about(direction);
        const double angle = std::numbers::pi * rotation;
        s = std::cos(angle) * frame.s + std::sin(angle) * frame.t;
        t = std::cos(angle) * frame.t - std::sin(angle) * frame.s;
        depth = direction;
        std::tie(low_s, size_s) = extent_of(scene, s);
        std::tie(low_t, size_t) = extent_of(scene, t);
        return;
    }
    if (cell.along_x && cell.along_y) {
        set_layer(cell, direction, rotation, periods);
    } else {
        set_row(scene, direction, rotation, periods);
    }
}

/// Projects onto the horizontal plane, which the cell tiles. Slanted, t is sheared by a whole
/// number of periods to a period of s.
void ProjectionPlane::set_layer(
    const Cell& cell, const Vec3& direction, double rotation, AlongPeriods periods) {
    constexpr Vec3 kUp{0, 0, 1};
    depth = kUp / direction.z;
    area = std::abs(direction.z);
    s = sheared({1, 0, 0}, kUp, direction);
    t = sheared({0, 1, 0}, kUp, direction);
    low_s = cell.low_x;
    low_t = cell.low_y;
    size_s = cell.size_x;
    size_t = cell.size_y;
    repeats_s = repeats_t = true;
    constexpr std::array<double, 4> kShears{-2, -1, 1, 2};
    const double turn = 2 * rotation;
    if (turn >= 1) {
        std::swap(s, t);
        std::swap(low_s, low_t);
        std::swap(size_s, size_t);
    }
    const auto pick = static_cast<std::size_t>((turn - std::floor(turn)) * kShears.size());
    const double shear = periods == AlongPeriods::slanted ? kShears[pick] * size_t / size_s : 0;
    t += shear * s;
    low_t += shear * low_s;
}

/// Projects onto the vertical plane along the row, across the rest of the beam; lines run across
/// the row.
void ProjectionPlane::set_row(
    const ProjectedScene& scene, const Vec3& direction, double rotation, AlongPeriods periods) {
    const Cell& cell = scene.cell;
    const Vec3 axis = cell.along_x ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 across = normalized(direction - dot(direction, axis) * axis);
    area = dot(across, direction);
    depth = across / area;
    s = cross(across, axis);
    std::tie(low_s, size_s) = extent_of(scene, s);
    const double shear = periods == AlongPeriods::slanted ? 2 * rotation - 1 : 0;
    t = sheared(axis, across, direction) + shear * s;
    low_t = cell.along_x ? cell.low_x : cell.low_y;
    size_t = cell.along_x ? cell.size_x : cell.size_y;
    repeats_t = true;
}

std::optional<std::pair<double, double>> extent_within(
    const double (&x)[3], const double (&y)[3], double low, double high) {
    double least = std::numeric_limits<double>::infinity();
    double largest = -least;
    const auto add = [&](double at) {
        least = std::min(least, at);
        largest = std::max(largest, at);
    };
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        if (y[i] >= low && y[i] <= high) {
            add(x[i]);
        }
        for (const double end : {low, high}) {
            if ((y[i] < end) != (y[j] < end)) {
                add(x[i] + (x[j] - x[i]) * ((end - y[i]) / (y[j] - y[i])));
            }
        }
    }
    return least <= largest ? std::optional(std::pair{least, largest}) : std::nullopt;
}

Periods periods_of(double low, double high, double period, bool repeats) {
    if (!repeats) {
        return {};
    }
    const auto at = [&](double coordinate) {
        return static_cast<std::int32_t>(
            std::floor(std::clamp(coordinate / period, -kMaxPeriods, kMaxPeriods)));
    };
    return {at(low), at(high)};
}

Periods periods_in_row(
    const ProjectedTriangle& seen,
    std::int32_t period_y,
    double size_y,
    double size_x,
    bool repeats_x) {
    const auto x = extent_within(
        seen.x, seen.y, (period_y - kPeriodMargin) * size_y,
        (period_y + 1 + kPeriodMargin) * size_y);
    if (!x) {
        return {0, -1};
    }
    const double margin = kPeriodMargin * size_x;
    return periods_of(x->first - margin, x->second + margin, size_x, repeats_x);
}

}  // namespace quasimc

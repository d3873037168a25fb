#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/checks.h"
#include "base/vec3.h"
#include "geometry/shapes/ear_cutter.h"
#include "geometry/shapes/shapes.h"
#include "quasimc/error.h"

namespace quasimc {

namespace {

/// Twice the vector area: the best normal of corners that are not exactly coplanar (Newell).
Vec3 newell_normal(std::span<const Vec3> corners) {
    Vec3 sum;
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        sum += cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    }
    return sum;
}

/// The corners projected along `normal`, without repetitions, counter-clockwise.
std::vector<FlatCorner> flatten(std::span<const Vec3> corners, const Vec3& normal) {
    const Frame frame = frame_about(normalized(normal));
    std::vector<FlatCorner> flat;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 p = corners[i] - corners[0];
        const FlatCorner corner{{dot(p, frame.s), dot(p, frame.t)}, i};
        if (flat.empty() || !same_point(flat.back(), corner)) {
            flat.push_back(corner);
        }
    }
    while (flat.size() > 1 && same_point(flat.front(), flat.back())) {
        flat.pop_back();
    }
    return flat;
}

/// Whether two sides cross properly, by more than rounding.
bool sides_cross(const std::vector<FlatCorner>& corners) {
    double largest = 0;
    for (const FlatCorner& p : corners) {
        largest = std::max({largest, std::abs(p.s), std::abs(p.t)});
    }
    constexpr double kRounding = 1e-9;
    const double least = kRounding * largest * largest;
    const auto are_apart = [least](double u, double v) {
        return std::min(std::abs(u), std::abs(v)) > least && (u > 0) != (v > 0);
    };
    const std::size_t n = corners.size();
    for (std::size_t i = 0; i + 2 < n; ++i) {
        const FlatCorner &a = corners[i], &b = corners[i + 1];
        for (std::size_t k = i + 2; k < n; ++k) {
            const FlatCorner &c = corners[k], &d = corners[(k + 1) % n];
            if (are_apart(turn(a, b, c), turn(a, b, d)) &&
                are_apart(turn(c, d, a), turn(c, d, b))) {
                return true;
            }
        }
    }
    return false;
}

/// The triangles from the first corner, without those of zero area.
CutPolygon cut_fan(std::span<const Vec3> corners) {
    CutPolygon fan;
    for (std::uint32_t i = 2; i < corners.size(); ++i) {
        if (length(cross(corners[i - 1] - corners[0], corners[i] - corners[0])) > 0) {
            fan.faces.push_back({0, i - 1, i});
            fan.sides_cross = true;
        }
    }
    return fan;
}

}  // namespace

CutPolygon cut_polygon(std::span<const Vec3> corners) {
    EXPECT(corners.size() >= 3);
    const Vec3 normal = newell_normal(corners);
    if (!(length(normal) > 0)) {
        CutPolygon fan = cut_fan(corners);  // a self-intersecting quadrilateral with equal wings
        return fan.faces.empty() ? CutPolygon{{{0, 1, 2}}} : fan;
    }
    // All pairs of many sides take long; where ears remain, some sides cross too.
    constexpr std::size_t kFew = 32, kMaxPairedSides = 1024;
    const std::vector<FlatCorner> flat = flatten(corners, normal);
    if (flat.size() <= kMaxPairedSides && sides_cross(flat)) {
        return cut_fan(corners);
    }
    std::optional<std::vector<Face>> faces =
        flat.size() <= kFew ? cut_ears_of_few(flat) : cut_ears_of_many(flat);
    return faces ? CutPolygon{std::move(*faces)} : cut_fan(corners);
}

std::vector<Triangle> make_polygon(std::span<const Vec3> corners) {
    const CutPolygon cut = cut_polygon(corners);
    if (cut.sides_cross) {
        throw InputError(
            {{"polygon of " + std::to_string(corners.size()) + " corners",
              "it can't be divided into triangles", "its sides intersect",
              "give the corners in order around it"}});
    }
    std::vector<Triangle> triangles;
    for (const auto& [a, b, c] : cut.faces) {
        triangles.push_back({corners[a], corners[b], corners[c]});
    }
    return triangles;
}

}  // namespace quasimc

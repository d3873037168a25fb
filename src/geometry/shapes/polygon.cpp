#include <cmath>
#include <cstddef>
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

/// Twice the vector area: the normal that fits corners best that are not quite in a plane (Newell).
Vec3 newell_normal(std::span<const Vec3> corners) {
    Vec3 sum;
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        sum += cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    }
    return sum;
}

/// The corners seen along `normal`, without repetitions, counter-clockwise.
std::vector<FlatCorner> flatten(std::span<const Vec3> corners, const Vec3& normal) {
    const Frame frame = frame_about(normalized(normal));
    std::vector<FlatCorner> flat;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 p = corners[i] - corners[0];
        const FlatCorner corner{{dot(p, frame.s), dot(p, frame.t)}, i};
        if (flat.empty() || !same_place(flat.back(), corner)) {
            flat.push_back(corner);
        }
    }
    while (flat.size() > 1 && same_place(flat.front(), flat.back())) {
        flat.pop_back();
    }
    return flat;
}

}  // namespace

std::vector<Face> make_polygon_faces(std::span<const Vec3> corners) {
    EXPECT(corners.size() >= 3);
    const Vec3 normal = newell_normal(corners);
    if (!(length(normal) > 0)) {
        return {{0, 1, 2}};
    }
    constexpr std::size_t kFew = 32;
    const std::vector<FlatCorner> flat = flatten(corners, normal);
    std::optional<std::vector<Face>> faces =
        flat.size() <= kFew ? cut_ears_of_few(flat) : cut_ears_of_many(flat);
    if (!faces) {
        throw InputError(
            {{"polygon of " + std::to_string(corners.size()) + " corners",
              "it can't be cut into triangles", "its sides cross each other",
              "give the corners in order around it"}});
    }
    return std::move(*faces);
}

std::vector<Triangle> make_polygon(std::span<const Vec3> corners) {
    std::vector<Triangle> triangles;
    for (const auto& [a, b, c] : make_polygon_faces(corners)) {
        triangles.push_back({corners[a], corners[b], corners[c]});
    }
    return triangles;
}

}  // namespace quasimc

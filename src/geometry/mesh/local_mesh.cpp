#include "geometry/mesh/local_mesh.h"

#include <algorithm>
#include <cmath>

#include "base/bounds.h"
#include "base/checks.h"

namespace quasimc {

namespace {

/// The power of two that takes `half_extent` into (1/2, 1].
double scale_to_unit(double half_extent) {
    if (!(half_extent > 0)) {
        return 1;
    }
    int exponent = 0;
    if (std::frexp(half_extent, &exponent) == 0.5) {
        --exponent;
    }
    constexpr int kLargest = 1000;  // keeps the scale and its square root's neighbours finite
    return std::ldexp(1.0, std::clamp(-exponent, -kLargest, kLargest));
}

}  // namespace

LocalMesh make_local_mesh(const std::vector<Triangle>& triangles) {
    EXPECT(!triangles.empty());
    Bounds bounds;
    for (const Triangle& t : triangles) {
        for (const Vec3& corner : t) {
            EXPECT(is_finite(corner));
            bounds.add(corner);
        }
    }
    const Vec3 half = 0.5 * bounds.size();

    LocalMesh mesh;
    mesh.origin = bounds.center();
    mesh.scale = scale_to_unit(std::max({half.x, half.y, half.z}));
    constexpr std::size_t kPadding = 4;
    mesh.vertices.reserve(9 * triangles.size() + kPadding);
    for (const Triangle& t : triangles) {
        for (const Vec3& corner : t) {
            const Vec3 p = mesh.to_local(corner);
            mesh.vertices.push_back(static_cast<float>(p.x));
            mesh.vertices.push_back(static_cast<float>(p.y));
            mesh.vertices.push_back(static_cast<float>(p.z));
        }
    }
    mesh.vertices.resize(mesh.vertices.size() + kPadding, 0.0F);
    return mesh;
}

}  // namespace quasimc

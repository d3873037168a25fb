#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/scene_geometry.h"
#include "quasimc/mesh.h"

namespace quasimc {

/// Triangles that cover every point of the cell like the infinite scene: triangles that extend over
/// a border, or lie outside, appear once for each image that touches the cell (with a margin of a
/// few rounding errors). `source[i]` is the input triangle of which triangle i is an image; images
/// of one triangle are adjacent.
struct WrappedTriangles {
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> source;
};

/// Throws InputError if a triangle is so large compared with the cell that its images would exhaust
/// the memory.
[[nodiscard]] WrappedTriangles wrap_into_cell(
    const std::vector<Triangle>& triangles, const Cell& cell);

/// A periodic scene with instances. Those in one image of the cell, away from its borders, remain
/// instances, moved into the cell; the others become triangles.
struct WrappedGeometry {
    std::shared_ptr<const SceneGeometry> geometry;
    std::vector<std::uint32_t> source;           ///< of triangles without an instance
    std::vector<std::uint32_t> instance_source;  ///< of the first triangle of each instance

    /// The input triangle of which triangle `i` is an image.
    /// @param ranges  of the geometry
    [[nodiscard]] std::uint32_t source_of(std::uint32_t i, const RangeIndex& ranges) const {
        if (i < source.size()) {
            return source[i];
        }
        const std::uint32_t instance = ranges.find(i);
        return instance_source[instance] + (i - ranges.first(instance));
    }
};

[[nodiscard]] WrappedGeometry wrap_into_cell(const SceneGeometry& geometry, const Cell& cell);

}  // namespace quasimc

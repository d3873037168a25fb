#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/scene_geometry.h"
#include "quasimc/mesh.h"

namespace quasimc {

/// Triangles that cover every point of the cell as the infinite scene does: triangles that
/// reach over a border, or lie outside, appear once for each image of them that touches the cell
/// (with a margin of a few rounding errors). `source[i]` is the input triangle that triangle i is
/// an image of; images of one triangle stand next to each other.
struct WrappedTriangles {
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> source;
};

/// Throws InputError if a triangle is so much larger than the cell that images would fill the
/// memory.
[[nodiscard]] WrappedTriangles wrap_into_cell(
    const std::vector<Triangle>& triangles, const Cell& cell);

/// The same of a scene with instances. Those that lie in one image of the cell, away from its
/// borders, remain instances, moved into the cell; the others are cut up into triangles.
struct WrappedGeometry {
    std::shared_ptr<const SceneGeometry> geometry;
    std::vector<std::uint32_t> source;           ///< of the triangles that belong to no instance
    std::vector<std::uint32_t> instance_source;  ///< of the first triangle of each instance

    /// The input triangle that triangle `i` is an image of.
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

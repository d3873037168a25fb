#pragma once

#include <cstdint>
#include <vector>

#include "base/vec3.h"
#include "geometry/mesh/triangle.h"

namespace quasimc {

/// The horizontal rectangle that is repeated without end along x, y or both. World coordinates.
struct Cell {
    bool along_x = false, along_y = false;
    double low_x = 0, low_y = 0;    ///< used along periodic axes only
    double size_x = 1, size_y = 1;  ///< the periods, > 0

    [[nodiscard]] bool periodic() const { return along_x || along_y; }
    friend bool operator==(const Cell&, const Cell&) = default;
};

/// Triangles of which every place in the cell is covered as in the infinite scene: triangles that
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

}  // namespace quasimc

#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "raster/projected_scene.h"

namespace quasimc {

/// Number of triangles drawn together, on any vector unit.
inline constexpr std::size_t kBlockLanes = 8;
/// Number of rows of a block that are drawn together.
inline constexpr std::size_t kBlockRows = 8;

/// Corners of a block of triangles, local coordinates: [corner][x, y or z][lane]. Lanes of zeros
/// cover nothing.
struct alignas(64) TriangleBlock {
    double at[3][3][kBlockLanes];

    /// Copies a lane of another block.
    void copy(std::size_t lane, const TriangleBlock& from, std::size_t lane_there) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            for (std::size_t i = 0; i < 3; ++i) {
                at[corner][i][lane] = from.at[corner][i][lane_there];
            }
        }
    }
    void set(std::size_t lane, const LocalMesh& mesh, std::uint32_t triangle) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const Vec3 p = mesh.vertex(triangle, static_cast<int>(corner));
            at[corner][0][lane] = p.x;
            at[corner][1][lane] = p.y;
            at[corner][2][lane] = p.z;
        }
    }
};

/// Parallel lines, on a grid across the beam.
struct RasterGrid {
    BeamAxis x, y, z;  ///< position on the grid, and depth
    std::int64_t columns = 0, rows = 0;
    bool repeats_x = false, repeats_y = false;
    double row_shift = 0;         ///< offset of each row from the last, in columns
    bool has_barycentric = true;  ///< whether `u` and `v` of a block are needed
};

/// A period of a grid for each triangle of a block.
struct alignas(32) BlockPeriods {
    std::int32_t x[kBlockLanes], y[kBlockLanes];
};

/// A linear function on the grid, by triangle: at + by_x x + by_y y.
struct alignas(64) BlockGradient {
    double at[kBlockLanes], by_x[kBlockLanes], by_y[kBlockLanes];
};

/// The grid positions that a block of triangles covers, some rows at a time.
struct alignas(64) BlockSpans {
    static constexpr std::size_t kMost = kBlockLanes * kBlockRows;

    /// Rows [row, end_row) of a triangle; unwrapped.
    double row[kBlockLanes], end_row[kBlockLanes];
    /// The sides of a triangle, as in SidesByRow.
    double low_x[kBlockLanes], low_y[kBlockLanes], middle_x[kBlockLanes], middle_y[kBlockLanes];
    double slope_long[kBlockLanes], slope_low[kBlockLanes], slope_high[kBlockLanes];
    BlockGradient depth, u, v;  ///< depth and barycentric coordinates, if needed
    double low_depth[kBlockLanes], high_depth[kBlockLanes];
    double first_x[kBlockLanes], first_y[kBlockLanes], first_depth[kBlockLanes];  ///< a corner
    double twice_area[kBlockLanes];  ///< above 0 if corners turn left

    /// Spans of columns [first, last) of a row, before its shift: row i of the current rows and a
    /// lane are at i * kBlockLanes + lane, if bit `lane` of covered[i] is set.
    std::size_t rows = 0;
    std::uint32_t covered[kBlockRows];
    alignas(64) double y[kMost], in_row[kMost], first[kMost], last[kMost], shift[kMost];

    /// Calls visit(lane, index of the span) row by row, and within a row by triangle.
    template <typename Visit>
    void for_each(const Visit& visit) const {
        for (std::size_t i = 0; i < rows; ++i) {
            for (std::uint32_t left = covered[i]; left != 0; left &= left - 1) {
                const auto lane = static_cast<std::size_t>(std::countr_zero(left));
                visit(lane, i * kBlockLanes + lane);
            }
        }
    }
};

/// The subdivision of a block's triangles into patches, by lane.
struct alignas(64) BlockPatches {
    double parts[kBlockLanes];       ///< along each side: 2^level
    std::uint32_t hit[kBlockLanes];  ///< LineHits::Hit of the first patch
};

/// Unordered hits of lines on triangles: the line, and a key that grows with depth and contains the
/// surface (depth_key()).
struct LineHitArrays {
    std::uint32_t* lines;
    std::uint64_t* keys;
};

/// Sorts by depth, then by surface.
[[nodiscard]] inline std::uint64_t depth_key(float depth, std::uint32_t hit) {
    constexpr std::uint32_t kSign = 0x80000000U;
    const auto bits = std::bit_cast<std::uint32_t>(depth);
    const std::uint32_t ordered = (bits & kSign) != 0 ? ~bits : bits | kSign;
    return std::uint64_t{ordered} << 32U | hit;
}

/// The depth of a depth_key().
[[nodiscard]] inline float depth_of(std::uint64_t key) {
    constexpr std::uint32_t kSign = 0x80000000U;
    const auto ordered = static_cast<std::uint32_t>(key >> 32U);
    return std::bit_cast<float>((ordered & kSign) != 0 ? ordered ^ kSign : ~ordered);
}

/// The loops over a block, compiled for a vector unit.
struct SpanLoops {
    /// Sets all members except the spans. False if no triangle touches a row.
    /// @param periods  that are moved to the first one
    bool (*set)(
        const TriangleBlock& corners,
        const BlockPeriods& periods,
        const RasterGrid& grid,
        BlockSpans& spans);
    /// The first and the last periods that bounding boxes overlap, 0 where the grid does not
    /// repeat: like periods_of(), with kPeriodMargin. @returns whether they are the same
    bool (*periods)(
        const TriangleBlock& corners,
        const RasterGrid& grid,
        BlockPeriods& first,
        BlockPeriods& last);
    /// dot(unit normal of the upper side of each triangle, direction), 0 if it has no area: like
    /// ProjectedScene::cosine().
    void (*cosines)(const TriangleBlock& corners, const Vec3& direction, double* to);
    /// Finds the spans of the next kBlockRows rows of each triangle; false if there are no more
    /// rows.
    bool (*next)(const RasterGrid& grid, BlockSpans& spans);
    /// Writes the hits on the current spans of the lanes whose bit is set in `wanted`. There must
    /// be room for all. @returns their number
    std::size_t (*write_hits)(
        const RasterGrid& grid,
        const BlockSpans& spans,
        const BlockPatches& patches,
        std::uint32_t wanted,
        const LineHitArrays& to);
};

/// The loops for the vector unit of this machine. All variants compute the same bits.
[[nodiscard]] SpanLoops best_span_loops();

}  // namespace quasimc

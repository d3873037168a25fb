#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "raster/patches.h"
#include "raster/projected_scene.h"
#include "raster/triangle_block.h"
#include "raster/triangle_rows.h"

namespace quasimc {

/// A triangle as Columns draw it.
struct ColumnTriangle {
    std::uint32_t first_patch = 0;
    std::uint8_t level = 0;  ///< see Patches
    bool is_sensor = false;
    float least_cosine = 0;            ///< seen at less, it is left out
    const CutTriangle* cut = nullptr;  ///< where others cross it: how it is cut into patches
};

/// Triangles in blocks, the last one filled up with what nobody sees.
struct ColumnTriangles {
    std::vector<TriangleBlock> corners;
    std::vector<BlockPatches> patches;
    std::vector<std::uint8_t> plain;  ///< by block, a bit for each lane: neither cut nor narrow
    std::vector<ColumnTriangle> each;
};

/// The triangles of a scene that have patches, which must outlive them.
/// @param least_cosines  by triangle; empty: 0
[[nodiscard]] ColumnTriangles column_triangles(
    const ProjectedScene& scene, const Patches& patches, std::span<const float> least_cosines = {});

/// All that parallel lines through a scene pass, in order: a bundle of rays, rasterized.
///
/// Lines stand on a regular grid across the beam with a uniform shift, so that (times a patch is
/// passed) x line_area() is an unbiased estimate of the patch's area across the beam. In a periodic
/// scene each line goes through the infinite scene: on the plane of the beam, which repeats, the
/// images of all triangles that cover a place are all that the line through it passes, and their
/// depths tell the order. Nothing is followed from cell to cell.
///
/// Objects are used by one thread, and hold buffers for the next beam.
class Columns {
  public:
    struct Spec {
        Vec3 direction;                   ///< unit
        double rotation = 0;              ///< see ProjectionPlane
        double shift_s = 0, shift_t = 0;  ///< of the grid, 0..1 of a step
        double line_area = 1;             ///< wanted, across the beam: local units squared
    };

    /// A patch as a line passes it: 2 * patch, and 1 more if light that travels along the direction
    /// comes to its lower side. Sensors have kSensor on top.
    using Passed = std::uint32_t;
    static constexpr Passed kSensor = 0x80000000U;

    /// @param scene  where it lies, and how it repeats
    /// @param triangles  column_triangles() of the scene
    void draw(const ProjectedScene& scene, const ColumnTriangles& triangles, const Spec& spec);

    [[nodiscard]] double line_area() const { return line_area_; }
    /// Of all lines.
    [[nodiscard]] std::size_t size() const { return size_; }

    /// How many lines pass each of the triangles, in their order.
    [[nodiscard]] std::span<const std::uint32_t> counts() const { return counts_; }

    /// So many of what further lines pass may be read beyond the end of one; beyond the last it is
    /// something that was passed once, or 0.
    static constexpr std::size_t kReadAhead = 16;
    /// Calls visit(span of Passed) for each line that passes something, in order along the
    /// direction.
    template <typename Visit>
    void for_each_line(const Visit& visit) const {
        for (std::size_t i = 0; i + 1 < first_.size(); ++i) {
            if (first_[i] < first_[i + 1]) {
                visit(std::span(passed_).subspan(first_[i], first_[i + 1] - first_[i]));
            }
        }
    }

  private:
    void set_grid(const ProjectedScene& scene, const Spec& spec);
    void set_square_rows(const ProjectionPlane& plane, const Spec& spec, double lines);
    void draw_block(const ColumnTriangles& triangles, std::size_t block);
    void draw_span(const ColumnTriangle& triangle, std::size_t lane, std::size_t span);
    /// Makes room for so many places more.
    void reserve(std::size_t more);
    void sort_lines();
    void sort_sparse_lines();

    SpanLoops loops_ = best_span_loops();
    RasterGrid grid_;
    double line_area_ = 0;
    Vec3 direction_;
    bool is_turned_ = false;  // grid and direction are no right-handed frame

    BlockSpans spans_{};  // of the triangles at hand
    /// Where lines pass something, the first size_: the line, and depth_key().
    std::vector<std::uint32_t> lines_;
    std::vector<std::uint64_t> keys_;
    std::size_t size_ = 0;
    std::vector<std::uint64_t> sorted_;  // keys line by line
    std::vector<std::uint32_t> first_;
    std::vector<Passed> passed_;
    std::vector<std::uint32_t> counts_;
};

}  // namespace quasimc

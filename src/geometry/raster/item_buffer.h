#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/mesh/point2.h"
#include "geometry/raster/draw_span.h"
#include "geometry/raster/projected_scene.h"
#include "geometry/raster/triangle_block.h"
#include "geometry/raster/triangle_rows.h"

namespace quasimc {

/// What a beam lights first, pixel by pixel: a regular grid of its rays, rasterized with a depth
/// buffer. With a uniform shift of the grid, pixels x pixel_area() of a triangle is an unbiased
/// estimate of the area of the beam that it catches; its variance falls with about the power 1.5 of
/// the number of pixels. For many beams of which each need not be seen well, as those of a sky;
/// for one beam ScanLines tell more.
///
/// Objects are used by one thread, and hold buffers for the next beam.
class ItemBuffer {
  public:
    struct Spec {
        Vec3 direction;                   ///< unit, in which the light travels
        double rotation = 0;              ///< see ProjectionPlane
        double shift_s = 0, shift_t = 0;  ///< of the grid, 0..1 of a pixel
        double pixels = 1;                ///< about as many over the scene, or a period of it
    };

    /// A triangle that is seen. In a periodic scene each of its images that is.
    struct Item {
        std::uint32_t triangle = 0;  ///< of the mesh
        std::uint32_t id = 0;        ///< in ids(); sensors, which hide nothing, have none: 0
        std::uint32_t pixels = 0;
        double cosine = 0;  ///< dot(unit normal of the upper side, direction of the beam)
    };

    void draw(const ProjectedScene& scene, const Spec& spec);

    /// Area across the beam that a pixel stands for, local units squared.
    [[nodiscard]] double pixel_area() const { return pixel_area_; }
    /// What is seen, sensors last.
    [[nodiscard]] std::span<const Item> items() const { return items_; }

    /// Pixels next to each other that see the same.
    struct Run {
        std::uint32_t first = 0, count = 0;
        std::uint32_t id = 0;  ///< of what is seen; 0: nothing
    };
    /// All pixels, row by row.
    [[nodiscard]] std::span<const Run> runs() const { return runs_; }
    /// Ids are less than that.
    [[nodiscard]] std::size_t id_count() const { return images_.size(); }
    /// Where the ray of a pixel ends that sees something.
    [[nodiscard]] Barycentric place(std::uint32_t pixel) const;

    /// Where the rays of pixels end that see one id.
    struct Places {
        PlaneGradient u, v;
        std::uint32_t columns = 1;
        /// Barycentric coordinates.
        [[nodiscard]] Point2 of(std::uint32_t pixel) const {
            const std::uint32_t row = pixel / columns;
            const double x = pixel - row * columns;
            return {u.at + u.by_x * x + u.by_y * row, v.at + v.by_x * x + v.by_y * row};
        }
    };
    /// @param id  of an item
    [[nodiscard]] Places places(std::uint32_t id) const;

  private:
    /// A triangle, moved by whole periods of the grid.
    struct Image {
        std::uint32_t triangle;
        std::int32_t periods_x, periods_y;
    };

    void set_grid(const ProjectedScene& scene, const Spec& spec);
    /// On the grid, where ray (i, j) passes at x = i, y = j.
    [[nodiscard]] ProjectedTriangle seen(std::uint32_t triangle) const;
    [[nodiscard]] ProjectedTriangle moved(ProjectedTriangle seen, const Image& image) const;
    /// Calls `draw(image, corners)` for all images of a triangle that may touch the grid.
    template <typename Draw>
    void for_each_image(std::uint32_t triangle, const Draw& draw) const;
    /// Calls `span(first pixel, count, depth there, depth from pixel to pixel)` row by row.
    template <typename Span>
    void rasterize(const ProjectedTriangle& corners, const Span& span) const;
    void draw_opaque(std::uint32_t triangle);
    void draw_block(std::uint32_t first);
    void find_runs();
    void list_items();
    void add_sensor(std::uint32_t triangle);

    BlockSpans block_spans_{};  // scratch, of a block
    DrawSpans* draw_spans_ = best_draw_spans();
    SpanLoops loops_ = best_span_loops();
    ProjectedScene scene_;
    Vec3 direction_;
    BeamAxis x_, y_, z_;  // place on the grid, and depth
    double pixel_area_ = 0;
    std::uint32_t columns_ = 0, rows_ = 0;
    bool repeats_x_ = false, repeats_y_ = false;
    std::vector<float> depths_;      // by pixel
    std::vector<std::int32_t> ids_;  // by pixel: in images_
    std::vector<PixelSpan> spans_;   // scratch, of one triangle
    std::array<std::vector<PixelSpan>, kBlockLanes> lane_spans_;
    std::vector<std::uint32_t> ends_;  // scratch
    std::vector<Run> runs_;
    std::vector<Image> images_;  // the first stands for nothing
    std::vector<std::uint32_t> counts_;
    std::vector<Item> items_;
};

}  // namespace quasimc

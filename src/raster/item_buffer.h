#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/mesh/point2.h"
#include "raster/draw_span.h"
#include "raster/projected_scene.h"
#include "raster/triangle_block.h"
#include "raster/triangle_rows.h"

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
        bool keeps_places = false;        ///< see places()
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
    /// Calls visit(run) for all pixels, row by row.
    template <typename Visit>
    void for_each_run(const Visit& visit) const {
        std::uint32_t first = 0;
        for (std::size_t i = 0; i < run_count_; ++i) {
            visit(Run{first, ends_[i] - first, static_cast<std::uint32_t>(ids_[first])});
            first = ends_[i];
        }
    }
    /// Pixels next to each other in a row that see the same.
    struct RowRun {
        std::uint32_t row = 0, x = 0, count = 0;
        std::uint32_t id = 0;
    };
    /// Calls visit(run) for the pixels of each few rows, one of `of`.
    /// @param first  of these, less than `of`
    template <typename Visit>
    void for_each_run_of_rows(std::uint32_t first, std::uint32_t of, const Visit& visit) const {
        std::uint32_t row = 0, row_begin = 0, wanted = first;
        for_each_run([&](Run run) {
            while (run.count > 0) {
                const std::uint32_t x = run.first - row_begin;
                const std::uint32_t count = std::min(run.count, columns_ - x);
                if (row == wanted) {
                    visit(RowRun{row, x, count, run.id});
                }
                if (x + count == columns_) {
                    wanted += row == wanted ? of : 0;
                    ++row;
                    row_begin += columns_;
                }
                run.first += count;
                run.count -= count;
            }
        });
    }
    /// Ids are less than that.
    [[nodiscard]] std::size_t id_count() const { return images_.size(); }
    /// Where the ray of a pixel ends that sees something.
    [[nodiscard]] Barycentric place(std::uint32_t pixel) const;

    /// Where the rays of pixels end that see one id.
    struct Places {
        PlaneGradient u, v;
        /// Barycentric coordinates.
        [[nodiscard]] Point2 of(double x, double row) const {
            return {u.at + u.by_x * x + u.by_y * row, v.at + v.by_x * x + v.by_y * row};
        }
    };
    /// Where a beam was drawn that keeps them. @param id  of an item
    [[nodiscard]] const Places& places(std::uint32_t id) const { return places_[id]; }

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
    [[nodiscard]] DepthBuffer buffer();
    void keep_places(const BlockSpans& block);
    void find_runs();
    void list_items();
    void add_sensor(std::uint32_t triangle);

    BlockSpans block_spans_{};  // scratch, of a block
    SpanLoops loops_ = best_span_loops();
    DrawLoops draw_ = best_draw_loops();
    ProjectedScene scene_;
    Vec3 direction_;
    BeamAxis x_, y_, z_;  // place on the grid, and depth
    double pixel_area_ = 0;
    std::uint32_t columns_ = 0, rows_ = 0;
    bool repeats_x_ = false, repeats_y_ = false;
    bool keeps_places_ = false;
    std::vector<float> depths_;        // by pixel
    std::vector<std::int32_t> ids_;    // by pixel: in images_
    std::vector<PixelSpan> spans_;     // scratch, of one triangle
    std::vector<std::uint32_t> ends_;  // of runs, and room for more
    std::size_t run_count_ = 0;
    std::vector<Image> images_;    // the first stands for nothing
    std::vector<double> cosines_;  // by image
    std::vector<Places> places_;   // by image, if they are kept
    std::vector<std::uint32_t> counts_;
    std::vector<Item> items_;
};

}  // namespace quasimc

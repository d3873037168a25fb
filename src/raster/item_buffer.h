#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/mesh/point2.h"
#include "raster/draw_span.h"
#include "raster/projected_scene.h"
#include "raster/triangle_block.h"
#include "raster/triangle_rows.h"

namespace quasimc {

class ItemScratch;

/// An item buffer (Weghorst, Hooper and Greenberg 1984): the triangle that each ray of a beam hits
/// first, for rays on a regular grid. With a uniform shift of the grid, pixels x pixel_area() of a
/// triangle is an unbiased estimate of its lit area across the beam; its variance falls with about
/// the power 1.5 of the number of pixels. That suits many beams with a coarse view along each, as
/// those of a sky; ScanLines are more accurate for a single beam.
///
/// An image refers to the scratch of draw(), which holds one image at a time.
class ItemBuffer {
  public:
    /// A view along a beam.
    struct View {
        Vec3 direction;                   ///< unit, in which the light travels
        double rotation = 0;              ///< see ProjectionPlane
        double shift_s = 0, shift_t = 0;  ///< of the grid, 0..1 of a pixel
        double pixels = 1;  ///< approximate number over the scene, or over one of its periods
        bool with_points = false;  ///< see points()
    };

    /// A visible triangle; in a periodic scene, each of its visible images.
    struct Item {
        std::uint32_t triangle = 0;  ///< of the mesh
        std::uint32_t id = 0;        ///< value of its pixels; 0 for sensors, which occlude nothing
        std::uint32_t pixels = 0;
        double cosine = 0;  ///< dot(unit normal of the upper side, direction of the beam)
    };

    /// Area across the beam per pixel, local units squared.
    [[nodiscard]] double pixel_area() const { return pixel_area_; }
    /// Visible items, sensors last.
    [[nodiscard]] std::span<const Item> items() const { return items_; }

    /// Consecutive pixels that show the same item.
    struct Run {
        std::uint32_t first = 0, count = 0;
        std::uint32_t id = 0;  ///< of the visible item; 0: none
    };
    /// Calls visit(run) for all pixels, row by row.
    template <typename Visit>
    void for_each_run(const Visit& visit) const {
        std::uint32_t first = 0;
        for (const std::uint32_t end : run_ends_) {
            visit(Run{first, end - first, static_cast<std::uint32_t>(ids_[first])});
            first = end;
        }
    }
    /// Consecutive pixels of a row that show the same item.
    struct RowRun {
        std::uint32_t row = 0, x = 0, count = 0;
        std::uint32_t id = 0;
    };
    /// Calls visit(run) for the pixels of every `of`-th group of rows.
    /// @param first  the first group, less than `of`
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
    /// Upper limit of ids.
    [[nodiscard]] std::size_t id_count() const { return images_.size(); }
    /// The point where the ray of a pixel hits its item.
    [[nodiscard]] Barycentric point(std::uint32_t pixel) const;

    /// Barycentric coordinates of the points where the rays of one id hit.
    struct Points {
        PlaneGradient u, v;
        [[nodiscard]] Point2 of(double x, double row) const {
            return {u.at + u.by_x * x + u.by_y * row, v.at + v.by_x * x + v.by_y * row};
        }
    };
    /// The hit points of an item, in a view with points. @param id  of the item
    [[nodiscard]] const Points& points(std::uint32_t id) const { return points_[id]; }

  private:
    friend class ItemDrawing;
    friend class ItemScratch;

    /// A triangle, moved by whole periods of the grid.
    struct Image {
        std::uint32_t triangle;
        std::int32_t periods_x, periods_y;
    };

    /// The projection onto the grid; ray (i, j) is at x = i, y = j.
    [[nodiscard]] ProjectedTriangle seen(std::uint32_t triangle) const;
    [[nodiscard]] ProjectedTriangle moved(ProjectedTriangle seen, const Image& image) const;

    ProjectedScene scene_;
    RasterGrid grid_;            // one period, if it repeats
    std::uint32_t columns_ = 0;  // of the grid
    double pixel_area_ = 0;
    std::span<const std::int32_t> ids_;  // by pixel: in images_
    std::span<const std::uint32_t> run_ends_;
    std::span<const Image> images_;   // the first means no item
    std::span<const Points> points_;  // by image
    std::span<const Item> items_;
};

/// Memory that draw() uses.
class ItemScratch {
    friend class ItemDrawing;

    BlockSpans spans_of_block_{};
    std::vector<float> depths_;  // by pixel
    std::vector<std::int32_t> ids_;
    std::vector<std::uint32_t> ends_;  // of runs, and spare room
    std::vector<ItemBuffer::Image> images_;
    std::vector<double> cosines_;        // by image
    std::vector<std::uint32_t> counts_;  // of pixels, by image
    std::vector<ItemBuffer::Points> points_;
    std::vector<ItemBuffer::Item> items_;
};

/// Finds the surfaces that a beam hits first.
[[nodiscard]] ItemBuffer draw(
    const ProjectedScene& scene, const ItemBuffer::View& view, ItemScratch& scratch);

}  // namespace quasimc

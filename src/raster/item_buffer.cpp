#include "raster/item_buffer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/checks.h"
#include "raster/stored_blocks.h"
#include "raster/triangle_rows.h"

namespace quasimc {
namespace {

/// The smallest integer >= x, for 0 <= x <= 2^31.
std::int32_t ceil_to_int(double x) {
    const auto whole = static_cast<std::int32_t>(x);
    return whole + (whole < x ? 1 : 0);
}

/// Spacing and number of rays along one coordinate.
struct Rays {
    double pitch = 1;
    std::uint32_t count = 1;
};

Rays rays_of(double size, bool repeats, double pitch) {
    const double exact = size / pitch;
    const double count = std::max(1.0, repeats ? std::round(exact) : std::ceil(exact));
    return {repeats ? size / count : pitch, static_cast<std::uint32_t>(count)};
}

/// A triangle of the mesh for each lane.
using LaneTriangles = std::array<std::uint32_t, kBlockLanes>;

}  // namespace

ProjectedTriangle ItemBuffer::seen(std::uint32_t triangle) const {
    return scene_.seen(triangle, grid_.x, grid_.y, grid_.z);
}

ProjectedTriangle ItemBuffer::moved(ProjectedTriangle seen, const Image& image) const {
    for (int i = 0; i < 3; ++i) {
        seen.x[i] -= static_cast<double>(image.periods_x) * static_cast<double>(grid_.columns);
        seen.y[i] -= static_cast<double>(image.periods_y) * static_cast<double>(grid_.rows);
    }
    return seen;
}

Barycentric ItemBuffer::point(std::uint32_t pixel) const {
    const Image& image = images_[static_cast<std::size_t>(ids_[pixel])];
    const std::uint32_t row = pixel / columns_;
    return moved(seen(image.triangle), image)
        .barycentric(static_cast<double>(pixel - row * columns_), static_cast<double>(row));
}

/// Draws one image.
class ItemDrawing {
  public:
    ItemDrawing(const ProjectedScene& scene, const ItemBuffer::View& view, ItemScratch& scratch)
        : view_(view), scratch_(scratch) {
        image_.scene_ = scene;
        set_grid();
        scratch_.items_.clear();
        scratch_.images_.assign(1, {});
        scratch_.cosines_.assign(1, 0);
        scratch_.points_.assign(view.with_points ? 1 : 0, {});
        scratch_.depths_.assign(pixels() + kSpanLanes, std::numeric_limits<float>::infinity());
        scratch_.ids_.assign(pixels() + kSpanLanes, 0);
    }

    ItemBuffer draw() {
        if (pixels() > 0) {
            draw_opaque_triangles();
            find_runs();
            list_items();
            add_sensors();
        }
        image_.ids_ = scratch_.ids_;
        image_.images_ = scratch_.images_;
        image_.points_ = scratch_.points_;
        image_.items_ = scratch_.items_;
        return image_;
    }

  private:
    using Image = ItemBuffer::Image;

    void set_grid() {
        const ProjectionPlane plane(
            image_.scene_, view_.direction, view_.rotation, AlongPeriods::straight);
        if (!(plane.size_s > 0 && plane.size_t > 0)) {
            return;  // edge-on
        }
        // Square pixels, unless the scene is so narrow that there would be too many.
        const double pitch = std::max(
            std::sqrt(plane.size_s * plane.size_t / view_.pixels),
            std::max(plane.size_s, plane.size_t) / view_.pixels);
        const Rays x = rays_of(plane.size_s, plane.repeats_s, pitch);
        const Rays y = rays_of(plane.size_t, plane.repeats_t, pitch);
        grid_ = {
            .x = {plane.s / x.pitch, -plane.low_s / x.pitch - view_.shift_s},
            .y = {plane.t / y.pitch, -plane.low_t / y.pitch - view_.shift_t},
            .z = {plane.depth, 0},
            .columns = x.count,
            .rows = y.count,
            .repeats_x = plane.repeats_s,
            .repeats_y = plane.repeats_t,
            .has_barycentric = view_.with_points};
        image_.grid_ = grid_;
        image_.grid_.repeats_x = image_.grid_.repeats_y = false;
        image_.columns_ = x.count;
        image_.pixel_area_ = x.pitch * y.pitch * plane.area;
    }

    [[nodiscard]] std::size_t pixels() const {
        return static_cast<std::size_t>(image_.grid_.columns * image_.grid_.rows);
    }
    /// Calls `draw(image, corners)` for all images of a triangle that may touch the grid.
    template <typename Draw>
    void for_each_image(std::uint32_t triangle, const Draw& draw) const {
        const auto columns = static_cast<double>(grid_.columns),
                   rows = static_cast<double>(grid_.rows);
        const ProjectedTriangle corners = image_.seen(triangle);
        const auto [low, high] = std::minmax({corners.y[0], corners.y[1], corners.y[2]});
        const Periods y = periods_of(low, high, rows, grid_.repeats_y);
        const auto [left, right] = std::minmax({corners.x[0], corners.x[1], corners.x[2]});
        const Periods all_along_x = periods_of(left, right, columns, grid_.repeats_x);
        for (std::int32_t py = y.first; py <= y.last; ++py) {
            const Periods x = grid_.repeats_y
                                  ? periods_in_row(corners, py, rows, columns, grid_.repeats_x)
                                  : all_along_x;
            for (std::int32_t px = x.first; px <= x.last; ++px) {
                const Image image{triangle, px, py};
                draw(image, image_.moved(corners, image));
            }
        }
    }

    /// Calls `span(first pixel, count, depth there, depth from pixel to pixel)` row by row.
    template <typename Span>
    void rasterize(const ProjectedTriangle& c, const Span& span) const {
        const std::uint32_t columns = image_.columns_;
        const auto rows = static_cast<std::uint32_t>(image_.grid_.rows);
        const auto within = [](double x, std::uint32_t end) {
            return ceil_to_int(std::min(std::max(x, 0.0), static_cast<double>(end)));
        };
        const std::int32_t end = within(std::max({c.y[0], c.y[1], c.y[2]}), rows);
        std::int32_t row = within(std::min({c.y[0], c.y[1], c.y[2]}), rows);
        if (row >= end) {
            return;
        }
        const double ax = c.x[1] - c.x[0];
        const double ay = c.y[1] - c.y[0];
        const double bx = c.x[2] - c.x[0];
        const double by = c.y[2] - c.y[0];
        const double twice_area = ax * by - ay * bx;
        // Corners have single precision: thinner triangles count as edge-on.
        constexpr double kEdgeOn = 0x1p-24;
        if (std::abs(twice_area) <= kEdgeOn * (ax * ax + ay * ay + bx * bx + by * by)) {
            return;
        }
        const double per_area = 1 / twice_area;
        const double z_by_x = ((c.z[1] - c.z[0]) * by - (c.z[2] - c.z[0]) * ay) * per_area;
        const double z_by_y = ((c.z[2] - c.z[0]) * ax - (c.z[1] - c.z[0]) * bx) * per_area;
        const SidesByRow sides(c);
        for (; row < end; ++row) {
            const auto [left, right] = sides.at(row);
            const std::int32_t first = within(left, columns);
            const std::int32_t last = within(right, columns);
            if (first < last) {
                const double z = c.z[0] + (first - c.x[0]) * z_by_x + (row - c.y[0]) * z_by_y;
                span(
                    std::size_t{columns} * static_cast<std::size_t>(row) +
                        static_cast<std::size_t>(first),
                    last - first, static_cast<float>(z), static_cast<float>(z_by_x));
            }
        }
    }

    void draw_opaque_triangles() {
        const ProjectedScene& scene = image_.scene_;
        for (std::uint32_t i = 0; i < scene.mesh->triangle_count(); i += kBlockLanes) {
            scene.check_stop();
            const TriangleBlock corners = block_of(scene, i);
            BlockPeriods first, last;
            if (loops_.periods(corners, grid_, first, last)) {
                LaneTriangles triangles;
                std::iota(triangles.begin(), triangles.end(), i);
                draw_images(corners, first, triangles);
            } else {
                draw_each_image(corners, first, last, i);
            }
        }
    }

    /// Draws the images of a block of triangles, in the order of triangles.
    /// @param triangle  the first one
    void draw_each_image(
        const TriangleBlock& corners,
        const BlockPeriods& first,
        const BlockPeriods& last,
        std::uint32_t triangle) {
        TriangleBlock drawn{};
        BlockPeriods periods{};
        LaneTriangles triangles{};
        std::size_t size = 0;
        const auto add = [&](std::uint32_t lane, std::int32_t x, std::int32_t y) {
            drawn.copy(size, corners, lane);
            periods.x[size] = x;
            periods.y[size] = y;
            triangles[size] = triangle + lane;
            if (++size == kBlockLanes) {
                draw_images(drawn, periods, triangles);
                drawn = {};
                size = 0;
            }
        };
        const ProjectedScene& scene = image_.scene_;
        for (std::uint32_t lane = 0; lane < kBlockLanes; ++lane) {
            const std::uint32_t i = triangle + lane;
            if (i < scene.mesh->triangle_count() && scene.role(i) == VisibilityRole::opaque) {
                const Periods x{first.x[lane], last.x[lane]}, y{first.y[lane], last.y[lane]};
                for_each_period(
                    i, x, y, [&](std::int32_t px, std::int32_t py) { add(lane, px, py); });
            }
        }
        draw_images(drawn, periods, triangles);
    }

    /// Calls `visit(period of x, period of y)` for all that a triangle may touch.
    /// @param x, y  of its bounding box
    template <typename Visit>
    void for_each_period(
        std::uint32_t triangle, const Periods& x, const Periods& y, const Visit& visit) const {
        if (x.first < x.last && y.first < y.last) {
            for_each_image(triangle, [&](const Image& image, const ProjectedTriangle&) {
                visit(image.periods_x, image.periods_y);
            });
            return;
        }
        for (std::int32_t py = y.first; py <= y.last; ++py) {
            for (std::int32_t px = x.first; px <= x.last; ++px) {
                visit(px, py);
            }
        }
    }

    /// Draws images of triangles.
    /// @param triangles  by lane
    void draw_images(
        const TriangleBlock& corners, const BlockPeriods& periods, const LaneTriangles& triangles) {
        BlockSpans& found = scratch_.spans_of_block_;
        if (!loops_.set(corners, periods, image_.grid_, found)) {
            return;
        }
        std::vector<Image>& images = scratch_.images_;
        const std::size_t size = images.size();
        const auto first_id = static_cast<std::int32_t>(size);
        images.resize(size + kBlockLanes);
        for (std::size_t lane = 0; lane < kBlockLanes; ++lane) {
            images[size + lane] = {triangles[lane], periods.x[lane], periods.y[lane]};
        }
        scratch_.cosines_.resize(size + kBlockLanes);
        loops_.cosines(corners, view_.direction, &scratch_.cosines_[size]);
        if (view_.with_points) {
            add_points(found);
        }
        while (loops_.next(image_.grid_, found)) {
            draw_.rows(buffer(), found, first_id);
        }
    }

    [[nodiscard]] DepthBuffer buffer() {
        return {scratch_.depths_.data(), scratch_.ids_.data(), image_.columns_};
    }
    void add_points(const BlockSpans& block) {
        const auto of_lane = [](const BlockGradient& all, std::size_t lane) {
            return PlaneGradient{all.at[lane], all.by_x[lane], all.by_y[lane]};
        };
        for (std::size_t lane = 0; lane < kBlockLanes; ++lane) {
            scratch_.points_.push_back({of_lane(block.u, lane), of_lane(block.v, lane)});
        }
    }

    void find_runs() {
        std::vector<std::uint32_t>& ends = scratch_.ends_;
        const auto count = static_cast<std::uint32_t>(pixels());
        scratch_.ids_[count] = -1;  // ends the last run
        ends.resize(std::max<std::size_t>(ends.size(), count));
        const std::size_t runs = draw_.run_ends(scratch_.ids_.data(), count, ends.data());
        image_.run_ends_ = std::span(ends).first(runs);
    }

    /// Lists the visible images, without a branch for each: their visibility is unpredictable.
    void list_items() {
        const std::vector<Image>& images = scratch_.images_;
        std::vector<std::uint32_t>& counts = scratch_.counts_;
        counts.assign(images.size(), 0);
        image_.ids_ = scratch_.ids_;
        image_.for_each_run([&](const ItemBuffer::Run& run) { counts[run.id] += run.count; });
        scratch_.items_.resize(images.size());
        std::size_t size = 0;
        for (std::uint32_t id = 1; id < images.size(); ++id) {
            scratch_.items_[size] = {images[id].triangle, id, counts[id], scratch_.cosines_[id]};
            size += counts[id] > 0 ? 1 : 0;
        }
        scratch_.items_.resize(size);
    }

    void add_sensors() {
        const ProjectedScene& scene = image_.scene_;
        for (std::uint32_t i = 0; !scene.roles.empty() && i < scene.mesh->triangle_count(); ++i) {
            if (scene.role(i) == VisibilityRole::sensor) {
                add_sensor(i);
            }
        }
    }

    void add_sensor(std::uint32_t triangle) {
        std::uint32_t seen = 0;
        for_each_image(triangle, [&](const Image&, const ProjectedTriangle& corners) {
            rasterize(corners, [&](std::size_t first, std::int32_t count, float z, float step) {
                for (std::int32_t i = 0; i < count; ++i) {
                    const std::size_t pixel = first + static_cast<std::size_t>(i);
                    seen += z + step * static_cast<float>(i) < scratch_.depths_[pixel] ? 1 : 0;
                }
            });
        });
        if (seen > 0) {
            scratch_.items_.push_back(
                {triangle, 0, seen, image_.scene_.cosine(triangle, view_.direction)});
        }
    }

    const ItemBuffer::View& view_;
    ItemScratch& scratch_;
    SpanLoops loops_ = best_span_loops();
    DrawLoops draw_ = best_draw_loops();
    RasterGrid grid_;  // of the scene, with its periods
    ItemBuffer image_;
};

ItemBuffer draw(const ProjectedScene& scene, const ItemBuffer::View& view, ItemScratch& scratch) {
    EXPECT(view.pixels >= 1);
    return ItemDrawing(scene, view, scratch).draw();
}

}  // namespace quasimc

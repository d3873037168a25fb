#include "raster/item_buffer.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

/// How the rays of one coordinate stand.
struct Rays {
    double pitch = 1;
    std::uint32_t count = 1;
};

Rays rays_of(double size, bool repeats, double pitch) {
    const double exact = size / pitch;
    const double count = std::max(1.0, repeats ? std::round(exact) : std::ceil(exact));
    return {repeats ? size / count : pitch, static_cast<std::uint32_t>(count)};
}

}  // namespace

void ItemBuffer::draw(const ProjectedScene& scene, const Spec& spec) {
    EXPECT(spec.pixels >= 1);
    scene_ = scene;
    direction_ = spec.direction;
    items_.clear();
    run_count_ = 0;
    images_.assign(1, {});
    cosines_.assign(1, 0);
    keeps_places_ = spec.keeps_places;
    places_.assign(keeps_places_ ? 1 : 0, {});
    set_grid(scene, spec);
    const std::size_t pixels = std::size_t{columns_} * rows_;
    depths_.assign(pixels + kSpanLanes, std::numeric_limits<float>::infinity());
    ids_.assign(pixels + kSpanLanes, 0);
    if (pixels == 0) {
        return;
    }
    const std::uint32_t triangles = scene.mesh->triangle_count();
    const bool is_open = !repeats_x_ && !repeats_y_;
    const std::uint32_t step = is_open ? kBlockLanes : 1;
    for (std::uint32_t i = 0; i < triangles; i += step) {
        scene.check_stop();
        if (is_open) {
            draw_block(i);
        } else if (scene.role(i) == VisibilityRole::opaque) {
            draw_opaque(i);
        }
    }
    find_runs();
    list_items();
    for (std::uint32_t i = 0; !scene.roles.empty() && i < triangles; ++i) {
        if (scene.role(i) == VisibilityRole::sensor) {
            add_sensor(i);
        }
    }
}

void ItemBuffer::set_grid(const ProjectedScene& scene, const Spec& spec) {
    const ProjectionPlane plane(scene, spec.direction, spec.rotation, AlongPeriods::straight);
    columns_ = rows_ = 0;
    if (!(plane.size_s > 0 && plane.size_t > 0)) {
        return;  // seen edge-on
    }
    // Squares, unless the scene is so narrow that there would be no end of them.
    const double pitch = std::max(
        std::sqrt(plane.size_s * plane.size_t / spec.pixels),
        std::max(plane.size_s, plane.size_t) / spec.pixels);
    const Rays x = rays_of(plane.size_s, plane.repeats_s, pitch);
    const Rays y = rays_of(plane.size_t, plane.repeats_t, pitch);
    columns_ = x.count;
    rows_ = y.count;
    x_ = {plane.s / x.pitch, -plane.low_s / x.pitch - spec.shift_s};
    y_ = {plane.t / y.pitch, -plane.low_t / y.pitch - spec.shift_t};
    z_ = {plane.depth, 0};
    repeats_x_ = plane.repeats_s;
    repeats_y_ = plane.repeats_t;
    pixel_area_ = x.pitch * y.pitch * plane.area;
}

ProjectedTriangle ItemBuffer::seen(std::uint32_t triangle) const {
    return scene_.seen(triangle, x_, y_, z_);
}

ProjectedTriangle ItemBuffer::moved(ProjectedTriangle seen, const Image& image) const {
    for (int i = 0; i < 3; ++i) {
        seen.x[i] -= static_cast<double>(image.periods_x) * columns_;
        seen.y[i] -= static_cast<double>(image.periods_y) * rows_;
    }
    return seen;
}

template <typename Draw>
void ItemBuffer::for_each_image(std::uint32_t triangle, const Draw& draw) const {
    const ProjectedTriangle corners = seen(triangle);
    if (!repeats_x_ && !repeats_y_) {
        draw(Image{triangle, 0, 0}, corners);
        return;
    }
    const auto [low, high] = std::minmax({corners.y[0], corners.y[1], corners.y[2]});
    const Periods y = periods_of(low, high, rows_, repeats_y_);
    const auto [left, right] = std::minmax({corners.x[0], corners.x[1], corners.x[2]});
    const Periods all_along_x = periods_of(left, right, columns_, repeats_x_);
    for (std::int32_t py = y.first; py <= y.last; ++py) {
        const Periods x =
            repeats_y_ ? periods_in_row(corners, py, rows_, columns_, repeats_x_) : all_along_x;
        for (std::int32_t px = x.first; px <= x.last; ++px) {
            const Image image{triangle, px, py};
            draw(image, moved(corners, image));
        }
    }
}

template <typename Span>
void ItemBuffer::rasterize(const ProjectedTriangle& c, const Span& span) const {
    const auto within = [](double x, std::uint32_t end) {
        return ceil_to_int(std::min(std::max(x, 0.0), static_cast<double>(end)));
    };
    const std::int32_t end = within(std::max({c.y[0], c.y[1], c.y[2]}), rows_);
    std::int32_t row = within(std::min({c.y[0], c.y[1], c.y[2]}), rows_);
    if (row >= end) {
        return;
    }
    const double ax = c.x[1] - c.x[0];
    const double ay = c.y[1] - c.y[0];
    const double bx = c.x[2] - c.x[0];
    const double by = c.y[2] - c.y[0];
    const double twice_area = ax * by - ay * bx;
    // Corners are told apart in single precision: what is thinner is seen edge-on.
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
        const std::int32_t first = within(left, columns_);
        const std::int32_t last = within(right, columns_);
        if (first < last) {
            const double z = c.z[0] + (first - c.x[0]) * z_by_x + (row - c.y[0]) * z_by_y;
            span(
                std::size_t{columns_} * static_cast<std::size_t>(row) +
                    static_cast<std::size_t>(first),
                last - first, static_cast<float>(z), static_cast<float>(z_by_x));
        }
    }
}

void ItemBuffer::draw_opaque(std::uint32_t triangle) {
    for_each_image(triangle, [&](const Image& image, const ProjectedTriangle& corners) {
        const auto id = static_cast<std::int32_t>(images_.size());
        spans_.clear();
        float step = 0;
        rasterize(corners, [&](std::size_t first, std::int32_t count, float z, float z_step) {
            spans_.push_back({first, count, z});
            step = z_step;
        });
        if (!spans_.empty()) {
            draw_.spans(buffer(), spans_, step, id);
            images_.push_back(image);
            cosines_.push_back(scene_.cosine(triangle, direction_));
            if (keeps_places_) {
                const TrianglePlane plane(corners);
                places_.push_back({plane.gradient(0, 1, 0), plane.gradient(0, 0, 1)});
            }
        }
    });
}

/// Triangles from `first` on, side by side, where nothing repeats itself: the same pixels as
/// draw_opaque() finds.
void ItemBuffer::draw_block(std::uint32_t first) {
    const TriangleBlock block = block_of(scene_, first);
    BlockSpans& found = block_spans_;
    const RasterGrid grid{
        .x = x_, .y = y_, .z = z_, .columns = columns_, .rows = rows_, .has_places = keeps_places_};
    if (!loops_.set(block, grid, found)) {
        return;
    }
    const std::size_t size = images_.size();
    const auto first_id = static_cast<std::int32_t>(size);
    images_.resize(size + kBlockLanes);
    for (std::uint32_t lane = 0; lane < kBlockLanes; ++lane) {
        images_[size + lane] = {first + lane, 0, 0};
    }
    cosines_.resize(size + kBlockLanes);
    loops_.cosines(block, direction_, &cosines_[size]);
    if (keeps_places_) {
        keep_places(found);
    }
    while (loops_.next(grid, found)) {
        draw_.rows(buffer(), found, first_id);
    }
}

void ItemBuffer::keep_places(const BlockSpans& block) {
    const auto of_lane = [](const BlockGradient& all, std::size_t lane) {
        return PlaneGradient{all.at[lane], all.by_x[lane], all.by_y[lane]};
    };
    for (std::size_t lane = 0; lane < kBlockLanes; ++lane) {
        places_.push_back({of_lane(block.u, lane), of_lane(block.v, lane)});
    }
}

DepthBuffer ItemBuffer::buffer() {
    return {depths_.data(), ids_.data(), columns_};
}

void ItemBuffer::find_runs() {
    const auto pixels = static_cast<std::uint32_t>(ids_.size()) - kSpanLanes;
    ids_[pixels] = -1;  // ends the last
    ends_.resize(std::max<std::size_t>(ends_.size(), pixels));
    run_count_ = draw_.run_ends(ids_.data(), pixels, ends_.data());
}

/// Without a branch for each image: which of them are seen can't be foreseen.
void ItemBuffer::list_items() {
    counts_.assign(images_.size(), 0);
    for_each_run([&](const Run& run) { counts_[run.id] += run.count; });
    items_.resize(images_.size());
    std::size_t size = 0;
    for (std::uint32_t id = 1; id < images_.size(); ++id) {
        items_[size] = {images_[id].triangle, id, counts_[id], cosines_[id]};
        size += counts_[id] > 0 ? 1 : 0;
    }
    items_.resize(size);
}

void ItemBuffer::add_sensor(std::uint32_t triangle) {
    std::uint32_t seen = 0;
    for_each_image(triangle, [&](const Image&, const ProjectedTriangle& corners) {
        rasterize(corners, [&](std::size_t first, std::int32_t count, float z, float step) {
            for (std::int32_t i = 0; i < count; ++i) {
                const std::size_t pixel = first + static_cast<std::size_t>(i);
                seen += z + step * static_cast<float>(i) < depths_[pixel] ? 1 : 0;
            }
        });
    });
    if (seen > 0) {
        items_.push_back({triangle, 0, seen, scene_.cosine(triangle, direction_)});
    }
}

Barycentric ItemBuffer::place(std::uint32_t pixel) const {
    const Image& image = images_[static_cast<std::size_t>(ids_[pixel])];
    const std::uint32_t row = pixel / columns_;
    return moved(seen(image.triangle), image)
        .place(static_cast<double>(pixel - row * columns_), static_cast<double>(row));
}

}  // namespace quasimc

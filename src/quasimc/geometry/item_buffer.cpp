#include "quasimc/geometry/item_buffer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "quasimc/base/checks.h"

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

/// Where rows cut the sides of a triangle. Each side is walked from its lower end up, so that
/// triangles which share one cut it at the same places.
class SidesByRow {
  public:
    SidesByRow(const double (&x)[3], const double (&y)[3]) {
        int low = 0;
        int middle = 1;
        int high = 2;
        const auto order = [&](int& i, int& j) {
            const bool swap = y[j] < y[i];
            const int smaller = swap ? j : i;
            j = swap ? i : j;
            i = smaller;
        };
        order(low, middle);
        order(middle, high);
        order(low, middle);
        low_x_ = x[low];
        low_y_ = y[low];
        middle_x_ = x[middle];
        middle_y_ = y[middle];
        slope_long_ = (x[high] - x[low]) / (y[high] - y[low]);
        slope_low_ = (x[middle] - x[low]) / (y[middle] - y[low]);
        slope_high_ = (x[high] - x[middle]) / (y[high] - y[middle]);
    }

    /// Left and right of a row between the lowest and the highest corner.
    [[nodiscard]] std::pair<double, double> at(double row) const {
        const double along = low_x_ + (row - low_y_) * slope_long_;
        const double other = row < middle_y_ ? low_x_ + (row - low_y_) * slope_low_
                                             : middle_x_ + (row - middle_y_) * slope_high_;
        return {std::min(along, other), std::max(along, other)};
    }

  private:
    double low_x_, low_y_, middle_x_, middle_y_, slope_long_, slope_low_, slope_high_;
};

}  // namespace

void ItemBuffer::draw(const BeamScene& scene, const Spec& spec) {
    EXPECT(spec.pixels >= 1);
    mesh_ = scene.mesh;
    direction_ = spec.direction;
    items_.clear();
    images_.assign(1, {});
    set_grid(scene, spec);
    const std::size_t pixels = std::size_t{columns_} * rows_;
    depths_.assign(pixels, std::numeric_limits<float>::infinity());
    ids_.assign(pixels, 0);
    if (pixels == 0) {
        return;
    }
    bool has_sensors = false;
    for (std::uint32_t i = 0; i < mesh_->triangle_count(); ++i) {
        const SeenAs role = scene.role(i);
        has_sensors = has_sensors || role == SeenAs::sensor;
        if (role == SeenAs::opaque) {
            draw_opaque(i);
        }
    }
    list_items();
    for (std::uint32_t i = 0; has_sensors && i < mesh_->triangle_count(); ++i) {
        if (scene.role(i) == SeenAs::sensor) {
            add_sensor(i);
        }
    }
}

void ItemBuffer::set_grid(const BeamScene& scene, const Spec& spec) {
    const BeamPlane plane(scene, spec.direction, spec.rotation, AlongPeriods::straight);
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
    x_ = plane.s / x.pitch;
    y_ = plane.t / y.pitch;
    z_ = plane.depth;
    x_offset_ = -plane.low_s / x.pitch - spec.shift_s;
    y_offset_ = -plane.low_t / y.pitch - spec.shift_t;
    repeats_x_ = plane.repeats_s;
    repeats_y_ = plane.repeats_t;
    pixel_area_ = x.pitch * y.pitch * plane.area;
}

ItemBuffer::Corners ItemBuffer::corners_of(std::uint32_t triangle) const {
    Corners corners{};
    for (int i = 0; i < 3; ++i) {
        const Vec3 p = mesh_->vertex(triangle, i);
        corners.x[i] = dot(x_, p) + x_offset_;
        corners.y[i] = dot(y_, p) + y_offset_;
        corners.z[i] = dot(z_, p);
    }
    return corners;
}

ItemBuffer::Corners ItemBuffer::moved(Corners corners, const Image& image) const {
    for (int i = 0; i < 3; ++i) {
        corners.x[i] -= static_cast<double>(image.periods_x) * columns_;
        corners.y[i] -= static_cast<double>(image.periods_y) * rows_;
    }
    return corners;
}

template <typename Draw>
void ItemBuffer::for_each_image(std::uint32_t triangle, const Draw& draw) const {
    const Corners corners = corners_of(triangle);
    if (!repeats_x_ && !repeats_y_) {
        draw(Image{triangle, 0, 0}, corners);
        return;
    }
    const auto periods = [](const double(&at)[3], bool repeats, std::uint32_t rays) {
        return periods_of(
            std::min({at[0], at[1], at[2]}), std::max({at[0], at[1], at[2]}), rays, repeats);
    };
    const Periods x = periods(corners.x, repeats_x_, columns_);
    const Periods y = periods(corners.y, repeats_y_, rows_);
    for (std::int32_t py = y.first; py <= y.last; ++py) {
        for (std::int32_t px = x.first; px <= x.last; ++px) {
            const Image image{triangle, px, py};
            draw(image, moved(corners, image));
        }
    }
}

template <typename Span>
void ItemBuffer::rasterize(const Corners& c, const Span& span) const {
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
    const SidesByRow sides(c.x, c.y);
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
    for_each_image(triangle, [&](const Image& image, const Corners& corners) {
        const auto id = static_cast<std::uint32_t>(images_.size());
        bool touched = false;
        rasterize(corners, [&](std::size_t first, std::int32_t count, float z, float step) {
            touched = true;
            float* depths = &depths_[first];
            std::uint32_t* ids = &ids_[first];
            for (std::int32_t i = 0; i < count; ++i) {
                const float here = z + step * static_cast<float>(i);
                const bool nearer = here < depths[i];
                depths[i] = nearer ? here : depths[i];
                ids[i] = nearer ? id : ids[i];
            }
        });
        if (touched) {
            images_.push_back(image);
        }
    });
}

void ItemBuffer::list_items() {
    counts_.assign(images_.size(), 0);
    for (const std::uint32_t id : ids_) {
        ++counts_[id];
    }
    for (std::uint32_t id = 1; id < images_.size(); ++id) {
        if (counts_[id] > 0) {
            const std::uint32_t triangle = images_[id].triangle;
            items_.push_back({triangle, id, counts_[id], cosine_of(triangle)});
        }
    }
}

void ItemBuffer::add_sensor(std::uint32_t triangle) {
    std::uint32_t seen = 0;
    for_each_image(triangle, [&](const Image&, const Corners& corners) {
        rasterize(corners, [&](std::size_t first, std::int32_t count, float z, float step) {
            for (std::int32_t i = 0; i < count; ++i) {
                const std::size_t pixel = first + static_cast<std::size_t>(i);
                seen += z + step * static_cast<float>(i) < depths_[pixel] ? 1 : 0;
            }
        });
    });
    if (seen > 0) {
        items_.push_back({triangle, 0, seen, cosine_of(triangle)});
    }
}

double ItemBuffer::cosine_of(std::uint32_t triangle) const {
    const Vec3 up = mesh_->across(triangle);
    const double size = length(up);
    return size > 0 ? dot(up, direction_) / size : 0;
}

ItemBuffer::Place ItemBuffer::place(std::size_t pixel) const {
    const Image& image = images_[ids_[pixel]];
    const Corners c = moved(corners_of(image.triangle), image);
    const double ax = c.x[1] - c.x[0];
    const double ay = c.y[1] - c.y[0];
    const double bx = c.x[2] - c.x[0];
    const double by = c.y[2] - c.y[0];
    const std::size_t row = pixel / columns_;
    const double px = static_cast<double>(pixel - row * columns_) - c.x[0];
    const double py = static_cast<double>(row) - c.y[0];
    const double twice_area = ax * by - ay * bx;
    return {
        static_cast<float>((px * by - py * bx) / twice_area),
        static_cast<float>((ax * py - ay * px) / twice_area)};
}

}  // namespace quasimc

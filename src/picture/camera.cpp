#include "picture/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "base/vec3.h"

namespace quasimc {
namespace {

constexpr double kMargin = 1.06;  // of the picture around the scene

}  // namespace

const std::array<NamedView, 6>& view_table() {
    static constexpr std::array<NamedView, 6> kTable{{
        {"front", 180, 0},
        {"back", 0, 0},
        {"right", 90, 0},
        {"left", 270, 0},
        {"top", 180, 90},
        {"bottom", 180, -90},
    }};
    return kTable;
}

const NamedView* find_view(std::string_view name) {
    const auto& table = view_table();
    const auto* found = std::find_if(
        table.begin(), table.end(), [&](const NamedView& view) { return view.name == name; });
    return found == table.end() ? nullptr : found;
}

Camera::Camera(
    const ViewSpec& view, const Orientation& axes, const Bounds& shown, double width, double height)
    : is_fisheye_(view.fisheye),
      middle_(view.fisheye.value_or(shown.center())),
      right_(axes.towards(is_fisheye_ ? -90 : view.azimuth_deg - 90, 0)),
      back_(is_fisheye_ ? Vec3{0, 0, -1} : axes.towards(view.azimuth_deg, view.elevation_deg)),
      half_width_(0.5 * width),
      half_height_(0.5 * height) {
    up_ = cross(back_, right_);
    if (is_fisheye_) {
        scale_ = std::min(half_width_, half_height_);
        return;
    }
    const double radius = std::max(shown.radius(), 1e-300);
    const double longer = std::max(half_width_, half_height_);
    const double tangent = std::tan(0.5 * view.fov_deg * kRadians);
    double extent = 0;  // largest fraction of half the picture that a corner needs, times length
    for (const Vec3& corner : corners_of(shown)) {
        const Vec3 p = seen(corner - middle_);
        const double needed =
            kMargin * std::max(std::abs(p.x) / half_width_, std::abs(p.y) / half_height_);
        extent = std::max(extent, needed);
        if (tangent > 0) {
            distance_ = std::max(distance_, p.z + needed * longer / tangent);
        }
    }
    if (distance_ > 0) {
        distance_ = std::max(distance_, 1e-3 * radius);
        scale_ = longer / (tangent * distance_);
    } else {
        scale_ = 1 / std::max(extent, 1e-6 * radius / longer);
        start_ = 1.01 * radius;
    }
}

std::optional<Camera::CameraRay> Camera::through(const PixelPoint& pixel) const {
    const double x = (pixel.x - half_width_) / scale_, y = (half_height_ - pixel.y) / scale_;
    if (is_fisheye_) {
        return through_fisheye(x, y);
    }
    const Vec3 aim = middle_ + x * right_ + y * up_;
    if (is_parallel()) {
        return CameraRay{aim + start_ * back_, -1.0 * back_};
    }
    const Vec3 eye = middle_ + distance_ * back_;
    return CameraRay{eye, normalized(aim - eye)};
}

/// @param x, y  in the circle of radius 1
std::optional<Camera::CameraRay> Camera::through_fisheye(double x, double y) const {
    const double far = std::hypot(x, y);
    if (far > 1) {
        return std::nullopt;
    }
    const double zenith = far * std::numbers::pi / 2;
    const double flat = far > 0 ? std::sin(zenith) / far : 0;
    return CameraRay{middle_, flat * (x * right_ + y * up_) - std::cos(zenith) * back_};
}

PixelPoint Camera::pixel_of(const Vec3& point) const {
    const Vec3 p = seen(point - middle_);
    const double zoom = is_parallel() ? scale_ : scale_ * distance_ / (distance_ - p.z);
    return {half_width_ + zoom * p.x, half_height_ - zoom * p.y};
}

Vec3 Camera::seen(const Vec3& direction) const {
    return {dot(direction, right_), dot(direction, up_), dot(direction, back_)};
}

}  // namespace quasimc

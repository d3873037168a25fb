#include "light/models/lamp_body.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quasimc {
namespace {

using std::numbers::pi;

/// A sample towards a point of the opening; its factor is `weight` over the squared distance.
LampBody::LampSample sample_towards(
    const Vec3& point, const LampBody::SurfacePoint& start, double weight = 1) {
    const Vec3 towards = start.position - point;
    const double square = dot(towards, towards);
    if (square == 0) {
        return {};
    }
    const double distance = std::sqrt(square);
    return {towards / distance, distance, start.axes, weight / square};
}

/// Uniform in the angle that the line subtends (Kulla and Fajardo 2012, section 4.1).
LampBody::LampSample line_seen_from(const LampBody& body, const Vec3& point, double u) {
    const Vec3 offset = point - body.center;
    const double foot = dot(offset, body.axes.n);
    const double away = length(offset - foot * body.axes.n);
    if (away == 0) {
        return {};  // the ends of a thin tube do not emit
    }
    const double half = 0.5 * body.opening.length;
    const double low = std::atan((-half - foot) / away);
    const double high = std::atan((half - foot) / away);
    const double along = foot + away * std::tan(low + u * (high - low));
    LampBody::LampSample sample =
        sample_towards(point, {body.center + along * body.axes.n, body.axes});
    sample.factor = (high - low) / (body.opening.length * away);
    return sample;
}

/// Uniform in the solid angle of the visible cap.
LampBody::LampSample sphere_seen_from(
    const LampBody& body, const Vec3& point, double u0, double u1) {
    const Vec3 towards = body.center - point;
    const double distance = length(towards);
    const double radius = body.opening.radius;
    if (distance <= radius) {
        return {};
    }
    const double t = cone_of_sphere(radius, distance);
    const Vec3 direction = direction_in_cone(towards / distance, u0 * t, u1);
    const double nearest = dot(towards, direction);
    const Vec3 across = towards - nearest * direction;
    const double depth = std::sqrt(std::max(0.0, radius * radius - dot(across, across)));
    const Vec3 normal = ((nearest - depth) * direction - towards) / radius;
    const double cosine = -dot(normal, direction);
    const double solid_angle = 4 * pi * t;
    return {
        direction, nearest - depth, frame_about(normalized(normal)),
        cosine > 0 ? solid_angle / (4 * pi * radius * radius * cosine) : 0};
}

/// A rectangle as seen from a point, the origin: x0..x1, y0..y1 at z < 0 (Urena, Fajardo and King
/// 2013, "An area-preserving parametrization for spherical rectangles").
class SphericalRectangle {
  public:
    SphericalRectangle(double x0, double x1, double y0, double y1, double z)
        : x0_(x0), x1_(x1), y0_(y0), y1_(y1), z_(z) {
        // The planes through the origin and the four sides.
        const Vec3 n0 = normalized(cross(Vec3{x0, y0, z}, Vec3{x1, y0, z}));
        const Vec3 n1 = normalized(cross(Vec3{x1, y0, z}, Vec3{x1, y1, z}));
        const Vec3 n2 = normalized(cross(Vec3{x1, y1, z}, Vec3{x0, y1, z}));
        const Vec3 n3 = normalized(cross(Vec3{x0, y1, z}, Vec3{x0, y0, z}));
        const auto corner = [](const Vec3& a, const Vec3& b) {
            return std::acos(std::clamp(-dot(a, b), -1.0, 1.0));
        };
        b0_ = n0.z;
        b1_ = n2.z;
        k_ = 2 * pi - corner(n2, n3) - corner(n3, n0);
        solid_angle_ = corner(n0, n1) + corner(n1, n2) - k_;
    }

    [[nodiscard]] double solid_angle() const { return solid_angle_; }
    /// The point in the rectangle, x and y.
    [[nodiscard]] std::pair<double, double> draw_point(double u0, double u1) const {
        const double a = u0 * solid_angle_ + k_;
        const double f = (std::cos(a) * b0_ - b1_) / std::sin(a);
        const double c = std::clamp(std::copysign(1 / std::hypot(f, b0_), f), -1.0, 1.0);
        const double x = std::clamp(-c * z_ / std::sqrt(std::max(1 - c * c, 0x1p-104)), x0_, x1_);
        const double d = std::hypot(x, z_);
        const double h0 = y0_ / std::hypot(d, y0_);
        const double h1 = y1_ / std::hypot(d, y1_);
        const double h = h0 + u1 * (h1 - h0);
        const double y = h * d / std::sqrt(std::max(1 - h * h, 0x1p-104));
        return {x, std::clamp(y, y0_, y1_)};
    }

  private:
    double x0_, x1_, y0_, y1_, z_;
    double b0_ = 0, b1_ = 0, k_ = 0, solid_angle_ = 0;
};

LampBody::LampSample rectangle_seen_from(
    const LampBody& body, const Vec3& point, double u0, double u1) {
    const Opening& opening = body.opening;
    const Vec3 offset = to_axes(body.axes, body.center - point);
    const double area = opening.length * opening.width;
    // At large distances sampling by area is as good, and the solid angle a small difference of
    // large angles.
    constexpr double kFar = 1e4;
    if (offset.z >= 0) {
        return {};  // behind it
    }
    if (dot(offset, offset) >
        kFar * (area + opening.length * opening.length + opening.width * opening.width)) {
        return body.seen_by_area(point, u0, u1);
    }
    const SphericalRectangle seen(
        offset.x - 0.5 * opening.length, offset.x + 0.5 * opening.length,
        offset.y - 0.5 * opening.width, offset.y + 0.5 * opening.width, offset.z);
    const auto [x, y] = seen.draw_point(u0, u1);
    const Vec3 towards{x, y, offset.z};
    const double distance = length(towards);
    const double cosine = -offset.z / distance;
    return {
        from_axes(body.axes, towards / distance), distance, body.axes,
        seen.solid_angle() / (area * cosine)};
}

}  // namespace

Vec3 direction_in_cone(const Vec3& axis, double t, double u) {
    const Frame frame = frame_about(axis);
    const double sine = 2 * std::sqrt(std::max(0.0, t * (1 - t)));
    const double around = 2 * pi * u;
    return sine * std::cos(around) * frame.s + sine * std::sin(around) * frame.t +
           (1 - 2 * t) * frame.n;
}

double cone_of_sphere(double radius, double distance) {
    const double sine = radius / distance;
    return 0.5 * sine * sine / (1 + std::sqrt((1 - sine) * (1 + sine)));
}

LampBody::SurfacePoint LampBody::draw_point(double u0, double u1) const {
    switch (opening.kind) {
        case Opening::Kind::line:
            return {center + (u0 - 0.5) * opening.length * axes.n, axes};
        case Opening::Kind::rectangle:
            return {
                center + (u0 - 0.5) * opening.length * axes.s + (u1 - 0.5) * opening.width * axes.t,
                axes};
        case Opening::Kind::disk: {
            const double r = opening.radius * std::sqrt(u0);
            const double around = 2 * pi * u1;
            return {center + r * std::cos(around) * axes.s + r * std::sin(around) * axes.t, axes};
        }
        case Opening::Kind::sphere: {
            const Vec3 normal = direction_in_cone(axes.n, u0, u1);
            return {center + opening.radius * normal, frame_about(normal)};
        }
        default:
            return {center, axes};
    }
}

LampBody::LampSample LampBody::seen_by_area(const Vec3& point, double u0, double u1) const {
    return sample_towards(point, draw_point(u0, u1));
}

LampBody::LampSample LampBody::seen_from(const Vec3& point, double u0, double u1) const {
    switch (opening.kind) {
        case Opening::Kind::line:
            return line_seen_from(*this, point, u0);
        case Opening::Kind::rectangle:
            return rectangle_seen_from(*this, point, u0, u1);
        case Opening::Kind::sphere:
            return sphere_seen_from(*this, point, u0, u1);
        default:
            return seen_by_area(point, u0, u1);
    }
}

double LampBody::radius() const {
    return std::max(opening.radius, 0.5 * std::hypot(opening.length, opening.width));
}

}  // namespace quasimc

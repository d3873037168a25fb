// The sun as a disk: uniform radiance 1 / (pi sin^2 r) inside a cone of half-angle r, for an
// irradiance of 1 on a plane facing its centre. Paths draw a direction uniformly in the cone and
// enter the scene's box like those of a sky.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/checks.h"
#include "light/models/entry.h"
#include "light/models/source.h"

namespace quasimc {
namespace {

using std::numbers::pi;

/// All directions within an angle of an axis.
class Cone {
  public:
    Cone(const Vec3& axis, double radius) : axis_(axis), radius_(radius) {
        const Vec3 other = std::abs(axis.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
        s_ = normalized(other - dot(other, axis) * axis);
        t_ = cross(axis, s_);
        const double half_sine = std::sin(0.5 * radius);
        depth_ = 2 * half_sine * half_sine;
    }

    [[nodiscard]] const Vec3& axis() const { return axis_; }
    [[nodiscard]] double radius() const { return radius_; }
    [[nodiscard]] double solid_angle() const { return 2 * pi * depth_; }
    /// Integral of the cosine to the axis.
    [[nodiscard]] double projected() const { return pi * std::sin(radius_) * std::sin(radius_); }
    /// A direction, uniform in solid angle.
    [[nodiscard]] Vec3 direction(double u0, double u1) const {
        const double off = u0 * depth_;  // 1 - cosine to the axis
        const double sine = std::sqrt(off * (2 - off));
        return (1 - off) * axis_ + sine * (std::cos(2 * pi * u1) * s_ + std::sin(2 * pi * u1) * t_);
    }
    [[nodiscard]] bool contains(const Vec3& d) const {
        return length(d - axis_) <= 2 * std::sin(0.5 * radius_);
    }
    /// Integral over the cone of max(0, d.n) for a unit vector n, where a = axis.n.
    [[nodiscard]] double positive_part(double a) const;
    /// An upper bound of positive_part() without quadrature: a cone cut by the plane counts as a
    /// whole, at its largest cosine.
    [[nodiscard]] double most_positive_part(double a) const {
        if (std::abs(a) >= std::sin(radius_)) {
            return std::max(0.0, a) * projected();
        }
        return solid_angle() * std::max(0.0, std::sin(std::asin(a) + radius_));
    }

  private:
    Vec3 axis_, s_, t_;
    double radius_;
    double depth_ = 0;  // 1 - cos(radius)
};

/// A cone on one side of the plane counts whole or not at all: the vector sum of its directions
/// lies along the axis. In a cone that the plane cuts, d.n = x holds on arcs of half-angle
/// acos((cos r - x a) / (sqrt(1 - x^2) sqrt(1 - a^2))) about n, and equal dx cover equal areas of
/// the sphere (Archimedes).
double Cone::positive_part(double a) const {
    const double sine = std::sin(radius_);
    if (std::abs(a) >= sine) {
        return std::max(0.0, a) * projected();
    }
    const double highest = std::sin(std::asin(a) + radius_);
    const double flat = std::sqrt((1 - a) * (1 + a));
    const auto arc = [&](double x) {
        const double cosine = (1 - depth_ - x * a) / (std::sqrt((1 - x) * (1 + x)) * flat);
        return 2 * x * std::acos(std::clamp(cosine, -1.0, 1.0));
    };
    // x = highest sin(v), v up to pi/2: smooth at the cone's edge; midpoint rule.
    constexpr int kSteps = 2000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double v = pi / 2 * (i + 0.5) / kSteps;
        sum += arc(highest * std::sin(v)) * highest * std::cos(v);
    }
    return sum * pi / 2 / kSteps;
}

class DiskEmitter final : public SourceSampler {
  public:
    DiskEmitter(const Cone& cone, const EntryBox& box)
        : SourceSampler(flux_into(cone, box)), cone_(cone), box_(box) {}

    [[nodiscard]] Emission emit(const std::array<double, 4>& u) const override {
        const Vec3 direction = -cone_.direction(u[2], u[3]);
        const double light = cone_.solid_angle() / cone_.projected();
        return {
            entry_point(box_, direction, u[0], u[1]), direction,
            light * box_.projected_area(direction) / flux()};
    }
    [[nodiscard]] DirectionSample draw_direction(double u0, double u1) const override {
        return {-cone_.direction(1 - u0, u1), 1 / cone_.solid_angle()};
    }
    [[nodiscard]] double density(const Vec3& direction) const override {
        return cone_.contains(-direction) ? 1 / cone_.solid_angle() : 0;
    }

  private:
    static double flux_into(const Cone& cone, const EntryBox& box) {
        const auto through = [&](double area, double along) {
            return area * (cone.positive_part(along) + cone.positive_part(-along));
        };
        const Vec3& axis = cone.axis();
        return (through(box.face_area.x, axis.x) + through(box.face_area.y, axis.y) +
                through(box.face_area.z, axis.z)) /
               cone.projected();
    }

    Cone cone_;
    EntryBox box_;
};

class SunDisk final : public SourceModel {
  public:
    SunDisk(std::string name, const Cone& cone, std::vector<double> facing_irradiance)
        : SourceModel(
              std::move(name),
              std::move(facing_irradiance),
              kSunDiskTraits,
              cone.positive_part(cone.axis().z) / cone.projected()),
          cone_(cone) {}

    [[nodiscard]] ModelParameters parameters() const override {
        return {"sun_disk", {cone_.axis().x, cone_.axis().y, cone_.axis().z, cone_.radius()}};
    }
    [[nodiscard]] std::unique_ptr<SourceSampler> make_sampler_in(
        const SceneProjection& projection) const override {
        auto sampler = std::make_unique<DiskEmitter>(cone_, projection.entry_box());
        return sampler->flux() > 0 ? std::move(sampler) : nullptr;
    }
    [[nodiscard]] Illumination illuminate(const Vec3&, double u0, double u1) const override {
        return {cone_.direction(u0, u1), cone_.solid_angle() / cone_.projected()};
    }
    [[nodiscard]] double radiance(const Vec3& to_light) const override {
        return cone_.contains(to_light) ? 1 / cone_.projected() : 0;
    }
    [[nodiscard]] double most_irradiance(const Vec3& normal) const override {
        return cone_.most_positive_part(dot(normal, cone_.axis())) / cone_.projected();
    }

  private:
    Cone cone_;
};

}  // namespace

double solar_radius_deg(double distance_au) {
    EXPECT(distance_au > 0);
    constexpr double kRadiusAtOneAu = 959.63 / 3600;
    return kRadiusAtOneAu / distance_au;
}

std::shared_ptr<const Source> make_sun_disk(
    std::string name,
    const Vec3& to_sun,
    double angular_radius_deg,
    std::vector<double> facing_irradiance) {
    EXPECT(std::abs(length(to_sun) - 1) < 1e-9);
    EXPECT(angular_radius_deg > 0 && angular_radius_deg < 90);
    return std::make_shared<SunDisk>(
        std::move(name), Cone(to_sun, angular_radius_deg * pi / 180), std::move(facing_irradiance));
}

}  // namespace quasimc

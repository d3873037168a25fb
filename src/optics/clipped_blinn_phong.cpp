// The Blinn-Phong lobe cut off at the surface: the model `modified` of the original QuasiMC.
//
// Model    theta, the angle to the mirror direction (reflected) or the unchanged direction
//          (transmitted), follows cos^n(theta / 2) up to pi - alpha, where alpha is the elevation
//          of that direction above the surface; the azimuth about it is uniform in the arc that is
//          above the surface, of half-width H(theta):
//          p = (n + 2) / (8 H K) cos^n(theta / 2),  K = 1 - cos^(n+2)((pi - alpha) / 2).
//          The integral is 1 for any angle of incidence. Neither symmetric nor reciprocal; the
//          density grows without bound towards the one direction where H is 0, along the surface.
// Papers   Mech (1997), thesis. Cieslak et al. (2008), Functional Plant Biology 35, 837-849.
// Sampling cos(theta / 2) = (1 - u0 K)^(1 / (n + 2)), azimuth = (2 u1 - 1) H.
// Theory   docs/theory/leaf-and-soil-models.md

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <span>

#include "optics/bsdf.h"
#include "optics/directions.h"

namespace quasimc {
namespace {

/// The axis of a lobe over its surface.
struct Axis {
    Axis(Hemisphere hemisphere, const Vec3& n, const Vec3& wi)
        : direction(specular_direction(hemisphere, n, wi)),
          out(hemisphere == Hemisphere::reflected ? n : -n),
          sine(dot(direction, out)),
          cosine(length(direction - sine * out)) {}

    /// K: the fraction of the lobe at angles up to the largest one above the surface.
    [[nodiscard]] double within(double exponent) const {
        // The square of the cosine of half the angle pi - alpha.
        return 1 - std::pow((1 - cosine) / 2, exponent / 2 + 1);
    }
    /// Normal to the axis, towards the normal of the surface; any such direction if the axis is the
    /// normal.
    [[nodiscard]] Vec3 up() const {
        const Vec3 raw = out - sine * direction;
        constexpr double kRounding = 1e-12;
        if (!(length(raw) > kRounding)) {
            return frame_about(direction).s;
        }
        const Vec3 almost = normalized(raw);
        return normalized(almost - dot(almost, direction) * direction);
    }
    /// Half-width of the arc above the surface, of directions at an angle to the axis.
    [[nodiscard]] double half_width(double cos_theta, double sin_theta) const {
        const double height = sine * cos_theta, swing = cosine * sin_theta;
        return height >= swing || !(swing > 0) ? std::numbers::pi
                                               : std::acos(std::min(1.0, -height / swing));
    }

    Vec3 direction;
    Vec3 out;             ///< normal on the side where light leaves
    double sine, cosine;  ///< sine and cosine of the elevation alpha
};

class ClippedBlinnPhong final : public Bsdf {
  public:
    ClippedBlinnPhong(Hemisphere hemisphere, double exponent)
        : Bsdf(hemisphere), exponent_(exponent), two_over_power_(2 / (exponent + 2)) {}

    [[nodiscard]] Vec3 sample(const Vec3& n, const Vec3& wi, double u0, double u1) const override {
        const Axis axis(hemisphere(), n, wi);
        // Uses the square of the sine of half the angle, as blinn_phong.cpp does.
        const double sine2 =
            -std::expm1(two_over_power_ * std::log1p(-u0 * axis.within(exponent_)));
        const double cosine = 1 - 2 * sine2;
        const double sine = 2 * std::sqrt(sine2 * (1 - sine2));
        const double azimuth = (2 * u1 - 1) * axis.half_width(cosine, sine);
        const Vec3 up = axis.up();
        const Vec3 aside = cross(axis.direction, up);
        const Vec3 d = normalized(
            cosine * axis.direction + (sine * std::cos(azimuth)) * up +
            (sine * std::sin(azimuth)) * aside);
        return folded(hemisphere(), n, d);  // if rounding put it under the surface
    }

    [[nodiscard]] double pdf(const Vec3& n, const Vec3& wi, const Vec3& wo) const override {
        if (!(outgoing_cosine(hemisphere(), n, wo) > 0)) {
            return 0;
        }
        const Axis axis(hemisphere(), n, wi);
        const double cosine = dot(axis.direction, wo);
        const double sine = length(cross(axis.direction, wo));
        // Keeps the density finite in the one direction where the arc is a point.
        constexpr double kNarrowestArc = 1e-8;
        const double arc = std::max(axis.half_width(cosine, sine), kNarrowestArc);
        const double power = std::pow(std::max(0.0, 1 + cosine) / 2, exponent_ / 2);
        return (exponent_ + 2) / (8 * arc * axis.within(exponent_)) * power;
    }

    [[nodiscard]] ModelParameters parameters() const override {
        return {"clipped_blinn_phong", {exponent_}};
    }
    [[nodiscard]] bool is_reciprocal() const override { return false; }

  private:
    double exponent_, two_over_power_;
};

}  // namespace

/// The model `clipped_blinn_phong` of the catalogue.
std::unique_ptr<Bsdf> make_clipped_blinn_phong(
    Hemisphere hemisphere, std::span<const double> values) {
    return std::make_unique<ClippedBlinnPhong>(hemisphere, values[0]);
}

}  // namespace quasimc

// @Words@: what kind of surface it describes.
//
// What     p = (n + 1) / (2 pi) cos^n(theta) for theta <= 90 degrees about the specular direction.
//          What would leave on the wrong side is mirrored at the surface.
// Paper    Author (year), journal.
// Sampling cos = (1 - u0)^(1 / (n + 1)), azimuth = 2 pi u1.
// Theory   docs/theory/@page@.md
//
// A model that absorbs more at some angles than at others overrides relative_albedo and
// has_constant_albedo; pdf then still has the integral 1.

#include <cmath>
#include <memory>
#include <numbers>
#include <span>

#include "optics/bsdf.h"
#include "optics/directions.h"

namespace quasimc {
namespace {

class @Name@ final : public Bsdf {
  public:
    @Name@(Hemisphere hemisphere, double exponent) : Bsdf(hemisphere), exponent_(exponent) {}

    [[nodiscard]] Vec3 sample(const Vec3& n, const Vec3& wi, double u0, double u1) const override {
        const double sine2 = -std::expm1(2 / (exponent_ + 1) * std::log1p(-u0));
        const Vec3 axis = specular_direction(hemisphere(), n, wi);
        return folded(
            hemisphere(), n, direction_about(axis, std::sqrt(1 - sine2), std::sqrt(sine2), u1));
    }

    [[nodiscard]] double pdf(const Vec3& n, const Vec3& wi, const Vec3& wo) const override {
        if (!(outgoing_cosine(hemisphere(), n, wo) > 0)) {
            return 0;
        }
        return density(dot(wi, wo)) + density(dot(reflected(wi, n), wo));
    }

    [[nodiscard]] bool is_reciprocal() const override { return false; }

  private:
    [[nodiscard]] double density(double cosine) const {
        return cosine > 0
                   ? (exponent_ + 1) / (2 * std::numbers::pi) * std::pow(cosine, exponent_)
                   : 0;
    }

    double exponent_;
};

}  // namespace

/// The model `@name@` of the catalogue.
std::unique_ptr<Bsdf> make_@name@(Hemisphere hemisphere, std::span<const double> values) {
    return std::make_unique<@Name@>(hemisphere, values[0]);
}

}  // namespace quasimc

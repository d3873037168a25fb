// The cosine law under a smooth coat: a waxy leaf, whose Lambertian interior receives less of the
// light at grazing angles, as the coat reflects more of it.
//
// Model    p = cos(theta) / pi, as of the cosine law; the albedo is the given one times 1 - F,
//          with F = F0 + (1 - F0) (1 - cos(theta_i))^5 for the angle of arrival. Light that the
//          coat itself reflects is another lobe, or lost.
// Paper    Schlick (1994), Computer Graphics Forum 13(3), equation 15, for F.
// Sampling that of the cosine law.
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

class CoatedLambertian final : public Bsdf {
  public:
    /// @param coat  reflectance of the coat for light that comes along the normal, 0..1
    CoatedLambertian(Hemisphere hemisphere, double coat) : Bsdf(hemisphere), coat_(coat) {}

    [[nodiscard]] Vec3 sample(
        const Vec3& n, const Vec3& /*wi*/, double u0, double u1) const override {
        return cosine_direction(hemisphere() == Hemisphere::reflected ? n : -n, u0, u1);
    }

    [[nodiscard]] double pdf(const Vec3& n, const Vec3& /*wi*/, const Vec3& wo) const override {
        return std::max(0.0, outgoing_cosine(hemisphere(), n, wo)) * std::numbers::inv_pi;
    }

    [[nodiscard]] double relative_albedo(double cosine) const override {
        return (1 - coat_) * (1 - std::pow(1 - std::min(cosine, 1.0), 5));
    }
    [[nodiscard]] bool has_constant_albedo() const override { return false; }
    [[nodiscard]] ModelParameters parameters() const override {
        return {"coated_lambertian", {coat_}};
    }
    [[nodiscard]] bool is_reciprocal() const override { return false; }

  private:
    double coat_;
};

}  // namespace

/// The model `coated_lambertian` of the catalogue.
std::unique_ptr<Bsdf> make_coated_lambertian(
    Hemisphere hemisphere, std::span<const double> values) {
    return std::make_unique<CoatedLambertian>(hemisphere, values[0]);
}

}  // namespace quasimc

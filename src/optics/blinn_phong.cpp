#include "optics/blinn_phong.h"

#include <cmath>

#include "optics/directions.h"

namespace quasimc {
namespace {

class BlinnPhong final : public Bsdf {
  public:
    BlinnPhong(Hemisphere hemisphere, double exponent)
        : Bsdf(hemisphere),
          half_exponent_(exponent / 2),
          scale_((exponent + 2) / (8 * std::numbers::pi)),
          two_over_power_(2 / (exponent + 2)) {}

    [[nodiscard]] Vec3 sample(const Vec3& n, const Vec3& wi, double u0, double u1) const override {
        // Through the square of the sine of half the angle, which keeps its digits when the lobe is
        // narrow.
        const double sine2 = -std::expm1(two_over_power_ * std::log1p(-u0));
        const double cosine = 1 - 2 * sine2;
        const double sine = 2 * std::sqrt(sine2 * (1 - sine2));
        const Vec3 axis = specular_direction(hemisphere(), n, wi);
        return folded(hemisphere(), n, direction_about(axis, cosine, sine, u1));
    }

    [[nodiscard]] double pdf(const Vec3& n, const Vec3& wi, const Vec3& wo) const override {
        return folded_pdf(
            hemisphere(), n, wi, wo, [this](double cosine) { return density(cosine); });
    }

    [[nodiscard]] ModelParameters parameters() const override {
        return {"blinn_phong", {2 * half_exponent_}};
    }
    [[nodiscard]] bool is_reciprocal() const override { return false; }

  private:
    /// Before folding.
    [[nodiscard]] double density(double cosine) const {
        return cosine > -1 ? scale_ * std::pow((1 + cosine) / 2, half_exponent_) : 0;
    }

    double half_exponent_, scale_, two_over_power_;
};

}  // namespace

std::unique_ptr<Bsdf> make_blinn_phong(Hemisphere hemisphere, double exponent) {
    return std::make_unique<BlinnPhong>(hemisphere, exponent);
}

}  // namespace quasimc

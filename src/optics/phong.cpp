#include "optics/phong.h"

#include <cmath>

#include "optics/directions.h"

namespace quasimc {
namespace {

class Phong final : public Bsdf {
  public:
    Phong(Hemisphere hemisphere, double exponent)
        : Bsdf(hemisphere),
          exponent_(exponent),
          scale_((exponent + 1) / (2 * std::numbers::pi)),
          two_over_power_(2 / (exponent + 1)) {}

    [[nodiscard]] Vec3 sample(const Vec3& n, const Vec3& wi, double u0, double u1) const override {
        // Through the square of the sine, which keeps its digits when the lobe is narrow.
        const double sine2 = -std::expm1(two_over_power_ * std::log1p(-u0));
        const Vec3 axis = specular_direction(hemisphere(), n, wi);
        return folded(
            hemisphere(), n, direction_about(axis, std::sqrt(1 - sine2), std::sqrt(sine2), u1));
    }

    [[nodiscard]] double pdf(const Vec3& n, const Vec3& wi, const Vec3& wo) const override {
        return folded_pdf(
            hemisphere(), n, wi, wo, [this](double cosine) { return density(cosine); });
    }

    [[nodiscard]] ModelParameters parameters() const override { return {"phong", {exponent_}}; }
    [[nodiscard]] bool is_reciprocal() const override { return false; }

  private:
    /// Before folding.
    [[nodiscard]] double density(double cosine) const {
        return cosine > 0 ? scale_ * std::pow(cosine, exponent_) : 0;
    }

    double exponent_, scale_, two_over_power_;
};

}  // namespace

std::unique_ptr<Bsdf> make_phong(Hemisphere hemisphere, double exponent) {
    return std::make_unique<Phong>(hemisphere, exponent);
}

}  // namespace quasimc

#include "optics/bsdf.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace quasimc {

double Bsdf::relative_albedo(double /*cosine*/) const {
    return 1;
}

double Bsdf::bsdf(const Vec3& n, const Vec3& wi, const Vec3& wo) const {
    constexpr double kAlongTheSurface = 1e-100;  // smaller ones could overflow
    const double cosine = std::abs(dot(wo, n));
    if (!(cosine > kAlongTheSurface)) {
        return 0;
    }
    const double shape = pdf(n, wi, wo) / cosine;
    return has_constant_albedo() ? shape : relative_albedo(std::abs(dot(wi, n))) * shape;
}

double peak_brightness(const Bsdf& lobe) {
    if (lobe.is_delta()) {
        return std::numeric_limits<double>::infinity();
    }
    const Vec3 n{0, 0, 1};
    const double away = lobe.hemisphere() == Hemisphere::reflected ? 1 : -1;
    return std::numbers::pi * lobe.pdf(n, -n, away * n);
}

bool is_narrow(const Bsdf& lobe) {
    return peak_brightness(lobe) >= kNarrowPeak;
}

}  // namespace quasimc

#include "optics/bsdf.h"

#include <cmath>

namespace quasimc {

double Bsdf::relative_albedo(double /*cosine*/) const {
    return 1;
}

double Bsdf::bsdf(const Vec3& n, const Vec3& wi, const Vec3& wo) const {
    constexpr double kAlongTheSurface = 1e-100;  // what is nearer could overflow
    const double cosine = std::abs(dot(wo, n));
    if (!(cosine > kAlongTheSurface)) {
        return 0;
    }
    const double shape = pdf(n, wi, wo) / cosine;
    return has_constant_albedo() ? shape : relative_albedo(std::abs(dot(wi, n))) * shape;
}

}  // namespace quasimc

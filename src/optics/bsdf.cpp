#include "optics/bsdf.h"

#include <cmath>

namespace quasimc {

double Bsdf::bsdf(const Vec3& n, const Vec3& wi, const Vec3& wo) const {
    constexpr double kAlongTheSurface = 1e-100;  // what is nearer could overflow
    const double cosine = std::abs(dot(wo, n));
    return cosine > kAlongTheSurface ? pdf(n, wi, wo) / cosine : 0;
}

}  // namespace quasimc

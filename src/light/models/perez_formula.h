#pragma once

#include <algorithm>
#include <cmath>

#include "base/vec3.h"

namespace quasimc {

/// (1 + a exp(b / cos zenith)) (1 + c exp(d gamma) + e cos^2 gamma), gamma the angle to the sun
/// (Perez, Seals and Michalsky 1993, equation 1). Where a fit falls below 0 the sky is black.
struct PerezFormula {
    double a = 0, b = 0, c = 0, d = 0, e = 0;  ///< b <= 0

    [[nodiscard]] double radiance(const Vec3& to_light, const Vec3& to_sun) const {
        const double gamma = 2 * std::asin(std::min(1.0, 0.5 * length(to_light - to_sun)));
        const double cosine = dot(to_light, to_sun);
        const double gradation = 1 + a * (b < 0 ? std::exp(b / to_light.z) : 1);
        const double indicatrix = 1 + c * std::exp(d * gamma) + e * cosine * cosine;
        return std::max(0.0, gradation) * std::max(0.0, indicatrix);
    }
};

}  // namespace quasimc

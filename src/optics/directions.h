#pragma once

#include <cmath>
#include <numbers>

#include "base/vec3.h"
#include "optics/bsdf.h"
#include "optics/turn.h"

namespace quasimc {

/// The unit vector at an angle to the unit vector `axis` whose cosine and sine are given, and at
/// azimuth 2 pi u1 about it.
inline Vec3 direction_about(const Vec3& axis, double cosine, double sine, double u1) {
    const Frame frame = frame_about(axis);
    const SinCos azimuth = sin_cos_turn(u1);
    return (sine * azimuth.cos) * frame.s + (sine * azimuth.sin) * frame.t + cosine * axis;
}

/// A direction with density dot(n, wo) / pi about the unit normal `n` (Malley's method): the square
/// of the cosine is 1 - u0, so never 0, and the azimuth 2 pi u1.
inline Vec3 cosine_direction(const Vec3& n, double u0, double u1) {
    return direction_about(n, std::sqrt(1 - u0), std::sqrt(u0), u1);
}

/// The cosine of `wo` with the normal on the side where the lobe leaves: negative on the other.
inline double outgoing_cosine(Hemisphere hemisphere, const Vec3& n, const Vec3& wo) {
    return hemisphere == Hemisphere::reflected ? dot(wo, n) : -dot(wo, n);
}

/// The specular direction of a smooth surface: mirrored, or unchanged.
inline Vec3 specular_direction(Hemisphere hemisphere, const Vec3& n, const Vec3& wi) {
    return hemisphere == Hemisphere::reflected ? reflected(wi, n) : wi;
}

/// `d` if it is in the hemisphere, otherwise its mirror image at the surface, which is.
inline Vec3 folded(Hemisphere hemisphere, const Vec3& n, const Vec3& d) {
    return outgoing_cosine(hemisphere, n, d) >= 0 ? d : reflected(d, n);
}

/// The density of a folded lobe: `density(cosine)` is that before folding, of the cosine with the
/// specular direction. The lobe about one axis at `wo` and at the image of `wo`: the latter equals
/// the lobe about the image of the axis at `wo`.
template <typename Density>
double folded_pdf(
    Hemisphere hemisphere, const Vec3& n, const Vec3& wi, const Vec3& wo, const Density& density) {
    if (!(outgoing_cosine(hemisphere, n, wo) > 0)) {
        return 0;
    }
    const double unchanged = dot(wi, wo);
    const double mirrored = dot(reflected(wi, n), wo);
    return density(unchanged) + density(mirrored);
}

}  // namespace quasimc

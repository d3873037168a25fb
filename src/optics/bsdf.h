#pragma once

#include "base/model_parameters.h"
#include "base/vec3.h"

namespace quasimc {

/// The side of the surface where light leaves, relative to the side of arrival.
enum class Hemisphere { reflected, transmitted };

/// The directional distribution of scattered light: the shape of one lobe, without its amount. (A
/// material adds the amounts: one albedo per band for each of its lobes.) The amount may depend on
/// the angle at which light arrives, equally in all bands: see relative_albedo.
///
/// Directions are directions of travel, unit length: `wi` before, `wo` after. `n` is the unit
/// normal of the side on which the light arrives, so dot(wi, n) < 0; reflected light has dot(wo, n)
/// > 0, transmitted dot(wo, n) < 0. Backward paths meet the same lobe with -wo for wi: see
/// Material::gather.
class Bsdf {
  public:
    virtual ~Bsdf() = default;
    explicit Bsdf(Hemisphere hemisphere) : hemisphere_(hemisphere) {}
    Bsdf(const Bsdf&) = delete;
    Bsdf& operator=(const Bsdf&) = delete;

    [[nodiscard]] Hemisphere hemisphere() const { return hemisphere_; }
    /// The model and its parameters, except the hemisphere.
    [[nodiscard]] virtual ModelParameters parameters() const = 0;

    /// A direction of the lobe from a point of the unit square [0, 1)^2; area-preserving in the
    /// measure `pdf`. u0 moves it away from the axis of the lobe, u1 around it.
    [[nodiscard]] virtual Vec3 sample(
        const Vec3& n, const Vec3& wi, double u0, double u1) const = 0;

    /// Density [1/sr] of `sample` at `wo`; its integral over the lobe's hemisphere is 1 for every
    /// `wi`; relative_albedo has the losses. 0 outside the hemisphere, and everywhere for a delta
    /// lobe (see is_delta).
    [[nodiscard]] virtual double pdf(const Vec3& n, const Vec3& wi, const Vec3& wo) const = 0;

    /// Light scattered by this lobe relative to its given albedo, 0 ... 1, for light that arrives
    /// at an angle of `cosine` = |dot(wi, n)| to the normal: 1, except for some models (a waxy
    /// surface, which reflects more at grazing angles). The given albedo is then the largest.
    [[nodiscard]] virtual double relative_albedo(double cosine) const;

    /// Whether relative_albedo is 1 at every angle, for which faster code exists.
    [[nodiscard]] virtual bool has_constant_albedo() const { return true; }

    /// relative_albedo pdf / |dot(wo, n)| [1/sr]: the bidirectional scattering distribution
    /// function of a surface of albedo 1. Grows without bound towards a grazing `wo` unless the
    /// model prevents it; 0 along the surface itself. Finite everywhere.
    [[nodiscard]] virtual double bsdf(const Vec3& n, const Vec3& wi, const Vec3& wo) const;

    /// Whether all light goes in one direction: a delta lobe (mirror).
    [[nodiscard]] virtual bool is_delta() const { return false; }

    /// Whether `bsdf` is the same with -wo and -wi exchanged (Helmholtz reciprocity).
    [[nodiscard]] virtual bool is_reciprocal() const = 0;

    /// Whether the lobe is the cosine law with a constant albedo, for which faster code exists.
    [[nodiscard]] virtual bool is_lambertian() const { return false; }

  private:
    Hemisphere hemisphere_;
};

/// Brightness of the peak of a lobe over that of the cosine law, for light along the normal:
/// infinite for delta lobes.
[[nodiscard]] double peak_brightness(const Bsdf& lobe);

/// The peak_brightness from which on a lobe is narrow. Phong: an exponent of 49.
inline constexpr double kNarrowPeak = 25;

/// Whether directions to lights, sampled independently of a lobe, are hardly ever within it. Light
/// through such lobes is sampled by the lobe, not by next-event estimation.
[[nodiscard]] bool is_narrow(const Bsdf& lobe);

}  // namespace quasimc

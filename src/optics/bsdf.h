#pragma once

#include "base/model_parameters.h"
#include "base/vec3.h"

namespace quasimc {

/// On which side of the surface light leaves, seen from where it arrived.
enum class Hemisphere { reflected, transmitted };

/// How light that a surface scatters is spread over directions: the shape of one lobe, without its
/// amount. (A material adds the amounts: one albedo per band for each of its lobes.) The amount may
/// depend on the angle at which light arrives, in all bands alike: see relative_albedo.
///
/// Directions are those in which light travels, unit length: `wi` before, `wo` after. `n` is the
/// unit normal of the side on which the light arrives, so dot(wi, n) < 0; reflected light has
/// dot(wo, n) > 0, transmitted dot(wo, n) < 0. Light followed backwards meets the same lobe with
/// -wo for wi: see Material::gather.
class Bsdf {
  public:
    virtual ~Bsdf() = default;
    explicit Bsdf(Hemisphere hemisphere) : hemisphere_(hemisphere) {}
    Bsdf(const Bsdf&) = delete;
    Bsdf& operator=(const Bsdf&) = delete;

    [[nodiscard]] Hemisphere hemisphere() const { return hemisphere_; }
    /// The model and its parameters, but for the hemisphere.
    [[nodiscard]] virtual ModelParameters parameters() const = 0;

    /// A direction of the lobe from a point of the unit square [0, 1)^2; area-preserving in the
    /// measure `pdf`. u0 moves it away from the axis of the lobe, u1 around it.
    [[nodiscard]] virtual Vec3 sample(
        const Vec3& n, const Vec3& wi, double u0, double u1) const = 0;

    /// Density [1/sr] of `sample` at `wo`; its integral over the lobe's hemisphere is 1 whatever
    /// `wi`: what is lost, relative_albedo says. 0 outside the hemisphere, and everywhere for a
    /// lobe of one direction (see is_delta).
    [[nodiscard]] virtual double pdf(const Vec3& n, const Vec3& wi, const Vec3& wo) const = 0;

    /// Light scattered by this lobe relative to its stated albedo, 0 ... 1, when light arrives at
    /// an angle of `cosine` = |dot(wi, n)| to the normal: 1 unless the model says otherwise (a
    /// waxy surface, which reflects more at grazing angles). The stated albedo is then the largest.
    [[nodiscard]] virtual double relative_albedo(double cosine) const;

    /// Whether relative_albedo is 1 at every angle, for which faster code exists.
    [[nodiscard]] virtual bool has_constant_albedo() const { return true; }

    /// relative_albedo pdf / |dot(wo, n)| [1/sr]: the bidirectional scattering distribution
    /// function of a surface of stated albedo 1. Grows without bound towards a grazing `wo` unless
    /// the model prevents it; 0 along the surface itself. Finite everywhere.
    [[nodiscard]] virtual double bsdf(const Vec3& n, const Vec3& wi, const Vec3& wo) const;

    /// Whether all light goes in one direction (mirror).
    [[nodiscard]] virtual bool is_delta() const { return false; }

    /// Whether `bsdf` is the same with -wo and -wi exchanged (Helmholtz reciprocity).
    [[nodiscard]] virtual bool is_reciprocal() const = 0;

    /// Whether the lobe is the cosine law with a constant albedo, for which faster code exists.
    [[nodiscard]] virtual bool is_lambertian() const { return false; }

  private:
    Hemisphere hemisphere_;
};

/// How much brighter a lobe is at its peak than the cosine law, light arriving straight on:
/// infinite for one of one direction.
[[nodiscard]] double peak_brightness(const Bsdf& lobe);

/// The peak_brightness from which on a lobe is sharp. Phong: an exponent of 49.
inline constexpr double kSharpPeak = 25;

/// Whether a lobe is so narrow that one of many directions to a light that are drawn without regard
/// to it hardly ever lies within it. Such lobes are followed, not looked through.
[[nodiscard]] bool is_narrow(const Bsdf& lobe);

}  // namespace quasimc

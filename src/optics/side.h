#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/checks.h"
#include "base/vec3.h"
#include "optics/lobe_table.h"

namespace quasimc {

/// One side of a material, ready for tracing: all bands share the list of distinct lobes.
///
/// Scattering carries all bands on one path. With weights w_b >= 0 before the hit, lobe k is
/// followed with probability q_k = sum_b w_b a_kb / sum_b w_b (so the path survives with the mean
/// albedo, and the mean of the weights never changes), and the weights become
/// w_b sum_k a_kb p_k(wo) / sum_k q_k p_k(wo), the sums over the lobes that can give `wo` (balance
/// heuristic, Veach and Guibas 1995): unbiased in every band. See docs/theory/what-is-computed.md.
class Side {
  public:
    /// @param lobes  of which the sum of albedos is at most 1 in each band, at every angle. Those
    ///               of one direction in the same hemisphere are merged, as are Lambertian ones;
    ///               those without albedo are left out.
    Side(const std::vector<Lobe>& lobes, std::size_t bands);

    [[nodiscard]] const std::vector<Lobe>& lobes() const { return lobes_; }
    /// rho + tau per band, as stated: a bound where the albedo depends on the angle.
    [[nodiscard]] std::span<const double> albedo() const { return albedo_; }
    /// 1 - rho - tau per band: a bound from below where the albedo depends on the angle.
    [[nodiscard]] std::span<const double> absorptance() const { return absorptance_; }
    /// Whether albedo() and absorptance() hold for light from every direction.
    [[nodiscard]] bool has_constant_albedo() const { return table_.has_constant_albedo(); }
    /// Fraction of the light of a band that is scattered when it arrives at an angle of `cosine` =
    /// |dot(wi, n)| to the normal.
    [[nodiscard]] double albedo(std::size_t band, double cosine) const;
    /// 1 - albedo(band, cosine): the fraction that is absorbed.
    [[nodiscard]] double absorptance(std::size_t band, double cosine) const {
        return has_constant_albedo() ? absorptance_[band] : 1 - albedo(band, cosine);
    }
    /// Whether some lobe is of one direction.
    [[nodiscard]] bool has_delta() const { return has_delta_; }
    /// peak_brightness() of the sharpest lobe; 0 if nothing is scattered.
    [[nodiscard]] double sharpest_peak() const { return sharpest_peak_; }

    /// What follows a hit.
    struct Scattered {
        Vec3 wo;
        bool delta = false;  ///< by a lobe of one direction
    };

    /// Scatters light that travels along `wi` at a surface with normal `n` (of the side it arrives
    /// on).
    /// @param weights  one per band; changed to those after the hit when the light survives
    /// @return nothing if the light ends here: absorbed, or all weights 0
    [[nodiscard]] std::optional<Scattered> scatter(
        const Vec3& n, const Vec3& wi, const Draw& draw, std::span<double> weights) const;

    /// The same in two steps, for which the second number need not be drawn where the light ends.
    [[nodiscard]] LobeTable::Choice choose(
        const Vec3& n, const Vec3& wi, const Draw& draw, std::span<const double> weights) const {
        return table_.choose(n, wi, draw, weights);
    }
    /// The same for a side of constant albedo.
    [[nodiscard]] LobeTable::Choice choose(
        const Draw& draw, std::span<const double> weights) const {
        EXPECT(has_constant_albedo());
        return table_.choose(draw, weights);
    }
    /// @param choice  with a lobe
    [[nodiscard]] Scattered scatter_by(
        const LobeTable::Choice& choice,
        const Vec3& n,
        const Vec3& wi,
        double u1,
        std::span<double> weights) const;

    /// The same of the light that goes by the chosen lobe alone, not weighed against others.
    [[nodiscard]] Scattered scatter_by_alone(
        const LobeTable::Choice& choice,
        const Vec3& n,
        const Vec3& wi,
        double u1,
        std::span<double> weights) const;

    /// Adds to out[b] the light that is sent in a direction `wo`, per steradian, of weights[b] that
    /// travels along `wi`: by lobes whose peak_brightness() is below `narrow_from`.
    void add_scattered(
        const Vec3& n,
        const Vec3& wi,
        const Vec3& wo,
        double narrow_from,
        std::span<const double> weights,
        std::span<double> out) const;

  private:
    std::vector<Lobe> lobes_;
    LobeTable table_;
    std::vector<double> albedo_, absorptance_;
    double sharpest_peak_ = 0;
    bool has_delta_ = false;
};

}  // namespace quasimc

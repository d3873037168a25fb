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
/// sampled with probability q_k = sum_b w_b a_kb / sum_b w_b (so the path survives with the mean
/// albedo, and the mean of the weights never changes), and the weights become w_b sum_k a_kb
/// p_k(wo) / sum_k q_k p_k(wo), the sums over the lobes that can give `wo` (balance heuristic,
/// Veach and Guibas 1995): unbiased in every band. See docs/theory/what-is-computed.md.
class Side {
  public:
    /// @param lobes  of which the sum of albedos is at most 1 in each band, at every angle. Delta
    /// lobes in the same hemisphere are merged, and so are Lambertian ones; lobes without albedo
    /// are omitted.
    Side(const std::vector<Lobe>& lobes, std::size_t bands);

    [[nodiscard]] const std::vector<Lobe>& lobes() const { return lobes_; }
    /// rho + tau per band, as given: an upper bound if the albedo depends on the angle.
    [[nodiscard]] std::span<const double> albedo() const { return albedo_; }
    /// 1 - rho - tau per band: a lower bound if the albedo depends on the angle.
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
    /// Whether there is a delta lobe.
    [[nodiscard]] bool has_delta() const { return has_delta_; }
    /// Largest peak_brightness() of a lobe; 0 if nothing is scattered.
    [[nodiscard]] double largest_peak() const { return largest_peak_; }

    /// Scattered light after a hit.
    struct Scattered {
        Vec3 wo;
        bool delta = false;  ///< by a delta lobe
    };

    /// Scatters light that travels along `wi` at a surface with normal `n` (of the side it arrives
    /// on).
    /// @param weights  one per band; changed to the weights after the hit if the light survives
    /// @return nothing if the light ends here: absorbed, or all weights 0
    [[nodiscard]] std::optional<Scattered> scatter(
        const Vec3& n, const Vec3& wi, const Draw& draw, std::span<double> weights) const;

    /// The first of two steps of scatter(): the second random number is not needed if the light
    /// ends.
    [[nodiscard]] LobeTable::Choice choose(
        const Vec3& n, const Vec3& wi, const Draw& draw, std::span<const double> weights) const {
        return table_.choose(n, wi, draw, weights);
    }
    /// choose() for a side of constant albedo.
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

    /// scatter_by() for the light of the chosen lobe only, not combined with other lobes.
    [[nodiscard]] Scattered scatter_by_alone(
        const LobeTable::Choice& choice,
        const Vec3& n,
        const Vec3& wi,
        double u1,
        std::span<double> weights) const;

    /// Adds to out[b] the light of weights[b] along `wi` that lobes with a peak_brightness() below
    /// `narrow_from` scatter in a direction `wo`, per steradian.
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
    double largest_peak_ = 0;
    bool has_delta_ = false;
};

}  // namespace quasimc

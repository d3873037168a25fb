#pragma once

#include <algorithm>
#include <cstddef>

#include "solvers/ray_bundles/patch_scene.h"
#include "solvers/ray_bundles/patch_sides.h"

namespace quasimc {

/// Scatters the light on single patches of PatchLight, in the bands of a pack.
template <std::size_t kBands>
class PatchScatter {
  public:
    struct Sent {
        std::size_t patch = 0;
        double area = 0;
        double share = 1;  ///< factor on the incident flux
    };

    /// @param sides  in the bands of a pack
    /// @param first_band  of the pack
    /// @param sum  receives the exitance of the previous order, [2 * patch + side][band]; or null
    PatchScatter(const PatchSides<0>& sides, std::size_t first_band, double* sum)
        : sides_(sides), first_band_(first_band), sum_(sum) {}

    /// Adds the exitance to the sum, sets it to the light that is scattered, and clears the
    /// incident light.
    /// @param scattered  receives the flux that leaves, [band]
    void scatter(
        const PatchOptics& upper,
        const PatchOptics& lower,
        const Sent& sent,
        double* scattered) const {
        scatter_side(2 * sent.patch, upper, lower, sent, scattered);
        scatter_side(2 * sent.patch + 1, lower, upper, sent, scattered);
        clear_incident(sent.patch);
    }
    void clear_incident(std::size_t patch) const {
        std::fill_n(sides_.incident(2 * patch), sides_.columns(), 0.0);
        std::fill_n(sides_.incident(2 * patch + 1), sides_.columns(), 0.0);
    }

    /// Incident light of a patch, on both sides: numbers.
    [[nodiscard]] std::size_t row() const { return 2 * sides_.columns(); }
    void add_incident(std::size_t patch, double part, double* row) const {
        for (std::size_t side = 0; side < 2; ++side, row += sides_.columns()) {
            const double* came = sides_.incident(2 * patch + side);
            for (std::size_t b = 0; b < sides_.columns(); ++b) {
                row[b] += part * came[b];
            }
        }
    }
    void set_incident(std::size_t patch, const double* row) const {
        for (std::size_t side = 0; side < 2; ++side, row += sides_.columns()) {
            std::copy_n(row, sides_.columns(), sides_.incident(2 * patch + side));
        }
    }

  private:
    void scatter_side(
        std::size_t side,
        const PatchOptics& own,
        const PatchOptics& other,
        const Sent& sent,
        double* scattered) const {
        const double per_area = sent.area > 0 ? sent.share / sent.area : 0;
        const double* reflected = own.reflected.data() + first_band_;
        const double* transmitted = other.transmitted.data() + first_band_;
        const double* came = sides_.incident(side);
        const double* across = sides_.incident(side ^ 1U);
        double* out = sides_.exitance(side);
        double* sum = sum_ == nullptr ? nullptr : sum_ + side * sides_.columns();
        for (std::size_t b = 0; b < sides_.columns(); ++b) {
            if (sum != nullptr) {
                sum[b] += out[b];
            }
            out[b] = (reflected[b] * came[b] + transmitted[b] * across[b]) * per_area;
            scattered[b] += out[b] * sent.area;
        }
    }

    PatchSides<kBands> sides_;
    std::size_t first_band_;
    double* sum_;
};

}  // namespace quasimc

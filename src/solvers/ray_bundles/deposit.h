#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "solvers/ray_bundles/patch_light.h"

namespace quasimc {

/// Bands of a pack that a source lights, and its light in each.
struct LitBands {
    PatchSides<0> sides;              ///< in the bands of the pack
    std::size_t first = 0;            ///< in the pack
    std::span<const double> weights;  ///< per band, from the first on

    /// Adds `amount` times the weights to the light on a side.
    void add(std::size_t side, double amount) const {
        double* to = sides.incident(side) + first;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            to[i] += amount * weights[i];
        }
    }
    void fetch(std::size_t side) const { sides.fetch_incident(side, first, weights.size()); }
};

/// All bands that a source lights, pack by pack; of those between them, some may get 0.
/// @param weights  of all columns, which must outlive it
[[nodiscard]] inline std::vector<LitBands> lit_bands(
    PatchLight& light, std::span<const double> weights) {
    const auto is_lit = [](double weight) { return weight != 0; };
    std::vector<LitBands> lit;
    for (std::size_t p = 0; p < light.packs().size(); ++p) {
        const BandPack& pack = light.packs()[p];
        const auto own = weights.subspan(pack.first, pack.bands);
        const auto first = std::find_if(own.begin(), own.end(), is_lit);
        if (first != own.end()) {
            const auto end = std::find_if(own.rbegin(), own.rend(), is_lit).base();
            lit.push_back(
                {light.sides(p), static_cast<std::size_t>(first - own.begin()), {first, end}});
        }
    }
    return lit;
}

/// Adds `amount` times the light of all bands.
inline void add_to(std::span<const LitBands> lit, std::size_t side, double amount) {
    for (const LitBands& bands : lit) {
        bands.add(side, amount);
    }
}

/// Adds light to patches some additions later, in the same order: by then their data have been
/// prefetched.
class PrefetchedAdds {
  public:
    /// Adds all light that `add_all(adds)` adds.
    template <typename AddAll>
    static void add(std::span<const LitBands> lit, const AddAll& add_all) {
        PrefetchedAdds adds(lit);
        add_all(adds);
        adds.add_rest();
    }

    void add(std::size_t side, double amount) {
        for (const LitBands& bands : lit_) {
            bands.fetch(side);
        }
        Add& oldest = adds_[count_ % kLate];
        if (count_++ >= kLate) {
            add_to(lit_, oldest.side, oldest.amount);
        }
        oldest = {side, amount};
    }

  private:
    static constexpr std::size_t kLate = 16;
    struct Add {
        std::size_t side = 0;
        double amount = 0;
    };

    explicit PrefetchedAdds(std::span<const LitBands> lit) : lit_(lit) {}

    void add_rest() const {
        for (std::size_t i = count_ > kLate ? count_ - kLate : 0; i < count_; ++i) {
            const Add& each = adds_[i % kLate];
            add_to(lit_, each.side, each.amount);
        }
    }

    std::span<const LitBands> lit_;
    std::array<Add, kLate> adds_{};
    std::size_t count_ = 0;
};

}  // namespace quasimc

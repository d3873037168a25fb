#include "solvers/band_packs.h"

namespace quasimc {

std::vector<LitBands> lit_bands(std::span<const BandPack> packs, std::span<const double> weights) {
    const auto is_lit = [](double weight) { return weight != 0; };
    std::vector<LitBands> lit;
    for (std::size_t p = 0; p < packs.size(); ++p) {
        const auto own = weights.subspan(packs[p].first, packs[p].bands);
        const auto first = std::find_if(own.begin(), own.end(), is_lit);
        if (first != own.end()) {
            const auto end = std::find_if(own.rbegin(), own.rend(), is_lit).base();
            lit.push_back({p, static_cast<std::size_t>(first - own.begin()), {first, end}});
        }
    }
    return lit;
}

}  // namespace quasimc

#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace quasimc {

/// Bands whose light on patches stands side by side.
struct BandPack {
    std::size_t first = 0, bands = 0;
};

/// Few bands are one pack. Many are several: light that goes from patch to patch all over a scene
/// is fast as long as caches hold what is known of the patches, and in all bands at once it would
/// come from memory again and again.
[[nodiscard]] inline std::vector<BandPack> band_packs(std::size_t bands) {
    constexpr std::size_t kMostTogether = 5, kPack = 4;  // for_bands() has loops for these
    const std::size_t each = bands <= kMostTogether ? bands : kPack;
    std::vector<BandPack> packs;
    for (std::size_t first = 0; first < bands; first += each) {
        packs.push_back({first, std::min(each, bands - first)});
    }
    return packs;
}

/// Bands of a pack that a source lights, and what it brings to each.
struct LitBands {
    std::size_t pack = 0;
    std::size_t first = 0;            ///< in the pack
    std::span<const double> weights;  ///< of the bands from the first on
};

/// All bands that a source lights, pack by pack; of those between them, some may get 0.
/// @param weights  of all bands, which must outlive it
[[nodiscard]] std::vector<LitBands> lit_bands(
    std::span<const BandPack> packs, std::span<const double> weights);

}  // namespace quasimc

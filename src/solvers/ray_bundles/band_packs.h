#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace quasimc {

/// Bands whose light on patches stands side by side.
struct BandPack {
    std::size_t first = 0, bands = 0;
};

/// Bands of a pack, at most.
inline constexpr std::size_t kMaxInPack = 5;

/// Few bands are one pack. Many are several: light that goes from patch to patch all over a scene
/// is fast as long as caches hold what is known of the patches, and in all bands at once it would
/// come from memory again and again.
[[nodiscard]] inline std::vector<BandPack> band_packs(std::size_t bands) {
    constexpr std::size_t kPack = 4;  // with 5 to 16 a season's directions take as long
    const std::size_t each = bands <= kMaxInPack ? bands : kPack;
    std::vector<BandPack> packs;
    for (std::size_t first = 0; first < bands; first += each) {
        packs.push_back({first, std::min(each, bands - first)});
    }
    return packs;
}

}  // namespace quasimc

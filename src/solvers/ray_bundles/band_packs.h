#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace quasimc {

/// Bands whose light on patches is stored side by side.
struct BandPack {
    std::size_t first = 0, bands = 0;
};

/// Bands of a pack, at most.
inline constexpr std::size_t kMaxInPack = 5;

/// Cuts bands into packs. Few bands are one pack. Many are several, so that caches hold the data of
/// patches in one pack: an exchange accesses patches all over a scene.
[[nodiscard]] inline std::vector<BandPack> band_packs(std::size_t bands) {
    constexpr std::size_t kPack = 4;  // 5 to 16 take as long for daylight coefficients
    const std::size_t each = bands <= kMaxInPack ? bands : kPack;
    std::vector<BandPack> packs;
    for (std::size_t first = 0; first < bands; first += each) {
        packs.push_back({first, std::min(each, bands - first)});
    }
    return packs;
}

}  // namespace quasimc

#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace quasimc {

/// Columns whose light on patches is stored side by side: solved bands, of one origin of light or
/// of all.
struct BandPack {
    std::size_t first = 0, bands = 0;
};

/// Bands of a pack, at most.
inline constexpr std::size_t kMaxInPack = 5;

/// Cuts columns into packs. Few columns are one pack. Many are several, so that caches hold the
/// data of patches in one pack: an exchange accesses patches all over a scene. The packs of all
/// origins then have the same bands, whose orders of scattering end together.
/// @param bands  of each origin
[[nodiscard]] inline std::vector<BandPack> band_packs(std::size_t bands, std::size_t origins = 1) {
    constexpr std::size_t kPack = 4;  // 5 to 16 take as long for daylight coefficients
    if (bands * origins <= kMaxInPack) {
        return {{0, bands * origins}};
    }
    const std::size_t each = bands <= kMaxInPack ? bands : kPack;
    std::vector<BandPack> packs;
    for (std::size_t origin = 0; origin < origins; ++origin) {
        for (std::size_t first = 0; first < bands; first += each) {
            packs.push_back({origin * bands + first, std::min(each, bands - first)});
        }
    }
    return packs;
}

}  // namespace quasimc

#include "series/basis/bin_places.h"

namespace quasimc {

SumLayout common_layout(const Scene& scene) {
    return {
        .regions = scene.regions().size(),
        .spectra = scene.bands().size(),
        .bands = scene.bands().size(),
        .patch_levels = PatchLevels::two};
}

std::vector<BinPart> bin_parts(const SumLayout& layout) {
    SumLayout one = layout;
    one.regions = 1;
    std::vector<BinPart> parts(one.bins());
    using Kind = BinPart::Kind;
    const std::size_t bands = one.bands;
    for (std::size_t b = 0; b < bands; ++b) {
        for (const SurfaceSide side : kSurfaceSides) {
            parts[one.direct(0, side, b)] = {Kind::direct, b};
            parts[one.scattered(0, side) + b] = {Kind::scattered, b};
            parts[one.coarse_scattered(0, side) + b] = {Kind::scattered, b};
        }
        parts[one.emitted() + b] = parts[one.escaped_direct() + b] = {Kind::direct, b};
        for (const std::size_t first :
             {one.escaped_scattered(), one.scattered_out(), one.cut_off(), one.coarse_escaped(),
              one.coarse_escaped() + bands, one.coarse_escaped() + 2 * bands}) {
            parts[first + b] = {Kind::scattered, b};
        }
    }
    parts[one.sunlit(0)] = {Kind::sunlit, 0};
    return parts;
}

}  // namespace quasimc

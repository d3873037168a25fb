#pragma once

#include <cstddef>

#include "base/checks.h"
#include "solvers/ray_bundles/band_packs.h"

namespace quasimc {

/// Calls `f.template operator()<kBands>()` with the number of bands of a pack, so that loops over
/// them have a length that the compiler knows.
template <typename F>
void for_bands(std::size_t bands, const F& f) {
    static_assert(kMaxInPack == 5);
    EXPECT(1 <= bands && bands <= kMaxInPack);
    switch (bands) {
        case 1:
            return f.template operator()<1>();
        case 2:
            return f.template operator()<2>();
        case 3:
            return f.template operator()<3>();
        case 4:
            return f.template operator()<4>();
        default:
            return f.template operator()<kMaxInPack>();
    }
}

}  // namespace quasimc

#pragma once

#include <cstddef>

namespace quasimc {

/// Calls `f.template operator()<kBands>()`: with the number of bands where it is small, so that
/// loops over bands have a length that the compiler knows; with 0, for any number, else.
template <typename F>
void for_bands(std::size_t bands, const F& f) {
    switch (bands) {
        case 1:
            return f.template operator()<1>();
        case 2:
            return f.template operator()<2>();
        case 3:
            return f.template operator()<3>();
        case 4:
            return f.template operator()<4>();
        case 5:
            return f.template operator()<5>();
        default:
            return f.template operator()<0>();
    }
}

}  // namespace quasimc

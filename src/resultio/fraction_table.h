#pragma once

#include <array>
#include <string_view>

#include "quasimc/result.h"

namespace quasimc {

/// One row of the table of fractions.
struct FractionEntry {
    std::string_view name;     ///< "reflectance"
    std::string_view summary;  ///< one line for the manual
    Estimate CanopyFractions::*part;
};

/// The fractions of CanopyFractions, in the order in which they are written.
[[nodiscard]] constexpr std::array<FractionEntry, 4> fraction_table() {
    return {{
        {"reflectance", "light that leaves upwards / light on the horizontal",
         &CanopyFractions::reflectance},
        {"transmittance", "light on the ground / light on the horizontal",
         &CanopyFractions::transmittance},
        {"absorptance", "light that organs absorb / light on the horizontal",
         &CanopyFractions::absorptance},
        {"ground_absorptance", "light that the ground absorbs / light on the horizontal",
         &CanopyFractions::ground_absorptance},
    }};
}

}  // namespace quasimc

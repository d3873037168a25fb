#pragma once

#include <array>
#include <string_view>

#include "quasimc/result.h"
#include "sums/statistics.h"

namespace quasimc {

/// One row of the table of shares of groups.
struct ShareEntry {
    std::string_view name;     ///< "fraction_incident"
    std::string_view summary;  ///< one line for the manual
    GroupShare share;
};

/// The shares of groups, in the order in which they are written.
[[nodiscard]] constexpr std::array<ShareEntry, kGroupShares> share_table() {
    return {{
        {"fraction_incident",
         "absorbed flux / light on the horizontal, above a ground or in a cell",
         GroupShare::incident},
        {"fraction_absorbed", "absorbed flux / that of all measured organs", GroupShare::absorbed},
    }};
}

/// A share of a group; unknown in results without shares, such as sums over times.
[[nodiscard]] inline Estimate share_or_unknown(
    const GroupResults& groups, std::size_t group, GroupShare share, std::size_t band) {
    return groups.shares.empty() ? kUnknownEstimate : groups.share(group, share, band);
}

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

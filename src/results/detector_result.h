#pragma once

#include <string>
#include <vector>

#include "sums/statistics.h"

namespace quasimc {

/// What a detector saw, flux: irradiance unit x area unit.
struct DetectorResult {
    std::string name, type;
    std::string quantity;           ///< by which light is sorted, with its unit
    std::vector<std::string> bins;  ///< their names
    std::vector<Estimate> values;   ///< [bin * bands + band]; see at()

    [[nodiscard]] const Estimate& at(std::size_t bin, std::size_t band) const {
        return values[bin * (values.size() / bins.size()) + band];
    }
};

}  // namespace quasimc

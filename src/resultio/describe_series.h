#pragma once

// Texts and units of results.

#include <string>
#include <string_view>

#include "quasimc/series.h"
#include "runfile/run_file.h"

namespace quasimc {

/// The comments of a table on site, models, and each time step with its sun and light.
[[nodiscard]] std::string series_comments(const RunFile& run);

/// "absorbed flux" for "absorbed_flux".
[[nodiscard]] std::string describe_quantity(std::string_view name);

/// A unit summed over time: "J m-2" for "W m-2", "mol m-2" for "umol m-2 s-1", "lx s" for "lx".
struct SummedUnit {
    std::string name;
    double factor = 1;  ///< from unit x s
};
[[nodiscard]] SummedUnit summed_unit(const std::string& unit);

/// A sum in the units of summed_unit.
[[nodiscard]] SeriesSum in_summed_units(const RunFile& run, SeriesSum sum);

}  // namespace quasimc

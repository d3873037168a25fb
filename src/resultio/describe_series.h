#pragma once

// Texts and units of results.

#include <string>
#include <string_view>
#include <vector>

#include "quasimc/lamp_control.h"
#include "quasimc/series.h"
#include "results/units.h"
#include "runfile/run_file.h"

namespace quasimc {

/// The comments of a table on site, models, and each time step with its sun and light.
[[nodiscard]] std::string series_comments(const RunFile& run);

/// "absorbed flux" for "absorbed_flux".
[[nodiscard]] std::string describe_quantity(std::string_view name);

/// A sum in the units of summed_unit; unchanged if it has them (SeriesSum::has_file_units).
[[nodiscard]] SeriesSum in_summed_units(const std::vector<Band>& bands, SeriesSum sum);
[[nodiscard]] SeriesSum in_summed_units(const RunFile& run, SeriesSum sum);
/// Lamps under control, with the sums of days in these units.
/// @param outcomes  in the order of `controls`
[[nodiscard]] std::vector<ControlOutcome> in_summed_units(
    const std::vector<Band>& bands,
    const std::vector<LampControl>& controls,
    std::vector<ControlOutcome> outcomes);
/// @param outcomes  in the order of TimeSeries::controls
[[nodiscard]] std::vector<ControlOutcome> in_summed_units(
    const RunFile& run, std::vector<ControlOutcome> outcomes);

}  // namespace quasimc

#pragma once

#include <vector>

#include "quasimc/result.h"
#include "quasimc/series.h"
#include "runfile/run_file.h"
#include "text/document.h"

namespace quasimc {

/// Sets what a JSON result has of a run beside the light of organs, groups and sensors: method,
/// completed paths, rounds, times, energy, fractions of the canopy, audit, detectors. Unknown
/// numbers are NaN.
/// @param light  the object of a run without [time], or of a time step
void read_run_data(const Node& light, const RunFile& run, Result& result);

/// Reads the fractions of the canopy by band; empty if there are none.
/// @param light  the object of a time step, or of a sum
[[nodiscard]] std::vector<CanopyFractions> read_canopy(const Node& light, const RunFile& run);

/// Reads the summary of a series, without its total. Numbers of time steps that are not in the file
/// are 0.
/// @param series  the object of a run with [time]
[[nodiscard]] SeriesSummary read_series_summary(const Node& series);

}  // namespace quasimc

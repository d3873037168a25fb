#pragma once

#include <stop_token>
#include <vector>

#include "quasimc/series.h"

namespace quasimc {

/// As run_series(), of times that are computed together (SeriesMode::together).
/// @throws InputError  with the faults of check_together(), and as run_series() does
/// @throws Stopped  if it is stopped, or its time is up, before its first time is complete
[[nodiscard]] SeriesSummary run_season(
    Simulator& simulator,
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const RunSpec& spec,
    const SeriesEvents& events,
    const std::stop_token& stop);

}  // namespace quasimc

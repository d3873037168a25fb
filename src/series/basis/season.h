#pragma once

#include "series/series_walk.h"

namespace quasimc {

/// As run_series(), of times that are computed together (TimeMethod::daylight_coefficients).
/// @throws InputError  with the faults of check_together(), and as run_series() does
/// @throws Stopped  if it is stopped, or its time is up, before its first time is complete
[[nodiscard]] SeriesSummary run_season(const SeriesInput& input);

}  // namespace quasimc

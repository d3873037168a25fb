#pragma once

#include "series/series_walk.h"

namespace quasimc {

/// Like run_series(), for time steps that are computed together
/// (TimeMethod::daylight_coefficients).
/// @throws InputError  for errors of check_together(), and like run_series()
/// @throws Stopped  if it is stopped, or its time limit is over, before its first time step is
/// complete
[[nodiscard]] SeriesSummary run_season(const SeriesInput& input);

}  // namespace quasimc

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "quasimc/quasimc.h"
#include "run/team_runs.h"

/// The points of a sweep that ranks trace each by itself, from one on; none if there are fewer than
/// ranks, if points are series of times (whose times are shared then), or if time is limited.
/// @param run  of any point
[[nodiscard]] std::vector<quasimc::TeamJob> jobs_of_points(
    const quasimc::RunFile& run, std::size_t points, std::size_t first, std::uint64_t ranks);

/// Traces points. All must outlive it.
[[nodiscard]] quasimc::TraceJob point_tracer(
    quasimc::Simulator& simulator, quasimc::RunSweep& sweep);

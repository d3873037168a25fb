#pragma once

#include <cstdint>
#include <vector>

#include "quasimc/series.h"

namespace quasimc {

/// What is traced of a series, and how much effort each trace gets.
[[nodiscard]] std::vector<TimeStepPlan> plan_traces(
    const Scene& scene, const std::vector<TimeStep>& time_steps, const RunSpec& spec);

/// How one of the traces of a series is run.
/// @param trace  its number, counted from 0
[[nodiscard]] RunSpec trace_spec(
    const RunSpec& series, const TimeStepPlan& plan, std::uint64_t trace);

}  // namespace quasimc

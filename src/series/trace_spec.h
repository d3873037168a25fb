#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "quasimc/series.h"

namespace quasimc {

/// What is traced of a series, and how much effort each trace gets.
[[nodiscard]] std::vector<TimeStepPlan> plan_traces(
    const Scene& scene, const std::vector<TimeStep>& time_steps, const RunSpec& spec);

/// A time that is traced, and how.
struct Trace {
    std::size_t time_step = 0;
    RunSpec spec;
};
/// The traces of a series, in the order of times.
[[nodiscard]] std::vector<Trace> traces_of(
    const Scene& scene, const std::vector<TimeStep>& time_steps, const RunSpec& spec);

/// How one of the traces of a series is run.
/// @param trace  its number, counted from 0
[[nodiscard]] RunSpec trace_spec(
    const RunSpec& series, const TimeStepPlan& plan, std::uint64_t trace);

}  // namespace quasimc

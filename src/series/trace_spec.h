#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "quasimc/series.h"

namespace quasimc {

/// The traces of a series, and the paths of each.
[[nodiscard]] std::vector<TimeStepPlan> plan_traces(
    const Scene& scene, const std::vector<TimeStep>& time_steps, const RunSpec& spec);

/// The sources of all time steps.
[[nodiscard]] Sources sources_of(const std::vector<TimeStep>& time_steps);

/// The specification of a series whose time steps all have the same origins of light.
[[nodiscard]] RunSpec with_origins_of_all(const RunSpec& spec, const std::vector<TimeStep>& steps);

/// A traced time step, and its specification.
struct Trace {
    std::size_t time_step = 0;
    RunSpec spec;
};
/// The traces of a series, in the order of time steps.
[[nodiscard]] std::vector<Trace> traces_of(
    const Scene& scene, const std::vector<TimeStep>& time_steps, const RunSpec& spec);

/// The specification of one trace of a series.
/// @param trace  its number, counted from 0
[[nodiscard]] RunSpec trace_spec(
    const RunSpec& series, const TimeStepPlan& plan, std::uint64_t trace);

}  // namespace quasimc

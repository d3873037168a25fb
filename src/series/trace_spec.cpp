#include "series/trace_spec.h"

#include <algorithm>
#include <cmath>

#include "light/source_origins.h"
#include "run/trace_plan.h"
#include "samplers/hash.h"
#include "solvers/run_limits.h"

namespace quasimc {
namespace {

/// A seed for each trace (SplitMix64: Steele, Lea and Flood 2014); the first has the series' own.
std::uint64_t seed_of(std::uint64_t seed, std::uint64_t trace) {
    return trace == 0 ? seed : mix64(seed + trace * 0x9E3779B97F4A7C15U);
}

}  // namespace

Sources sources_of(const std::vector<TimeStep>& time_steps) {
    Sources all;
    for (const TimeStep& step : time_steps) {
        all.insert(all.end(), step.sources.begin(), step.sources.end());
    }
    return all;
}

RunSpec with_origins_of_all(const RunSpec& spec, const std::vector<TimeStep>& steps) {
    RunSpec complete = spec;
    if (!spec.origins.empty()) {
        complete.origins = complete_origins(sources_of(steps), spec.origins);
    }
    return complete;
}

std::vector<TimeStepPlan> plan_traces(
    const Scene& scene, const std::vector<TimeStep>& time_steps, const RunSpec& spec) {
    std::vector<TimeStepPlan> plans = plan_series(time_steps);
    if (spec.path_allocation == PathAllocation::proportional) {
        allocate_paths(scene, time_steps, plans);
    }
    return plans;
}

std::vector<Trace> traces_of(
    const Scene& scene, const std::vector<TimeStep>& time_steps, const RunSpec& spec) {
    const std::vector<TimeStepPlan> plans = plan_traces(scene, time_steps, spec);
    const RunSpec complete = with_origins_of_all(spec, time_steps);
    std::vector<Trace> traces;
    for (std::size_t i = 0; i < plans.size(); ++i) {
        if (plans[i].factor > 0 && plans[i].traced == i) {
            traces.push_back({i, trace_spec(complete, plans[i], traces.size())});
        }
    }
    return traces;
}

RunSpec trace_spec(const RunSpec& series, const TimeStepPlan& plan, std::uint64_t trace) {
    TracePlan own{
        .seed = seed_of(series.seed, trace),
        // A target is below 1; the dimmest time steps have one near it.
        .target_error = std::min(std::nextafter(1.0, 0.0), series.target_error * plan.target)};
    if (plan.path_factor != 1) {
        constexpr std::uint64_t kMinPaths = 64;
        const std::uint64_t most = series.max_paths > 0 ? series.max_paths : kMaxPaths;
        const auto shared = [&](std::uint64_t paths) {
            const double part = plan.path_factor * static_cast<double>(paths);
            return std::max(static_cast<std::uint64_t>(part), std::min(paths, kMinPaths));
        };
        // Halves of a power of two remain one, as some samplers require.
        std::uint64_t paths = shared(series.paths);
        for (; paths > most; paths /= 2) {
        }
        own.paths = paths;
        own.max_paths = series.max_paths > 0 ? std::min(shared(series.max_paths), most) : 0;
    }
    return planned_spec(series, own);
}

}  // namespace quasimc

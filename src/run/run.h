#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "results/result.h"
#include "scene/scene.h"
#include "solvers/run_spec.h"
#include "sources/source.h"

namespace quasimc {

/// How far a run is; called now and then from the thread that called run().
struct Progress {
    double fraction = 0;            ///< of the current plan, 0..1
    double seconds = 0;             ///< so far
    double expected_seconds = 0;    ///< in all; grows when a target needs more rounds
    double fraction_at_target = 0;  ///< of the organs, after the last round; 0 without a target
};

/// Computes the light on every organ.
///
/// The same binary, scene, sources and specification give the same bits on any number of threads
/// (but for the times in the result, and unless max_seconds ends the run).
/// @throws InputError  for a specification that can't be run: every fault at once
[[nodiscard]] Result run(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const std::function<void(const Progress&)>& on_progress = {});

/// Adds the faults of a specification (unknown sampler, paths that are no power of two, unknown
/// bands in ratios, ...).
void check_run(const Scene& scene, const Sources& sources, const RunSpec& spec, Faults& faults);

}  // namespace quasimc

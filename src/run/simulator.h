#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <stop_token>
#include <string>

#include "quasimc/result.h"
#include "quasimc/run.h"
#include "run/cached_ray_caster.h"
#include "run/early_stop.h"
#include "run/plan_run.h"
#include "samplers/sampler.h"
#include "scene/scene.h"

namespace quasimc {

/// The final sums of a run.
struct RunSums {
    const Sums& sums;
    const Scene& scene;  ///< with the sensors, for theirs
    const EvaluationSpec& spec;
    bool of_sensors = false;
};

/// The role of a run within a series and its simulator.
struct RunRole {
    std::size_t time_step = 0;
    /// Seconds that the run may take after a stop before its first round is complete: a few paths
    /// are then traced for a result. 0: no result (Stopped).
    double seconds_after_stop = 0;
    const Sums* given = nullptr;  ///< all paths, traced elsewhere; null: traced here
    bool is_last = false;         ///< last run of the simulator: data for rays is released early
    /// Receives the sums of the run, and then those of its sensors; of neither without light.
    std::function<void(const RunSums& sums)> on_sums = {};
    bool of_sensors = false;  ///< a run of sensors
};

/// Data that a Simulator keeps between runs.
class Simulator::State {
  public:
    [[nodiscard]] Result run(
        const Scene& scene,
        const Sources& sources,
        const RunSpec& spec,
        const RunControl& control,
        const RunRole& role);
    [[nodiscard]] Sums sums(
        const Scene& scene,
        const Sources& sources,
        const RunSpec& spec,
        std::uint64_t first,
        const Share& share,
        const RunControl& control);
    /// The choice of a method other than ray bundles.
    [[nodiscard]] ChosenMethod plan_without_bundles(
        const Scene& scene,
        const Sources& sources,
        const RunSpec& spec,
        const std::stop_token& stop) {
        return plan_run({scene, sources, spec, sampler_for(spec.sampler), caster_, stop, false});
    }
    [[nodiscard]] std::size_t builds() const { return caster_.builds(); }
    /// The light on the sensors of a scene alone, by the paths of the specification.
    [[nodiscard]] Result light_on_sensors(
        const Scene& scene, const Sources& sources, const RunSpec& spec);
    /// Cached for the next run: see CachedRayCaster::caster_for().
    [[nodiscard]] std::shared_ptr<const RayCaster> caster_for(
        const Scene& scene, Accelerator accelerator, const std::stop_token& stop) {
        return caster_.caster_for(scene, accelerator, stop);
    }
    [[nodiscard]] const Sampler& sampler_for(const std::string& name);

  private:
    /// A checked and planned run.
    struct TraceInput {
        const Scene& scene;
        const Sources& sources;
        const RunSpec& spec;
        const RunControl& control;
        Work work;
        Deadline deadline;
        RunRole role;
        Deadline::Clock::time_point start;
    };
    /// @throws StopRequested  if it was stopped before it had a result
    [[nodiscard]] Result trace(const TraceInput& input, EarlyStop& early);
    /// Computes the light on the sensors of a scene, and adds it to the result of its organs.
    void add_sensors(
        const Scene& scene,
        const Sources& sources,
        const RunSpec& spec,
        const RunControl& control,
        const RunRole& role,
        Result& result);
    /// Compares a result with that of an audit.
    void add_audit(
        const Scene& scene,
        const Sources& sources,
        const RunSpec& spec,
        const RunControl& control,
        Result& result);

    CachedRayCaster caster_;
    std::map<std::string, std::unique_ptr<Sampler>> samplers_;
};

/// Internal access to the state of a Simulator.
struct SimulatorAccess {
    static Simulator::State& state(Simulator& simulator) { return *simulator.state_; }
};

}  // namespace quasimc

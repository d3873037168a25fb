#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <stop_token>
#include <string>

#include "quasimc/result.h"
#include "quasimc/run.h"
#include "run/cached_ray_caster.h"
#include "run/early_stop.h"
#include "samplers/sampler.h"
#include "scene/scene.h"

namespace quasimc {

/// What a run is within a series, and of its simulator.
struct RunRole {
    std::size_t time_step = 0;
    /// Seconds that the run may still take after a stop if none of its rounds was complete: a few
    /// paths are then traced, so that there is a result. 0: there is none (Stopped).
    double seconds_after_stop = 0;
    const Sums* given = nullptr;  ///< all paths, traced elsewhere; null: they are traced
    bool is_last = false;         ///< of the simulator: what rays need is given back early
};

/// What a Simulator keeps from run to run, and what it does with it.
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
    [[nodiscard]] std::size_t builds() const { return caster_.builds(); }
    /// Kept for the next run: as CachedRayCaster::caster_for().
    [[nodiscard]] std::shared_ptr<const RayCaster> caster_for(
        const Scene& scene, Accelerator accelerator, const std::stop_token& stop) {
        return caster_.caster_for(scene, accelerator, stop);
    }
    [[nodiscard]] const Sampler& sampler_for(const std::string& name);

  private:
    /// A run that was checked and planned.
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
    /// @throws StopRequested  if it was stopped before there was a result
    [[nodiscard]] Result trace(const TraceInput& input, EarlyStop& early);
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

/// The way of the engine to what a simulator keeps.
struct SimulatorAccess {
    static Simulator::State& state(Simulator& simulator) { return *simulator.state_; }
};

}  // namespace quasimc

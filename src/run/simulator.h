#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <stop_token>
#include <string>

#include "quasimc/result.h"
#include "quasimc/run.h"
#include "run/early_stop.h"
#include "run/kept_caster.h"
#include "run/run_team.h"
#include "samplers/sampler.h"
#include "scene/scene.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// When a run began, and how long the scene was prepared.
struct RunStart {
    std::chrono::steady_clock::time_point time;
    double build_seconds = 0;
};

/// What a Simulator keeps from run to run, and what it does with it.
class Simulator::State {
  public:
    [[nodiscard]] Result run(
        const Scene& scene, const Sources& sources, const RunSpec& spec, const RunControl& control);
    [[nodiscard]] Sums sums(
        const Scene& scene,
        const Sources& sources,
        const RunSpec& spec,
        std::uint64_t first,
        const Share& share,
        const RunControl& control);
    [[nodiscard]] std::size_t builds() const { return caster_.builds(); }
    /// Kept for the next run: as KeptCaster::caster_for().
    [[nodiscard]] std::shared_ptr<const RayCaster> caster_for(
        const Scene& scene, Engine engine, const std::stop_token& stop) {
        return caster_.caster_for(scene, engine, stop);
    }
    [[nodiscard]] const Sampler& sampler_for(const std::string& name);

  private:
    /// Traces a specification that was checked and planned.
    /// @throws StopRequested  if it was stopped before there was a result
    [[nodiscard]] Result trace(
        const Scene& scene,
        const Sources& sources,
        const RunSpec& spec,
        const RunControl& control,
        EarlyStop& early,
        std::chrono::steady_clock::time_point start);
    /// What the rounds of a run have brought.
    struct Traced {
        Sums sums;
        StopReason stop;
        double at_target;
        double paths_before;
        double cpu_seconds_of_others;
        std::vector<RoundErrors> rounds;
    };
    [[nodiscard]] Traced trace_rounds(
        const PreparedScene& prepared,
        const RunSpec& spec,
        const EvaluationSpec& asked,
        const RunControl& control,
        EarlyStop& early,
        const RunStart& start);
    /// Of a run that was stopped before its first round was complete: sums of a few paths, if the
    /// caller gives them time and it is enough.
    [[nodiscard]] std::optional<Sums> trace_few(
        const PreparedScene& prepared, const RunSpec& spec, const RunControl& control);
    /// After a run: compares its result with that of an audit, if one was asked for.
    void add_audit(
        const Scene& scene,
        const Sources& sources,
        const RunSpec& spec,
        const RunControl& control,
        EarlyStop& early,
        Result& result);

    KeptCaster caster_;
    std::map<std::string, std::unique_ptr<Sampler>> samplers_;
};

}  // namespace quasimc

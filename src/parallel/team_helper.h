#pragma once

#include <vector>

#include "quasimc/run_spec.h"
#include "quasimc/series.h"
#include "run/cached_ray_caster.h"
#include "run/run_team.h"

namespace quasimc {

/// A process that helps the first one. Keeps the acceleration structure from run to run.
class TeamHelper {
  public:
    /// Helps with the runs of a series, until an order of another kind arrives, which it returns.
    /// @param order  the first one
    [[nodiscard]] TeamOrder help(
        const Scene& scene,
        const std::vector<TimeStep>& time_steps,
        const RunSpec& spec,
        RunTeam& team,
        TeamOrder order);

  private:
    [[nodiscard]] TeamOrder help_time_step(
        const Scene& scene,
        const Sources& sources,
        const RunSpec& spec,
        RunTeam& team,
        TeamOrder order);

    CachedRayCaster caster_;
};

}  // namespace quasimc

#pragma once

// Processes that trace a run together: the first has the run, the others help it. What each traces
// is exact and depends on tasks alone, so that any number of them gives the same bits.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "base/executor.h"
#include "geometry/cast/ray_caster.h"
#include "quasimc/series.h"
#include "quasimc/sums.h"
#include "scene/scene.h"
#include "solvers/solver.h"

namespace quasimc {

/// What the first process asks of the others: most often to trace tasks of a round with it.
struct TeamOrder {
    std::uint64_t is_end = 0;      ///< nothing more is asked
    std::uint64_t is_prepare = 0;  ///< orders for this moment and these first paths follow
    std::uint64_t point = 0;       ///< of a sweep
    std::uint64_t moment = 0;      ///< of its times
    std::uint64_t first_paths = 0;
    Round round = {};
    TaskPosition tasks = {};  ///< done before
};

/// The team as one process sees it.
struct RunTeam {
    bool is_first = true;
    TaskTeam tasks;
    /// Of the first process: tells the others. Of the others: waits for it.
    std::function<TeamOrder(const TeamOrder& order)> order;
    /// Adds to the numbers of the first process those of the others.
    std::function<void(std::vector<std::int64_t>& numbers)> add_up;
    std::uint64_t point = 0;  ///< that the first process is at
};

/// Adds up the bins of all processes, which are of one layout: they are those of the first process
/// then, and nothing in the others. All call it.
void add_up(const RunTeam& team, Sums& sums);

/// A process that helps the first one. Keeps the acceleration structure from run to run.
class TeamHelper {
  public:
    /// Helps with the runs of a series, until an order is for another point or the end: returns it.
    /// @param order  the first one
    [[nodiscard]] TeamOrder help(
        const Scene& scene,
        const std::vector<TimeStep>& time_steps,
        const RunSpec& spec,
        const RunTeam& team,
        TeamOrder order);

  private:
    [[nodiscard]] TeamOrder help_moment(
        const Scene& scene,
        const Sources& sources,
        const RunSpec& spec,
        const RunTeam& team,
        TeamOrder order);
    [[nodiscard]] std::shared_ptr<const RayCaster> caster_for(const Scene& scene, Engine engine);

    std::shared_ptr<const RayCaster> caster_;
    std::shared_ptr<const SceneGeometry> triangles_;  // of caster_, with cell and engine:
    Cell cell_;
    Engine engine_ = Engine::embree;
};

}  // namespace quasimc

#pragma once

#include <memory>
#include <optional>

#include "base/executor.h"
#include "quasimc/run_spec.h"
#include "quasimc/sums.h"
#include "samplers/sampler.h"
#include "solvers/solver.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// Traces the rounds of a run, and keeps the sums of those that are complete.
class RoundTracer {
  public:
    /// @param spec  its paths do not matter: those of the first round do
    /// @param may_be_stopped  then a second copy of the sums is kept while a round is traced
    RoundTracer(
        const PreparedScene& prepared,
        const Sampler& sampler,
        const RunSpec& spec,
        Executor& executor,
        bool may_be_stopped)
        : prepared_(prepared),
          sampler_(sampler),
          spec_(spec),
          executor_(executor),
          may_be_stopped_(may_be_stopped) {}

    /// A round whose first point is number 0 begins anew: when it is complete, its sums replace all
    /// others.
    /// @throws StopRequested  if it was stopped: the sums are what they were before
    void trace(const Round& round);

    [[nodiscard]] bool has_sums() const { return done_.has_value(); }
    /// Of the rounds that are complete; there must be one.
    [[nodiscard]] const Sums& sums() const { return *done_; }

  private:
    const PreparedScene& prepared_;
    const Sampler& sampler_;
    RunSpec spec_;
    Executor& executor_;
    bool may_be_stopped_;
    std::unique_ptr<Solver> solver_;
    std::optional<Sums> done_;
};

}  // namespace quasimc

#pragma once

#include <stop_token>

#include "base/executor.h"
#include "quasimc/run.h"
#include "run/run_team.h"

namespace quasimc {

/// Requests a stop when the first process of a team has stopped; checks it at every progress
/// report.
class StopByTeam final : public RunListener, public TaskWatcher {
  public:
    explicit StopByTeam(RunTeam& team) : team_(team) {}

    void on_progress(const Progress& /*progress*/) override { ask(); }
    void on_progress(double /*part*/) override { ask(); }
    [[nodiscard]] bool wants(SeriesPart /*part*/) const override { return false; }
    void ask() {
        if (team_.is_stopped()) {
            stop_.request_stop();
        }
    }
    [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }

  private:
    RunTeam& team_;
    std::stop_source stop_;
};

}  // namespace quasimc

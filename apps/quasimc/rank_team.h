#pragma once

#include <functional>
#include <memory>

#include "command_line.h"
#include "run/run_team.h"

/// The ranks of a job of MPI.
class RankTeam : public quasimc::RunTeam {
  public:
    /// Joins the job; null if it has one rank, or the program is built without MPI.
    /// @throws quasimc::InputError  if MPI can't be started
    [[nodiscard]] static std::unique_ptr<RankTeam> join();

    /// Whether the job has several ranks, and this is not the first.
    [[nodiscard]] static bool is_another_rank();

    /// Does the work of this rank, and leaves the job. If the work fails, prints the error and ends
    /// the program on all ranks.
    [[nodiscard]] virtual Exit run(const std::function<Exit()>& work) = 0;
};

#pragma once

#include <functional>
#include <memory>

#include "command_line.h"
#include "run/run_team.h"

/// The ranks of a job that MPI's launcher has started to run the program together.
class RankTeam : public quasimc::RunTeam {
  public:
    /// Joins them; null if there are not several, or the program is built without MPI.
    /// @throws quasimc::InputError  if there are, but MPI can't be started
    [[nodiscard]] static std::unique_ptr<RankTeam> join();

    /// Whether the launcher has started several, and this is not the first of them.
    [[nodiscard]] static bool is_another_rank();

    /// Does the work of this rank, and then leaves the job in order. If it can't go on, prints why
    /// and ends the program on all ranks.
    [[nodiscard]] virtual Exit run(const std::function<Exit()>& work) = 0;
};

#pragma once

#include "quasimc/quasimc.h"
#include "run/run_team.h"
#include "run_writers.h"

/// Reads the runs on all ranks. Only the first accesses files and pipes; it sends their bytes to
/// the others as soon as it has read them.
/// @throws quasimc::InputError  on all ranks, if the first finds an error
[[nodiscard]] quasimc::StoredSweep read_for_team(
    const RunArguments& arguments, quasimc::RunTeam& team);

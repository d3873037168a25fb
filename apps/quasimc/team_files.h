#pragma once

#include "quasimc/quasimc.h"
#include "run/run_team.h"
#include "run_writers.h"

/// Reads the runs on all ranks. Only the first reaches for the disk or a pipe; the others get the
/// bytes of each file from it as soon as it has read them.
/// @throws quasimc::InputError  on all ranks, if the first finds a fault
[[nodiscard]] quasimc::StoredSweep read_for_team(
    const RunArguments& arguments, quasimc::RunTeam& team);

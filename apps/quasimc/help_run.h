#pragma once

#include "command_line.h"
#include "run/run_team.h"
#include "run_writers.h"

/// Helps the first rank with its run, until it says that it is done. Writes and prints nothing.
[[nodiscard]] Exit help_run(const RunArguments& arguments, quasimc::RunTeam& team);

#pragma once

#include <vector>

#include "command_line.h"
#include "run_writers.h"

/// The flags of `quasimc run`. They write to the arguments, which must outlive them.
[[nodiscard]] std::vector<Flag> flags_of_run(RunArguments& arguments);
/// The flags of `quasimc merge`. They write to the arguments, which must outlive them.
[[nodiscard]] std::vector<Flag> flags_of_merge(RunArguments& arguments);

/// Checks for contradictory flags of `quasimc run`.
/// @throws UsageError
void check_usage(const RunArguments& arguments);

#pragma once

#include <vector>

#include "command_line.h"
#include "run_writers.h"

/// The flags of `quasimc run`. They write to the arguments, which must outlive them.
[[nodiscard]] std::vector<Flag> flags_of_run(RunArguments& arguments);
/// The same of `quasimc merge`.
[[nodiscard]] std::vector<Flag> flags_of_merge(RunArguments& arguments);

/// Whether what `quasimc run` is asked for goes together.
/// @throws UsageError
void check_usage(const RunArguments& arguments);

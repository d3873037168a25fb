#pragma once

#include <functional>

#include "command_line.h"
#include "files/input_files.h"
#include "interrupt.h"
#include "progress.h"
#include "quasimc/quasimc.h"
#include "run_writers.h"

// What `quasimc run` shares with `quasimc run --part`.

/// @throws quasimc::InputError
[[nodiscard]] quasimc::StoredSweep read_runs(
    const RunArguments& arguments, const quasimc::FileAccess& access = {});
[[nodiscard]] ProgressLines progress_lines(const RunArguments& arguments);
/// What says, at the first Ctrl-C, that there may be a second.
[[nodiscard]] std::function<void()> stopping_note(const RunArguments& arguments);
/// Faults that show only when a run begins are of the run file, or of the flags that set what is
/// wrong.
[[nodiscard]] quasimc::InputError error_of_file(
    const quasimc::InputError& error,
    const quasimc::RunFile& file,
    const std::vector<quasimc::Override>& flags);

/// Computes a part of the run, or of all runs of a sweep, and writes its sums.
[[nodiscard]] Exit run_part(const RunArguments& arguments);

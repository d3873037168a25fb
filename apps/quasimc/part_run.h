#pragma once

#include <functional>

#include "command_line.h"
#include "files/input_files.h"
#include "interrupt.h"
#include "progress.h"
#include "quasimc/quasimc.h"
#include "run_writers.h"

// Functions shared by `quasimc run` and `quasimc run --part`.

/// @throws quasimc::InputError
[[nodiscard]] quasimc::StoredSweep read_runs(
    const RunArguments& arguments, const quasimc::FileAccess& access = {});
[[nodiscard]] ProgressLines progress_lines(const RunArguments& arguments);
/// A function that prints, at the first Ctrl-C, that a second one ends the program.
[[nodiscard]] std::function<void()> stopping_note(const RunArguments& arguments);
/// Gives errors that are found when a run begins the location of the run file, or of the flag that
/// set the wrong value.
[[nodiscard]] quasimc::InputError error_of_file(
    const quasimc::InputError& error,
    const quasimc::RunFile& file,
    const std::vector<quasimc::Override>& flags);

/// Computes a part of the run, or of all runs of a sweep, and writes its sums.
[[nodiscard]] Exit run_part(const RunArguments& arguments);

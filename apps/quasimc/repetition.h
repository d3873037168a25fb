#pragma once

#include <string>

#include "quasimc/quasimc.h"
#include "run_writers.h"

/// What came of repeating a run with --repeat.
struct Repetition {
    std::string
        verdict;  ///< for the summary: "the same numbers as in leaves.json"; "" without --repeat
    bool has_failed = false;  ///< the same program, asked for the same, computed other numbers
};

/// @param digest  of the organs, as JsonWriter::digest() gives it; "" without --repeat
/// @param difference  of the rows of numbers, as RowComparison gives it
/// @param stop  why this run ended
[[nodiscard]] Repetition judge_repetition(
    const RunArguments& arguments,
    const quasimc::StoredSweep& stored,
    const std::string& digest,
    const std::string& difference,
    quasimc::StopReason stop);

#pragma once

#include <string>

#include "quasimc/quasimc.h"
#include "run_writers.h"

/// The outcome of a run with --repeat.
struct Repetition {
    std::string
        verdict;  ///< for the summary: "the same numbers as in leaves.json"; "" without --repeat
    bool has_failed = false;  ///< the same program with the same options computed other numbers
};

/// @param digest  JsonWriter::digest(); "" without --repeat
/// @param difference  RowComparison::difference()
/// @param stop  why this run ended
[[nodiscard]] Repetition judge_repetition(
    const RunArguments& arguments,
    const quasimc::StoredSweep& stored,
    const std::string& digest,
    const std::string& difference,
    quasimc::StopReason stop);

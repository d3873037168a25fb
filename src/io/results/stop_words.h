#pragma once

// What is said of runs that ended before all was done. Included by the writers of results only.

#include <string>

#include "io/runfile/run_file.h"
#include "quasimc/result.h"
#include "quasimc/series.h"

namespace quasimc {

/// Why a result is of fewer paths than were asked for; empty if it isn't.
[[nodiscard]] std::string stop_words(const RunSpec& spec, const Result& result);
/// The same of times.
[[nodiscard]] std::string stop_words(const RunFile& run, const SeriesSummary& summary);

}  // namespace quasimc

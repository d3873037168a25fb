#pragma once

#include <string>
#include <vector>

#include "io/runfile/run_file.h"
#include "quasimc/result.h"
#include "quasimc/series.h"

namespace quasimc {

/// What the audit of a result says, one line for the whole and one for each of the first bands;
/// none without an audit.
[[nodiscard]] std::vector<std::string> audit_lines(const RunFile& run, const Result& result);
/// What all audits of a series say; empty without any.
[[nodiscard]] std::string audit_line(const SeriesSummary& summary);

/// A warning to print if audits find a difference beyond chance; otherwise empty.
/// @param chance  Audit::chance, SeriesSummary::audit_chance
[[nodiscard]] std::string audit_warning(double chance);

}  // namespace quasimc

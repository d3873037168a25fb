#pragma once

// What is said of audits, and of runs that ended before all was done.

#include <string>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/series.h"
#include "runfile/run_file.h"

namespace quasimc {

/// What the audit of a result says, one line for the whole and one for each of the first bands;
/// none without an audit.
[[nodiscard]] std::vector<std::string> audit_lines(const RunFile& run, const Result& result);
/// What all audits of a series say; empty without any.
[[nodiscard]] std::string audit_line(const SeriesSummary& summary);

/// A warning to print if audits find a difference beyond chance; otherwise empty.
/// @param p_value  Audit::p_value, SeriesSummary::audit_p_value
[[nodiscard]] std::string audit_warning(double p_value);

/// Why a result is of fewer paths than were asked for; empty if it isn't.
[[nodiscard]] std::string describe_stop(const RunSpec& spec, const Result& result);
/// The same of times.
[[nodiscard]] std::string describe_stop(const RunFile& run, const SeriesSummary& summary);

}  // namespace quasimc

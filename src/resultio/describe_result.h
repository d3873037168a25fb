#pragma once

// Texts on titles, audits, and runs that ended early.

#include <string>
#include <vector>

#include "quasimc/error.h"
#include "quasimc/result.h"
#include "quasimc/series.h"
#include "runfile/run_file.h"

namespace quasimc {

/// The title of a run, or else the name of its file without folders.
[[nodiscard]] std::string title_of(const RunFile& run);

/// The fault of a quantity whose unit in another result differs, so that there is no difference.
/// @param where  the other result
[[nodiscard]] Fault fault_of_units(
    const std::string& where,
    const std::string& quantity,
    const std::string& unit,
    const std::string& other_unit);

/// The outcome of a result's audit, one line for the whole and one for each of the first bands;
/// none without an audit.
[[nodiscard]] std::vector<std::string> audit_lines(const RunFile& run, const Result& result);
/// The outcome of all audits of a series; empty without any.
[[nodiscard]] std::string audit_line(const SeriesSummary& summary);

/// A warning to print if audits find a difference beyond chance; otherwise empty.
/// @param p_value  Audit::p_value, SeriesSummary::audit_p_value
[[nodiscard]] std::string audit_warning(double p_value);

/// The reason why a result has fewer paths than requested; empty if it has all.
[[nodiscard]] std::string describe_stop(const RunSpec& spec, const Result& result);
/// The reason why a result of a scene with sensors has no light on them: the run was stopped.
/// @param stop  Result::stop, SeriesSummary::stop
[[nodiscard]] std::string describe_missing_sensors(const RunSpec& spec, StopReason stop);
/// The reason why a series has fewer time steps or paths than requested; empty if it has all.
[[nodiscard]] std::string describe_stop(const RunFile& run, const SeriesSummary& summary);

}  // namespace quasimc

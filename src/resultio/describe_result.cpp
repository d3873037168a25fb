#include "resultio/describe_result.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/text.h"
#include "results/units.h"

namespace quasimc {
namespace {

std::string verdict(double p_value) {
    return p_value >= kAuditLevel
               ? fmt::format("agrees (p = {:.2g})", p_value)
               : fmt::format("DISAGREES (p = {:.2g}, below {:g})", p_value, kAuditLevel);
}

std::string band_line(const BandAudit& audit, const Band& band, const std::string& length_unit) {
    std::string text =
        fmt::format("{}: reduced chi-square {:.3g}", band.name, audit.reduced_chi_square);
    if (std::isfinite(audit.difference)) {
        const FluxUnit unit = named_flux_unit(band.unit, length_unit);
        text += fmt::format(
            "; organs absorb {:.4g} +- {} {} {} than in the audit",
            unit.factor * std::abs(audit.difference),
            error_text(unit.factor * audit.standard_error), unit.name,
            audit.difference < 0 ? "less" : "more");
    }
    return text;
}

/// Empty if the run completed.
std::string reason(const RunSpec& spec, StopReason stop) {
    switch (stop) {
        case StopReason::interrupted:
            return "interrupted";
        case StopReason::time_limit:
            return fmt::format("max_seconds = {} reached", shortest(spec.max_seconds));
        default:
            return "";
    }
}

}  // namespace

std::string title_of(const RunFile& run) {
    return run.title.empty() ? std::filesystem::path(run.path).filename().string() : run.title;
}

Fault fault_of_units(
    const std::string& where,
    const std::string& quantity,
    const std::string& unit,
    const std::string& other_unit) {
    return {
        where,
        fmt::format(
            "{} is in {} here, but in {} in the result that it is subtracted from", quantity,
            other_unit, unit),
        "numbers of different units have no difference",
        "compute both in the same units: irradiance_unit, length_unit"};
}

std::vector<std::string> audit_lines(const RunFile& run, const Result& result) {
    if (!result.audit) {
        return {};
    }
    const Audit& audit = *result.audit;
    std::vector<std::string> lines{fmt::format(
        "{} with plain Monte Carlo, {} paths x {} replicates", verdict(audit.p_value), audit.paths,
        audit.replicates)};
    constexpr std::size_t kMaxBands = 4;
    for (std::size_t b = 0; b < std::min(audit.bands.size(), kMaxBands); ++b) {
        lines.push_back(band_line(audit.bands[b], run.scene.bands()[b], run.scene.length_unit()));
    }
    return lines;
}

std::string audit_line(const SeriesSummary& summary) {
    return summary.audited == 0
               ? ""
               : fmt::format(
                     "{}: the least likely one {}", counted(summary.audited, "comparison"),
                     verdict(summary.audit_p_value));
}

std::string audit_warning(double p_value) {
    return p_value >= kAuditLevel
               ? ""
               : fmt::format(
                     "audit: the result differs from plain Monte Carlo by more than random error "
                     "(p = {:.2g}, below {:g}); do not trust this result, and report it",
                     p_value, kAuditLevel);
}

std::string describe_stop(const RunSpec& spec, const Result& result) {
    const std::string why = reason(spec, result.stop);
    if (why.empty()) {
        return "";
    }
    const std::string requested =
        result.paths < spec.paths ? fmt::format(" of {}", spec.paths) : std::string();
    const bool lacks_audit = spec.audit > 0 && !result.audit;
    return fmt::format(
        "{}: {}{} paths completed{}", why, result.paths, requested,
        lacks_audit ? ", without the audit" : "");
}

std::string describe_missing_sensors(const RunSpec& spec, StopReason stop) {
    return fmt::format("not computed, as the run was stopped before them ({})", reason(spec, stop));
}

std::string describe_stop(const RunFile& run, const SeriesSummary& summary) {
    const std::string why = reason(run.spec, summary.stop);
    if (why.empty()) {
        return "";
    }
    const std::string short_of = summary.with_fewer_paths > 0
                                     ? fmt::format(
                                           "; {} of {} computed with fewer paths than requested",
                                           summary.with_fewer_paths, summary.computed)
                                     : std::string();
    return fmt::format(
        "{}: {} of {} time steps completed{}", why, summary.completed,
        run.series->time_steps.size(), short_of);
}

}  // namespace quasimc

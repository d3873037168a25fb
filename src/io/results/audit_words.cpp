#include "io/results/audit_words.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "io/runfile/units.h"

namespace quasimc {
namespace {

std::string verdict(double chance) {
    return chance >= kAuditLevel
               ? fmt::format("agrees (a difference like this or larger has chance {:.2g})", chance)
               : fmt::format(
                     "DISAGREES: the difference has chance {:.2g}, below {:g}", chance,
                     kAuditLevel);
}

std::string band_line(const BandAudit& audit, const Band& band, const std::string& length_unit) {
    std::string text =
        fmt::format("{}: reduced chi-square {:.3g}", band.name, audit.reduced_chi_square);
    if (std::isfinite(audit.difference)) {
        const FluxUnit unit = named_flux_unit(band.unit, length_unit);
        text += fmt::format(
            "; organs absorb {:.3g} +- {:.2g} {} more than in the audit",
            unit.factor * audit.difference, unit.factor * audit.standard_error, unit.name);
    }
    return text;
}

}  // namespace

std::vector<std::string> audit_lines(const RunFile& run, const Result& result) {
    if (!result.audit) {
        return {};
    }
    const Audit& audit = *result.audit;
    std::vector<std::string> lines{fmt::format(
        "{} with plain Monte Carlo, {} paths x {} replicates", verdict(audit.chance), audit.paths,
        audit.replicates)};
    constexpr std::size_t kMostBands = 4;
    for (std::size_t b = 0; b < std::min(audit.bands.size(), kMostBands); ++b) {
        lines.push_back(band_line(audit.bands[b], run.scene.bands()[b], run.scene.length_unit()));
    }
    return lines;
}

std::string audit_line(const SeriesSummary& summary) {
    return summary.audited == 0 ? ""
                                : fmt::format(
                                      "{} times: the most unlikely {}", summary.audited,
                                      verdict(summary.audit_chance));
}

std::string audit_warning(double chance) {
    return chance >= kAuditLevel
               ? ""
               : fmt::format(
                     "audit: the result and plain Monte Carlo tracing differ more than chance "
                     "explains (chance {:.2g}, below {:g}); do not trust this result, and report "
                     "it",
                     chance, kAuditLevel);
}

}  // namespace quasimc

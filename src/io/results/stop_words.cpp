#include "io/results/stop_words.h"

#include <fmt/format.h>

#include "base/text.h"

namespace quasimc {
namespace {

/// Empty where nothing cut the run short.
std::string reason(const RunSpec& spec, StopReason stop) {
    switch (stop) {
        case StopReason::interrupted:
            return "on request";
        case StopReason::time_is_up:
            return fmt::format("by max_seconds = {}", shortest(spec.max_seconds));
        default:
            return "";
    }
}

}  // namespace

std::string stop_words(const RunSpec& spec, const Result& result) {
    const std::string why = reason(spec, result.stop);
    if (why.empty()) {
        return "";
    }
    const std::string asked =
        result.paths < spec.paths ? fmt::format(" of {}", spec.paths) : std::string();
    const bool lacks_audit = spec.audit > 0 && !result.audit;
    return fmt::format(
        "{}: {}{} paths are done{}", why, result.paths, asked,
        lacks_audit ? ", the audit is not" : "");
}

std::string stop_words(const RunFile& run, const SeriesSummary& summary) {
    const std::string why = reason(run.spec, summary.stop);
    if (why.empty()) {
        return "";
    }
    const std::string short_of = summary.cut_short > 0
                                     ? fmt::format(
                                           ", {} of {} traces with fewer paths than asked for",
                                           summary.cut_short, summary.traced)
                                     : std::string();
    return fmt::format(
        "{}: {} of {} times are done{}", why, summary.done, run.series->time_steps.size(),
        short_of);
}

}  // namespace quasimc

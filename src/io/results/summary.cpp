#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/parallel.h"
#include "io/line_scanner.h"
#include "io/results/audit_words.h"
#include "io/results/fraction_table.h"
#include "io/runfile/options.h"
#include "io/runfile/units.h"
#include "quasimc/file.h"
#include "quasimc/version.h"

namespace quasimc {
namespace {

std::string line(std::string_view subject, const std::string& text) {
    return fmt::format("{:<10}{}\n", subject, text);
}

std::string scene_line(const Scene& scene) {
    std::string bands;
    for (const Band& band : scene.bands()) {
        bands += fmt::format("{}{} [{}]", bands.empty() ? "" : ", ", band.name, band.unit);
    }
    const Cell& cell = scene.cell();
    const std::string_view repeated = !cell.periodic() ? ""
                                      : cell.along_x && cell.along_y
                                          ? ", repeated along both horizontal axes"
                                          : ", repeated along one horizontal axis";
    return line(
        "scene", fmt::format(
                     "{} organs, {} triangles{}; bands {}", scene.organs().size(),
                     scene.triangles().size(), repeated, bands));
}

/// What is computed: program, file, scene, lights.
std::string subject_lines(const RunFile& run) {
    std::string text = fmt::format(
        "QuasiMC {}: {}{}{}\n", version(), run.path, run.title.empty() ? "" : ": ",
        one_line(run.title));
    text += scene_line(run.scene);
    for (const std::string& note : run.source_notes) {
        text += line("light", one_line(note));
    }
    return text;
}

std::string run_line(const RunSpec& spec, const Result& result) {
    return line(
        "run", fmt::format(
                   "{} points, {}, {} paths x {} replicates, seed {}, {} threads", spec.sampler,
                   method_name(result.chosen.method), result.paths, result.replicates, spec.seed,
                   thread_count(spec.threads)));
}

/// Why the run was traced so, if that was not what the run file said.
std::string method_line(const RunSpec& spec, const Result& result) {
    if (spec.method != Method::automatic) {
        return "";
    }
    return line(
        "method", fmt::format("{}: {}", method_name(result.chosen.method), result.chosen.reason));
}

std::string time_line(const Result& result) {
    const double all = static_cast<double>(result.paths) * result.replicates;
    return line(
        "time", fmt::format(
                    "{:.3g} s ({:.3g} s of CPU), {:.3g} million paths/s, {:.3g} rays per path",
                    result.trace_seconds, result.trace_cpu_seconds,
                    all / std::max(result.trace_seconds, 1e-9) / 1e6,
                    static_cast<double>(result.rays) / all));
}

std::string with_error(const Estimate& e) {
    return std::isfinite(e.standard_error)
               ? fmt::format("{:.6g} +- {:.2g}", e.mean, e.standard_error)
               : fmt::format("{:.6g}", e.mean);
}

std::string fraction_with_error(const Estimate& e) {
    return std::isfinite(e.standard_error)
               ? fmt::format("{:.4f} +- {:.1g}", e.mean, e.standard_error)
               : fmt::format("{:.4f}", e.mean);
}

/// The relative standard errors of the absorbed flux of the organs that were hit, all bands.
struct Errors {
    std::vector<double> relative;
    std::size_t unseen = 0;  ///< organs of which some band was never hit
    double worst = 0;
    std::int64_t worst_id = 0;
};

Errors errors_of(const Scene& scene, const Result& result) {
    Errors errors;
    for (std::size_t i = 0; i < result.organs(); ++i) {
        bool seen = true;
        for (std::size_t b = 0; b < scene.bands().size(); ++b) {
            const Estimate& e = result.at(i, Quantity::absorbed_flux, b);
            if (!std::isfinite(e.standard_error) || e.mean == 0) {
                seen = false;
                continue;
            }
            const double relative = e.standard_error / e.mean;
            errors.relative.push_back(relative);
            if (relative >= errors.worst) {
                errors.worst = relative;
                errors.worst_id = scene.organs()[i].id;
            }
        }
        errors.unseen += seen ? 0 : 1;
    }
    return errors;
}

std::string error_line(const Scene& scene, const Result& result) {
    Errors errors = errors_of(scene, result);
    if (errors.relative.empty()) {
        return line("errors", "no organ has a standard error of the light it absorbs");
    }
    const auto middle =
        errors.relative.begin() + static_cast<std::ptrdiff_t>(errors.relative.size() / 2);
    std::nth_element(errors.relative.begin(), middle, errors.relative.end());
    const std::string unseen =
        errors.unseen > 0
            ? fmt::format("; {} organs without one (black sides, or nothing hit)", errors.unseen)
            : "";
    return line(
        "errors", fmt::format(
                      "relative standard error of the absorbed flux: median {:.2g} %, "
                      "worst {:.2g} % (organ {}){}",
                      100 * *middle, 100 * errors.worst, errors.worst_id, unseen));
}

std::string energy_lines(const Scene& scene, const Result& result) {
    constexpr std::size_t kMostBands = 4;
    std::string text;
    for (std::size_t b = 0; b < std::min(result.budget.size(), kMostBands); ++b) {
        const BandBudget& budget = result.budget[b];
        const Band& band = scene.bands()[b];
        if (std::isnan(budget.escaped.mean)) {
            text += line(
                "energy", fmt::format(
                              "{} [{}]: {:.6g} emitted; not all organs are measured", band.name,
                              flux_unit(band.unit, scene.length_unit()), budget.emitted));
            continue;
        }
        text += line(
            "energy",
            fmt::format(
                "{} [{}]: {:.6g} emitted; organs {}, ground {}, escaped {:.6g}{}, cut off {:.3g}",
                band.name, flux_unit(band.unit, scene.length_unit()), budget.emitted,
                with_error(budget.absorbed_by_organs), with_error(budget.absorbed_by_ground),
                budget.escaped.mean, result.escaped_is_remainder ? " (the rest)" : "",
                budget.cut_off.mean));
    }
    if (result.budget.size() > kMostBands) {
        text += line("", fmt::format("... and {} more bands", result.budget.size() - kMostBands));
    }
    return text;
}

/// "reflectance .08 +- .001, ..."; "" of what can't be told.
std::string fraction_words(const CanopyFractions& fractions) {
    std::string text;
    for (const FractionEntry& entry : fraction_table()) {
        const Estimate& part = fractions.*entry.part;
        if (!std::isnan(part.mean)) {
            text += fmt::format(
                "{}{} {}", text.empty() ? "" : ", ", entry.name, fraction_with_error(part));
        }
    }
    return text;
}

std::string canopy_lines(const Scene& scene, const Result& result) {
    constexpr std::size_t kMostBands = 4;
    std::string text;
    for (std::size_t b = 0; b < std::min(result.canopy.size(), kMostBands); ++b) {
        const std::string words = fraction_words(result.canopy[b]);
        if (!words.empty()) {
            text += line("canopy", fmt::format("{}: {}", scene.bands()[b].name, words));
        }
    }
    return text;
}

/// The methods of the times: one name, or each with the number of times.
std::string series_method(const RunSpec& spec, const SeriesSummary& summary) {
    std::string text;
    for (const auto& [from, times] : summary.methods) {
        text += fmt::format(
            "{}{}{}", text.empty() ? "" : ", ", method_name(from),
            summary.methods.size() > 1 ? fmt::format(" ({} times)", times) : "");
    }
    return text.empty() ? method_name(spec.method) : text;
}

std::string target_line(const RunSpec& spec, const Result& result) {
    if (spec.target_error <= 0) {
        return "";
    }
    return line(
        "target", fmt::format(
                      "{} % error or less: {} by {:.3g} % of the organs ({:.3g} % asked)",
                      100 * spec.target_error,
                      result.stop == StopReason::target_reached ? "reached" : "NOT reached",
                      100 * result.fraction_at_target, 100 * spec.target_fraction));
}

std::string written_line(const std::vector<std::string>& written) {
    if (written.empty()) {
        return line("written", "nothing; name a file with --csv FILE, --json FILE or in [output]");
    }
    return line("written", fmt::format("{}", fmt::join(written, ", ")));
}

/// How many times there are, and in how many traces.
std::string times_words(const TimeSeries& series, const SeriesSummary& summary) {
    const MomentNotes& first = series.notes.front();
    const MomentNotes& last = series.notes.back();
    if (series.collapse == Collapse::none) {
        return fmt::format(
            "{} from {} to {}, {} days; {} traced, the others dark or like one of them",
            series.time_steps.size(), first.time, last.time, series.days.size(), summary.traced);
    }
    std::size_t times = 0;
    std::size_t suns = 0;
    for (const MomentNotes& notes : series.notes) {
        times += notes.collapsed->times;
        suns += notes.suns;
    }
    return fmt::format(
        "{} from {} to {}, collapsed into {} traces of {} suns in all", times, first.time,
        last.collapsed->until, summary.traced, suns);
}

/// How the times of a series were computed.
std::string series_lines(const RunFile& run, const SeriesSummary& summary) {
    const TimeSeries& series = *run.series;
    std::string text;
    for (const std::string& words : series.words) {
        text += line("time", one_line(words));
    }
    text += line("times", times_words(series, summary));
    text += line(
        "run", fmt::format(
                   "{} points, {}, {} paths x {} replicates at a time; {:.3g} s, {} rays",
                   run.spec.sampler, series_method(run.spec, summary), run.spec.paths,
                   run.spec.replicates, summary.seconds, summary.rays));
    if (run.spec.target_error > 0) {
        text += line(
            "target", fmt::format(
                          "{} % error or less: reached at {} of {} times",
                          100 * run.spec.target_error, summary.at_target, summary.traced));
    }
    if (summary.audited > 0) {
        text += line("audit", audit_line(summary));
    }
    return text;
}

/// How the one time of a run without [time] was computed.
std::string result_lines(const RunFile& run, const Result& result) {
    std::string text = run_line(run.spec, result) + method_line(run.spec, result) +
                       time_line(result) + target_line(run.spec, result) +
                       energy_lines(run.scene, result) + canopy_lines(run.scene, result) +
                       error_line(run.scene, result);
    for (const std::string& words : audit_lines(run, result)) {
        text += line("audit", words);
    }
    return text;
}

}  // namespace

void Summary::add_moment(const Result& result) {
    if (!run_.series) {
        result_lines_ = result_lines(run_, result);
    }
}

std::string Summary::text(
    const SeriesSummary& summary, const std::vector<std::string>& written) const {
    return subject_lines(run_) + (run_.series ? series_lines(run_, summary) : result_lines_) +
           written_line(written);
}

std::string summary(
    const RunFile& run, const Result& result, const std::vector<std::string>& written) {
    Summary summary(run);
    summary.add_moment(result);
    return summary.text({}, written);
}

}  // namespace quasimc

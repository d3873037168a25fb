#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/parallel.h"
#include "options/options.h"
#include "quasimc/result_file.h"
#include "quasimc/run_file.h"
#include "quasimc/version.h"
#include "resultio/canopy_lines.h"
#include "resultio/control_texts.h"
#include "resultio/describe_result.h"
#include "resultio/describe_series.h"
#include "resultio/summary_parts.h"
#include "resultio/sweep_sum.h"
#include "resultio/table_columns.h"
#include "results/units.h"
#include "runfile/written.h"
#include "text/line_scanner.h"

namespace quasimc {
namespace {

std::string line(std::string_view subject, const std::string& text) {
    return fmt::format("{:<9} {}\n", subject, text);
}

std::string scene_line(const Scene& scene) {
    std::string bands;
    for (const Band& band : scene.bands()) {
        bands += fmt::format("{}{} [{}]", bands.empty() ? "" : ", ", band.name, band.unit);
    }
    const Cell& cell = scene.cell();
    const std::string_view second = scene.orientation().up() == UpAxis::z ? "y" : "z";
    const std::string periodic =
        !cell.periodic()
            ? ""
            : fmt::format(
                  "; periodic in {}{}{}", cell.along_x ? "x" : "",
                  cell.along_x && cell.along_y ? " and " : "", cell.along_y ? second : "");
    return line(
        "scene", fmt::format(
                     "{}, {}{}; {} {}", counted(scene.organs().size(), "organ"),
                     counted(scene.triangle_count(), "triangle"), periodic,
                     scene.bands().size() == 1 ? "band" : "bands", bands));
}

/// The program, the file and the scene.
std::string title_lines(const RunFile& run) {
    return fmt::format(
               "QuasiMC {}: {}{}{}\n", version(), run.path, run.title.empty() ? "" : ": ",
               one_line(run.title)) +
           scene_line(run.scene);
}

/// The subject of the run: program, file, scene, lights.
std::string subject_lines(const RunFile& run) {
    std::string text = title_lines(run);
    for (const std::string& note : run.source_notes) {
        text += line("source", one_line(note));
    }
    return text;
}

std::string sampling_line(const RunSpec& spec, const std::string& effort) {
    return line(
        "sampling", fmt::format(
                        "{}, {}, seed {}, {}", spec.sampler, effort, spec.seed,
                        counted(thread_count(spec.threads), "thread")));
}

std::string sampling_line(const RunSpec& spec, const Result& result) {
    return sampling_line(
        spec,
        fmt::format(
            "{} x {}", counted(result.paths, "path"), counted(result.replicates, "replicate")));
}

/// The method, and the reason for its choice.
std::string method_line(const RunSpec& spec, const Result& result) {
    const bool is_automatic = spec.method == Method::automatic;
    const bool has_reason = is_automatic || result.stop == StopReason::no_light;
    return line(
        "method", fmt::format(
                      "{} ({}){}", method_name(result.chosen.method),
                      is_automatic ? "automatic" : "requested",
                      has_reason ? ": " + result.chosen.reason : ""));
}

/// Whether light was computed elsewhere: the sums come from parts of a run.
bool is_merged(std::uint64_t rays, double solve_seconds) {
    return rays > 0 && solve_seconds == 0;
}

std::string time_line(const Result& result) {
    if (is_merged(result.rays, result.solve_seconds)) {
        return line("time", "computed in parts");
    }
    const auto paths = static_cast<double>(result.paths);
    const double own = paths - result.paths_before;
    if (result.paths > 0 && own <= 0) {
        return line("time", "all paths are from the checkpoint");
    }
    const std::string before =
        result.paths_before > 0
            ? fmt::format(
                  "; {:.3g} % of the paths are from the checkpoint", 100 * (1 - own / paths))
            : "";
    return line(
        "time", fmt::format(
                    "{:.3g} s ({:.3g} s CPU), preparation {:.3g} s; {:.3g} million paths/s{}",
                    result.solve_seconds, result.solve_cpu_seconds, result.preparation_seconds,
                    own * result.replicates / std::max(result.solve_seconds, 1e-9) / 1e6, before));
}

std::string error_line(const RunFile& run, const ErrorStatistics& errors) {
    const std::string advice = advice_on_error(run, errors.median);
    return line("errors", describe_errors(errors)) + (advice.empty() ? "" : line("advice", advice));
}

constexpr std::size_t kMaxBands = 4, kMaxOrigins = 8;

/// The budgets of the first bands. @param unit_of_band  of a band's budget
template <typename UnitOfBand>
std::string energy_lines(
    const Scene& scene,
    const std::vector<BandBudget>& budgets,
    bool escaped_by_difference,
    const UnitOfBand& unit_of_band) {
    std::string text;
    for (std::size_t b = 0; b < std::min(budgets.size(), kMaxBands); ++b) {
        const Band& band = scene.bands()[b];
        text += line(
            "energy", band.name + " " +
                          describe_energy(budgets[b], unit_of_band(band), escaped_by_difference));
    }
    if (budgets.size() > kMaxBands) {
        text +=
            line("", fmt::format("... and {}", counted(budgets.size() - kMaxBands, "more band")));
    }
    return text;
}

/// Adds the energy of a flux over `seconds`.
void add_energy(const BandBudget& flux, double seconds, BandBudget& sum) {
    for (Estimate BandBudget::*part :
         {&BandBudget::emitted, &BandBudget::absorbed_by_organs, &BandBudget::absorbed_by_ground,
          &BandBudget::escaped, &BandBudget::cut_off, &BandBudget::imbalance}) {
        (sum.*part).mean += seconds * (flux.*part).mean;
    }
}

/// The budgets of the first origins of light, in the first bands.
std::string origin_lines(const RunFile& run, const Result& result) {
    std::string text;
    for (std::size_t i = 0; i < std::min(result.origins.size(), kMaxOrigins); ++i) {
        const auto& [name, light] = result.origins[i];
        for (std::size_t b = 0; b < std::min(light.budget.size(), kMaxBands); ++b) {
            const Band& band = run.scene.bands()[b];
            text += line(
                "origin", fmt::format(
                              "{}: {} {}", one_line(name), band.name,
                              describe_energy(
                                  light.budget[b], flux_unit(band.unit, run.scene.length_unit()),
                                  result.escaped_by_difference)));
        }
    }
    if (result.origins.size() > kMaxOrigins) {
        const std::size_t more = result.origins.size() - kMaxOrigins;
        text += line("", fmt::format("... and {}", counted(more, "more origin")));
    }
    return text;
}

std::string canopy_lines(const RunFile& run, const CanopySum& canopy, const GroupResults* groups) {
    std::string text;
    for (const std::string& words : canopy.lines(run, groups)) {
        text += line("canopy", words);
    }
    return text;
}

/// The methods of the times: one name, or each with the number of times.
std::string series_method(const RunSpec& spec, const SeriesSummary& summary) {
    std::string text;
    for (const auto& [from, times] : summary.methods) {
        text += fmt::format(
            "{}{}{}", text.empty() ? "" : ", ", method_name(from),
            summary.methods.size() > 1 ? fmt::format(" at {}", counted(times, "time step")) : "");
    }
    return (text.empty() ? method_name(spec.method) : text) +
           (spec.method == Method::automatic ? " (automatic)" : " (requested)");
}

std::string target_line(const RunFile& run, const Result& result) {
    return run.spec.target_error > 0 ? line("target", describe_target(run, result)) : "";
}

std::string written_line(const std::vector<std::string>& written) {
    if (written.empty()) {
        return line("written", "nothing; name a file with --csv FILE, --json FILE or in [output]");
    }
    return line("written", fmt::format("{}", fmt::join(written, ", ")));
}

/// How many time steps there are, and how many were computed.
std::string describe_times(const TimeSeries& series, const SeriesSummary& summary) {
    const TimeStepNotes& first = series.notes.front();
    const TimeStepNotes& last = series.notes.back();
    if (series.cumulative_sky == CumulativeSky::none) {
        return fmt::format(
            "{} from {} to {}, {}: {} computed, {} at night or scaled from another",
            series.time_steps.size(), first.time, last.time, counted(series.days.size(), "day"),
            summary.computed, summary.completed - std::min(summary.computed, summary.completed));
    }
    std::size_t times = 0;
    std::size_t suns = 0;
    for (const TimeStepNotes& notes : series.notes) {
        times += notes.cumulated->times;
        suns += notes.suns;
    }
    return fmt::format(
        "{} from {} to {}, in {} with {}: {} computed", times, first.time, last.cumulated->until,
        counted(series.notes.size(), "cumulative sky", "cumulative skies"),
        counted(suns, "sun position"), summary.computed);
}

std::string stopped_line(const std::string& words) {
    return words.empty() ? "" : line("stopped", words);
}

std::string series_time_line(const SeriesSummary& summary) {
    if (is_merged(summary.rays, summary.solve_seconds)) {
        return line("time", fmt::format("{:.3g} s to merge the parts", summary.seconds));
    }
    return line(
        "time",
        fmt::format(
            "{:.3g} s ({:.3g} s CPU), preparation {:.3g} s, results and files {:.3g} s",
            summary.solve_seconds, summary.solve_cpu_seconds, summary.preparation_seconds,
            std::max(0.0, summary.seconds - summary.preparation_seconds - summary.solve_seconds)));
}

/// How the times of a series were computed.
std::string series_lines(const RunFile& run, const SeriesSummary& summary) {
    const TimeSeries& series = *run.series;
    std::string text;
    for (const std::string& words : series.words) {
        const std::size_t end = words.find(": ");
        text += line(words.substr(0, end), one_line(words.substr(end + 2)));
    }
    text += line("time steps", describe_times(series, summary));
    text += sampling_line(
        run.spec,
        fmt::format(
            "{} x {} per time step{}", counted(run.spec.paths, "path"),
            counted(run.spec.replicates, "replicate"),
            run.spec.path_allocation == PathAllocation::proportional ? " on average" : ""));
    text += line("method", series_method(run.spec, summary));
    text += stopped_line(describe_stop(run, summary));
    text += series_time_line(summary);
    if (run.spec.target_error > 0) {
        text += line(
            "target", fmt::format(
                          "{:.6g} %: reached at {} of {}", 100 * run.spec.target_error,
                          summary.at_target, counted(summary.computed, "time step")));
    }
    if (summary.audited > 0) {
        text += line("audit", audit_line(summary));
    }
    return text;
}

std::string sensors_line(const RunFile& run, const Result& result) {
    if (run.scene.sensors().empty()) {
        return "";
    }
    return line(
        "sensors", result.sensors ? describe_sensors(*result.sensors)
                                  : describe_missing_sensors(run.spec, result.stop));
}

/// How the one time of a run without [time] was computed.
std::string result_lines(const RunFile& run, const Result& result) {
    CanopySum canopy(run.scene);
    canopy.add(result, 1);
    std::string text =
        sampling_line(run.spec, result) + stopped_line(describe_stop(run.spec, result)) +
        method_line(run.spec, result) + time_line(result) + target_line(run, result) +
        energy_lines(
            run.scene, result.budget, result.escaped_by_difference,
            [&](const Band& band) { return flux_unit(band.unit, run.scene.length_unit()); }) +
        origin_lines(run, result) + canopy_lines(run, canopy, &result.groups) +
        error_line(run, error_statistics(run.scene, result)) + sensors_line(run, result);
    for (const std::string& words : audit_lines(run, result)) {
        text += line("audit", words);
    }
    return text;
}

/// How the points of a sweep were computed.
std::string sweep_head(const RunFile& run, const SeriesSummary& summary, std::size_t points) {
    std::string text = title_lines(run);
    text += line(
        "sweep",
        fmt::format(
            "{} of {} completed; {} by {}{}", points, counted(run.sweep->size(), "point"),
            counted(summary.computed, "computation"), series_method(run.spec, summary),
            summary.with_fewer_paths > 0
                ? fmt::format("; {} with fewer paths than requested", summary.with_fewer_paths)
                : ""));
    if (run.spec.target_error > 0) {
        text += line(
            "target", fmt::format(
                          "reached by {} of {}", summary.at_target,
                          counted(summary.computed, "computation")));
    }
    return text + series_time_line(summary);
}

/// The table of the light that all organs absorb.
TableSpec table_of_summary() {
    return {
        .file = "",
        .rows = CsvRows::groups,
        .times = CsvTimes::sweep,
        .quantities = {"absorbed_flux"}};
}

/// The light that all organs absorb in the first bands, over all points of a sweep.
/// @param sum  of table_of_summary(), or null
std::string sum_lines(const RunFile& run, const SweepSum* sum) {
    if (sum == nullptr || !sum->is_complete()) {
        return "";
    }
    const GroupResults groups = sum->sum().groups;
    std::string text;
    for (std::size_t b = 0; b < std::min(groups.bands, kMaxBands); ++b) {
        const Band& band = run.scene.bands()[b];
        const Estimate absorbed = reported(groups.at(0, Quantity::absorbed_flux, b));
        const double error = absorbed.standard_error;
        text += line(
            "sweep",
            fmt::format(
                "{} of all points: {} organs absorb {:.4g}{} {}", run.series ? "sum" : "mean",
                band.name, absorbed.mean, std::isfinite(error) ? " +- " + error_text(error) : "",
                column_unit(run, CsvTimes::sweep, flux_unit(band.unit, run.scene.length_unit()))));
    }
    return text;
}

/// The first and the last points, if there are many.
std::string point_text(const std::vector<std::string>& points) {
    constexpr std::size_t kMaxLines = 20;
    std::string text;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool is_shown =
            points.size() <= kMaxLines || i + 1 < kMaxLines || i + 1 == points.size();
        text += is_shown ? points[i] : "";
        if (!is_shown && i + 2 == points.size()) {
            text +=
                line("", fmt::format("... {}", counted(points.size() - kMaxLines, "more point")));
        }
    }
    return text;
}

}  // namespace

Summary::Summary(const RunFile& run) : run_(&run) {
    if (std::ranges::any_of(run.output.tables, [](const TableSpec& table) {
            return table.times == CsvTimes::sweep;
        })) {
        sum_ = std::make_shared<SweepSum>(run, table_of_summary());
    }
}

Summary::Summary(const RunFile& run, Summary& before)
    : run_(&run), point_lines_(std::move(before.point_lines_)), sum_(std::move(before.sum_)) {}

bool Summary::wants(SeriesPart part) const {
    return part == SeriesPart::time_steps || (part == SeriesPart::sums && sum_ != nullptr);
}

void Summary::on_sums(const SeriesSums& sums) {
    sum_->add(sums);
}

void Summary::finish(const SeriesSummary& series_summary) {
    if (sum_) {
        sum_->end_point(is_complete(*run_, series_summary));
    }
}

void Summary::on_time_step(const TimeStepResult& step) {
    const Result& result = step.result;
    if (!run_->series && !run_->sweep) {
        result_lines_ = result_lines(*run_, result);
        return;
    }
    const std::size_t time_step = time_steps_++;
    const double seconds = run_->series ? run_->series->time_steps[time_step].seconds : 0;
    energy_.resize(result.budget.size());
    for (std::size_t b = 0; b < energy_.size(); ++b) {
        const Band& band = run_->scene.bands()[b];
        const double factor = summed_unit(flux_unit(band.unit, run_->scene.length_unit())).factor;
        add_energy(result.budget[b], factor * seconds, energy_[b]);
    }
    seconds_ += seconds;
    canopy_ = canopy_ ? canopy_ : std::make_shared<CanopySum>(run_->scene);
    canopy_->add(result, seconds);
    escaped_by_difference_ = escaped_by_difference_ || result.escaped_by_difference;
    const ErrorStatistics errors = error_statistics(run_->scene, result);
    if (errors.median > 0) {
        medians_.emplace_back(errors.median, time_step);
        badly_known_ = std::max(badly_known_, errors.badly_known);
    }
}

std::string Summary::series_quality() const {
    std::string text;
    if (seconds_ > 0) {
        text += energy_lines(run_->scene, energy_, escaped_by_difference_, [&](const Band& band) {
            return summed_unit(flux_unit(band.unit, run_->scene.length_unit())).name;
        });
        text += canopy_lines(*run_, *canopy_, nullptr);
    }
    for (const std::string& words : describe_controls(*run_)) {
        text += line("control", words);
    }
    if (medians_.empty()) {
        return text + line("errors", "absorbed flux: no standard error could be estimated");
    }
    auto medians = medians_;
    std::sort(medians.begin(), medians.end());
    const double middle = medians[medians.size() / 2].first;
    const auto& [worst, time_step] = medians.back();
    text += line(
        "errors",
        fmt::format(
            "absorbed flux, relative standard error, median of the organs: {} at the median time "
            "step, {} at the worst ({})",
            format_percent(middle), format_percent(worst), run_->series->notes[time_step].time));
    if (badly_known_ > 0) {
        text += line(
            "errors",
            fmt::format(
                "above {:.0f} % for up to {} at a time step; sums over days have smaller errors",
                100 * kBadlyKnown, counted(badly_known_, "organ")));
    }
    const std::string advice = advice_on_error(*run_, middle);
    return text + (advice.empty() ? "" : line("advice", advice));
}

/// The values that a point of a sweep sets, and its errors.
std::string Summary::point_line() const {
    const std::string words = fmt::format(
        "{} of {}: {}", run_->point + 1, run_->sweep->size(),
        one_line(describe_point((*run_->sweep)[run_->point])));
    auto medians = medians_;
    std::sort(medians.begin(), medians.end());
    const std::string errors =
        medians.empty() ? "unknown" : format_percent(medians[medians.size() / 2].first);
    return line("point", fmt::format("{}; median error {}", words, errors));
}

void Summary::next_run(const RunFile& run, const SeriesSummary& series_summary) {
    finish(series_summary);
    if (run_->sweep && time_steps_ > 0) {
        point_lines_.push_back(point_line());
    }
    *this = Summary(run, *this);
    if (sum_) {
        sum_->begin_point(run);
    }
}

std::string Summary::text(
    const SeriesSummary& summary, const std::vector<std::string>& written) const {
    if (!run_->sweep) {
        return subject_lines(*run_) +
               (run_->series ? series_lines(*run_, summary) + series_quality() : result_lines_) +
               written_line(written);
    }
    std::vector<std::string> points = point_lines_;
    if (time_steps_ > 0) {
        points.push_back(point_line());
    }
    return sweep_head(*run_, summary, points.size()) + point_text(points) +
           sum_lines(*run_, sum_.get()) + written_line(written);
}

std::string summary(
    const RunFile& run, const Result& result, const std::vector<std::string>& written) {
    Summary summary(run);
    summary.on_time_step({0, result});
    return summary.text({}, written);
}

}  // namespace quasimc

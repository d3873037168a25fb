#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "checkpoint_run.h"
#include "commands.h"
#include "help_run.h"
#include "interrupt.h"
#include "io/results/audit_words.h"
#include "io/results/part_file.h"
#include "io/results/read_result.h"
#include "part_run.h"
#include "progress.h"
#include "quasimc/quasimc.h"
#include "rank_team.h"
#include "repetition.h"
#include "run_window.h"
#include "run_writers.h"
#include "sweep_jobs.h"
#include "team_files.h"

quasimc::StoredSweep read_runs(
    const RunArguments& arguments, const quasimc::FileAccess& access) try {
    const std::vector<quasimc::Override> overrides = arguments.flags.overrides();
    if (arguments.from.empty()) {
        return {quasimc::read_run_sweep(arguments.file, overrides, access), ""};
    }
    return quasimc::read_result_sweep(arguments.from, overrides, access);
} catch (const std::bad_alloc&) {
    throw quasimc::InputError(
        {{arguments.from.empty() ? arguments.file : arguments.from,
          "there is not enough memory for the scene", "for it and the files that it names", ""}});
}

ProgressLines progress_lines(const RunArguments& arguments) {
    if (arguments.quiet) {
        return ProgressLines::none;
    }
    return arguments.progress ? ProgressLines::always : ProgressLines::on_terminal;
}

std::function<void()> stopping_note(const RunArguments& arguments) {
    if (arguments.quiet) {
        return [] {};
    }
    return [] { std::fputs("\nstopping; Ctrl-C again ends at once\n", stderr); };
}

void rethrow_of_file(
    const quasimc::InputError& error,
    const quasimc::RunFile& file,
    const std::vector<quasimc::Override>& flags) {
    std::vector<quasimc::Fault> faults = error.faults();
    for (quasimc::Fault& fault : faults) {
        const auto flag = std::find_if(flags.begin(), flags.end(), [&](const auto& stated) {
            return stated.key == fault.place;
        });
        fault.place = flag != flags.end() ? flag->place : file.path + ": " + fault.place;
    }
    throw quasimc::InputError(std::move(faults));
}

namespace {

/// What an audit found goes to stderr, quiet or not: it is about errors.
void print_audit(double chance) {
    const std::string warning = quasimc::audit_warning(chance);
    if (!warning.empty()) {
        std::fprintf(stderr, "warning: %s\n", warning.c_str());
    }
}

/// @throws quasimc::InputError
void require_times(const RunArguments& arguments, const quasimc::RunFile& run) {
    quasimc::Faults faults;
    for (const auto& [flag, path] :
         {std::pair("--days", &arguments.days),
          std::pair("--groups-days", &arguments.groups_days)}) {
        if (!path->empty() && !run.series) {
            faults.add({flag, "the run has no [time]", "sums over days need times", ""});
        }
    }
    faults.throw_if_any();
}

/// What all points of a sweep have together.
void add_point(const quasimc::SeriesSummary& point, quasimc::SeriesSummary& all) {
    all.traced += point.traced;
    all.unlit += point.unlit;
    all.at_target += point.at_target;
    all.done += point.done;
    all.cut_short += point.cut_short;
    all.stop = point.stop == quasimc::StopReason::paths_done ? all.stop : point.stop;
    // Of the most unlikely audit, times their number.
    if (point.audited > 0) {
        const double count = static_cast<double>(all.audited);
        const double own = static_cast<double>(point.audited);
        const double least =
            std::min(count > 0 ? all.audit_chance / count : 1.0, point.audit_chance / own);
        all.audited += point.audited;
        all.audit_chance = std::min(1.0, least * (count + own));
    }
    all.rays += point.rays;
    all.seconds += point.seconds;
    all.build_seconds += point.build_seconds;
    all.trace_seconds += point.trace_seconds;
    all.trace_cpu_seconds += point.trace_cpu_seconds;
    for (const auto& [method, times] : point.methods) {
        all.methods[method] += times;
    }
}

/// Computes the runs of a sweep, one after the other, until all are done or Ctrl-C or the limit of
/// time stops them.
class SweepRun {
  public:
    /// @param parts  which the sums of the runs are taken from; null: they are traced
    /// @param team  which they are traced with; null: alone
    SweepRun(
        const RunArguments& arguments,
        quasimc::RunSweep& sweep,
        quasimc::PartFiles* parts,
        quasimc::RunTeam* team)
        : arguments_(arguments),
          sweep_(sweep),
          parts_(parts),
          team_(team),
          run_(next_file(0)),
          writers_(arguments, *run_),
          interrupt_(std::in_place, stopping_note(arguments)),
          checkpoint_(arguments, *run_),
          tell_(progress_line(progress_lines(arguments))) {
        if (arguments.view) {
            window_.emplace(*run_, 0);
        }
    }

    void compute() {
        while (trace(interrupt_->token()) && point_ + 1 < sweep_.size() && goes_on()) {
            std::unique_ptr<quasimc::RunFile> next = next_file(++point_);
            writers_.next_run(*next, last_);
            if (window_) {
                window_->next_run(*next);
            }
            run_ = std::move(next);
        }
        checkpoint_.flush();
        point_runs_.reset();
        if (window_) {
            window_->finish(all_.stop);
        }
        interrupt_.reset();
    }

    /// The page stays for who wants to see the result. One who has stopped the run wants to leave.
    void stay() const {
        if (window_ && all_.stop != quasimc::StopReason::interrupted) {
            RunWindow::stay();
        }
    }

    /// Of all points that are done. Its total is that of the last one.
    [[nodiscard]] const quasimc::SeriesSummary& all() const { return all_; }
    [[nodiscard]] const quasimc::SeriesSummary& last() const { return last_; }
    [[nodiscard]] const quasimc::RunFile& file() const { return *run_; }
    [[nodiscard]] RunWriters& writers() { return writers_; }
    [[nodiscard]] const CheckpointRun& checkpoint() const { return checkpoint_; }

  private:
    [[nodiscard]] std::unique_ptr<quasimc::RunFile> next_file(std::size_t point) {
        auto run = std::make_unique<quasimc::RunFile>(sweep_.take(point));
        apply_choice(arguments_.choice, *run);
        if (point == 0) {
            require_times(arguments_, *run);
        }
        return run;
    }

    /// Whether there is time for another point.
    bool goes_on() {
        const double limit = run_->spec.max_seconds;
        if (limit > 0 && all_.seconds >= limit && all_.stop != quasimc::StopReason::interrupted) {
            last_.stop = all_.stop = quasimc::StopReason::time_is_up;
            return false;
        }
        return last_.stop != quasimc::StopReason::interrupted;
    }

    /// Traces a point. @returns false  if there is no result of it, and others are there
    bool trace(const std::stop_token& stop) {
        quasimc::RunSpec spec = run_->spec;
        const auto points_left = static_cast<double>(sweep_.size() - point_);
        if (spec.max_seconds > 0) {
            constexpr double kLeast = 1e-3;
            spec.max_seconds = std::max(spec.max_seconds - all_.seconds, kLeast) / points_left;
        }
        try {
            const std::vector<quasimc::TimeStep> moments = quasimc::moments_of(*run_);
            checkpoint_.set_moments_before(moments_before_);
            last_ = quasimc::run_series(simulator_, run_->scene, moments, spec, events(), stop);
            moments_before_ += moments.size();
        } catch (const quasimc::Stopped& stopped) {
            checkpoint_.flush();
            if (point_ == 0) {
                throw;
            }
            last_ = {};
            last_.stop = all_.stop = stopped.why();
            return false;
        } catch (const quasimc::InputError& error) {
            writers_.throw_if_given_up();
            if (parts_ != nullptr) {
                throw;
            }
            rethrow_of_file(error, *run_, arguments_.flags.overrides());
        }
        add_point(last_, all_);
        return true;
    }

    /// Of all points, which take about equally long.
    [[nodiscard]] std::function<void(const quasimc::Progress&)> progress() const {
        if (!tell_ || sweep_.size() == 1) {
            return tell_;
        }
        return [this](const quasimc::Progress& own) {
            const double fraction =
                (static_cast<double>(point_) + own.fraction) / static_cast<double>(sweep_.size());
            const double seconds = all_.seconds + own.seconds;
            tell_({fraction, seconds, seconds / fraction, own.fraction_at_target});
        };
    }

    [[nodiscard]] quasimc::SeriesEvents events() {
        quasimc::SeriesEvents events = writers_.events(progress());
        if (window_) {
            window_->listen(events);
        }
        events.checkpoint = checkpoint_.hooks();
        events.team = team_;
        if (team_ != nullptr) {
            team_->point = point_;
            share_points();
            events.traced_runs = point_runs_ ? &traced_points_ : nullptr;
        }
        if (parts_ != nullptr) {
            events.sums_of = [this](std::size_t moment) {
                return parts_->next(moments_before_ + moment);
            };
        }
        return events;
    }

    /// Lets the ranks trace the points from this one on each by itself, unless a checkpoint knows
    /// one of them: what it knows is traced together.
    void share_points() {
        bool is_kept = false;
        for (std::size_t i = point_; checkpoint_.hooks() != nullptr && i < sweep_.size(); ++i) {
            is_kept = is_kept || checkpoint_.hooks()->has_state(i - point_);
        }
        if (point_runs_ || parts_ != nullptr || is_kept) {
            return;
        }
        const auto jobs = jobs_of_points(*run_, sweep_.size(), point_, team_->size);
        if (jobs.empty()) {
            return;
        }
        point_runs_ = std::make_unique<quasimc::TeamRuns>(
            *team_, quasimc::TeamOrder{.is_runs = quasimc::TeamOrder::kPoints, .point = point_},
            jobs, point_tracer(simulator_, sweep_));
        traced_points_.take = [this](std::size_t, const quasimc::RunControl& control) {
            return point_runs_->take(point_, control);
        };
    }

    const RunArguments& arguments_;
    quasimc::RunSweep& sweep_;
    quasimc::PartFiles* parts_;
    quasimc::RunTeam* team_;
    std::size_t point_ = 0;
    std::size_t moments_before_ = 0;  // of the points before
    std::unique_ptr<quasimc::RunFile> run_;
    RunWriters writers_;
    std::optional<InterruptWatch> interrupt_;  // before what has threads and what is left behind
    CheckpointRun checkpoint_;
    std::function<void(const quasimc::Progress&)> tell_;
    std::optional<RunWindow> window_;
    quasimc::Simulator simulator_;
    std::unique_ptr<quasimc::TeamRuns> point_runs_;  // once ranks trace points
    quasimc::TracedRuns traced_points_;
    quasimc::SeriesSummary last_, all_;
};

Exit exit_of(const quasimc::RunFile& file, const quasimc::SeriesSummary& summary) {
    if (summary.stop == quasimc::StopReason::interrupted) {
        return Exit::interrupted;
    }
    const bool missed = file.spec.target_error > 0 && summary.at_target < summary.traced;
    return missed || summary.stop == quasimc::StopReason::time_is_up ? Exit::target_missed
                                                                     : Exit::done;
}

/// That nothing was lit goes to stderr: the numbers are right, but the scene is hardly what is
/// meant.
void print_unlit(const quasimc::SeriesSummary& summary, bool has_times) {
    if (summary.unlit > 0) {
        const std::string when =
            has_times ? fmt::format(" at {} of the {} times traced", summary.unlit, summary.traced)
                      : "";
        std::fprintf(
            stderr,
            "warning: no light reaches the scene%s: all of it is edge-on to the light, or out of "
            "its way; all numbers are 0 then\n",
            when.c_str());
    }
}

Exit run(
    const RunArguments& arguments,
    quasimc::StoredSweep stored,
    quasimc::PartFiles* parts,
    quasimc::RunTeam* team = nullptr) {
    if (!arguments.quiet) {
        print_warnings(stored.runs.warnings());
    }
    SweepRun sweep(arguments, stored.runs, parts, team);
    sweep.compute();
    if (parts != nullptr) {
        parts->expect_end();
    }
    end_progress_line();
    const std::string digest = sweep.writers().finish(sweep.last());
    const Repetition repetition =
        judge_repetition(arguments, stored, digest, sweep.writers().difference(), sweep.all().stop);
    print_unlit(sweep.all(), stored.runs.size() > 1 || sweep.file().series.has_value());
    print_audit(sweep.all().audit_chance);
    if (!arguments.quiet) {
        sweep.writers().print_summary(
            sweep.all(), repetition.verdict.empty()
                             ? ""
                             : fmt::format("{:<10}{}\n", "repeated", repetition.verdict));
    }
    sweep.writers().throw_if_given_up();
    sweep.checkpoint().throw_if_given_up();
    if (repetition.has_failed) {
        throw quasimc::InputError({{"--from", repetition.verdict, "", ""}});
    }
    sweep.stay();
    return exit_of(sweep.file(), sweep.all());
}

/// With the other ranks of the job, if there are any.
Exit run_with_others(const RunArguments& arguments) {
    const std::unique_ptr<RankTeam> ranks = RankTeam::join();
    if (!ranks) {
        return run(arguments, read_runs(arguments), nullptr);
    }
    quasimc::RunTeam& team = ranks->team();
    return ranks->run([&] {
        return team.is_first ? run(arguments, read_for_team(arguments, team), nullptr, &team)
                             : help_run(arguments, team);
    });
}

Exit merge(const RunArguments& arguments) {
    quasimc::PartFiles parts(arguments.parts);
    return run(arguments, parts.read_runs(), &parts);
}

/// The flags that name files to be written, and those files.
std::array<std::pair<std::string_view, const std::string*>, 10> outputs_of(
    const RunArguments& arguments) {
    return {{
        {"--csv", &arguments.csv},
        {"--json", &arguments.json},
        {"--days", &arguments.days},
        {"--groups-csv", &arguments.groups_csv},
        {"--groups-days", &arguments.groups_days},
        {"--picture", &arguments.picture},
        {"--vtp", &arguments.vtp},
        {"--ply", &arguments.ply},
        {"--glb", &arguments.glb},
        {"--nc", &arguments.nc},
    }};
}

/// @throws UsageError
void check_outputs(const RunArguments& arguments) {
    const auto files = outputs_of(arguments);
    for (std::size_t i = 0; i < files.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (!files[i].second->empty() && *files[i].second == *files[j].second) {
                throw UsageError(
                    fmt::format("{} and {}: name the same file", files[j].first, files[i].first));
            }
        }
    }
}

/// @throws UsageError
void check_usage(const RunArguments& arguments) {
    if (arguments.file.empty() && arguments.from.empty()) {
        throw UsageError("FILE or --from RESULT is required");
    }
    if (arguments.part.empty() && !arguments.sums.empty()) {
        throw UsageError("--sums: is the file of a --part");
    }
    if (!arguments.part.empty() && arguments.view) {
        throw UsageError("--view: a --part has no results to be seen");
    }
    if (arguments.checkpoint.empty() &&
        (arguments.resume || arguments.every != RunArguments::kUsualEvery)) {
        throw UsageError("--every and --resume: are of a --checkpoint");
    }
    if (arguments.checkpoint == "-") {
        throw UsageError("--checkpoint: is a file, not standard output");
    }
    if (std::isnan(arguments.every)) {
        throw UsageError("--every: nan is no time");
    }
    for (const auto& [flag, path] : outputs_of(arguments)) {
        if (!arguments.part.empty() && !path->empty()) {
            throw UsageError(
                fmt::format("{}: a --part has no results; `quasimc merge` writes them", flag));
        }
    }
    check_outputs(arguments);
}

/// Of what is written and told.
std::vector<Flag> output_flags(RunArguments& arguments) {
    std::vector<Flag> flags{
        {.name = "--csv",
         .target = &arguments.csv,
         .summary = "write the table of organs here; - is standard output",
         .type_name = "FILE"},
        {.name = "--json",
         .target = &arguments.json,
         .summary = "write everything here; - is standard output",
         .type_name = "FILE"},
        {.name = "--days",
         .target = &arguments.days,
         .summary =
             "of a run with [time]: write the table of sums over days here; - is standard output",
         .type_name = "FILE"},
        {.name = "--groups-csv",
         .target = &arguments.groups_csv,
         .summary = "write the table of groups of organs here; - is standard output",
         .type_name = "FILE"},
        {.name = "--groups-days",
         .target = &arguments.groups_days,
         .summary = "of a run with [time]: write the table of sums of groups over days here; - is "
                    "standard output",
         .type_name = "FILE"},
        {.name = "--picture",
         .target = &arguments.picture,
         .summary = "draw the light that organs absorb here, PNG or SVG; `quasimc show` draws more",
         .type_name = "FILE"},
        {.name = "--vtp",
         .target = &arguments.vtp,
         .summary = "write the scene with its numbers here, for ParaView and pyvista",
         .type_name = "FILE"},
        {.name = "--ply",
         .target = &arguments.ply,
         .summary = "the same as PLY, for MeshLab and CloudCompare",
         .type_name = "FILE"},
        {.name = "--glb",
         .target = &arguments.glb,
         .summary = "the same as binary glTF, coloured, for Blender",
         .type_name = "FILE"},
        {.name = "--nc",
         .target = &arguments.nc,
         .summary = "write the light by organ, band and time here, for xarray and others",
         .type_name = "FILE"},
        {"-q,--quiet", &arguments.quiet, "print errors only: no summary, warnings or progress"},
        {"--progress", &arguments.progress, "tell the progress even if stderr is no terminal"}};
    add_choice_flags(arguments.choice, flags);
    return flags;
}

std::vector<Flag> flags_of_run(RunArguments& arguments) {
    std::vector<Flag> flags{
        {.name = "FILE",
         .target = &arguments.file,
         .summary = "run file (docs/formats/run-file.md); - is standard input",
         .excludes = "--from"},
        {.name = "--from",
         .target = &arguments.from,
         .summary = "repeat the run of this JSON result instead",
         .type_name = "RESULT"},
        {.name = "--part",
         .target = &arguments.part,
         .summary = "compute this part of the run alone, 3/16 the third of sixteen, for "
                    "`quasimc merge`",
         .type_name = "K/N"},
        {.name = "--sums",
         .target = &arguments.sums,
         .summary = "write the part here; by default NAME.KofN.part in the current folder",
         .type_name = "FILE"},
        {.name = "--checkpoint",
         .target = &arguments.checkpoint,
         .summary = "keep here what was computed, so that --resume can go on from it",
         .type_name = "FILE",
         .excludes = "--part"},
        {.name = "--every",
         .target = &arguments.every,
         .summary = "seconds from one checkpoint to the next",
         .type_name = "SECONDS",
         .range = std::pair(0.0, 1e6),
         .default_text = "60"},
        {"--view", &arguments.view,
         "serve a page to the browsers of this machine that follows the run; its address is "
         "printed, and Ctrl-C ends it"},
        {"--resume", &arguments.resume,
         "go on from the checkpoint, if it is there; paths, target_error, target_fraction, "
         "max_paths and "
         "max_seconds may be others than before"}};
    for (Flag& flag : output_flags(arguments)) {
        flags.push_back(std::move(flag));
    }
    arguments.flags.add_to(flags);
    return flags;
}

std::vector<Flag> flags_of_merge(RunArguments& arguments) {
    std::vector<Flag> flags{
        {.name = "PART",
         .target = &arguments.parts,
         .summary = "files of `quasimc run --part`: all parts of one run, in any order",
         .required = true}};
    for (Flag& flag : output_flags(arguments)) {
        flags.push_back(std::move(flag));
    }
    return flags;
}

}  // namespace

Command run_command() {
    const auto arguments = std::make_shared<RunArguments>();
    return {
        "run", "compute the light on every organ of a scene", flags_of_run(*arguments),
        [arguments] {
            return arguments->part.empty() ? run_with_others(*arguments) : run_part(*arguments);
        },
        [arguments] { check_usage(*arguments); }};
}

Command merge_command() {
    const auto arguments = std::make_shared<RunArguments>();
    return {
        "merge", "put the parts of a run together, which other machines have computed",
        flags_of_merge(*arguments), [arguments] { return merge(*arguments); },
        [arguments] { check_outputs(*arguments); }};
}

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "base/number_text.h"
#include "commands.h"
#include "option_flags.h"
#include "progress.h"
#include "quasimc/quasimc.h"
#include "runfile/run_file.h"

namespace {

using quasimc::counted;

struct CheckArguments {
    std::string file;
    OptionFlags flags;
};

std::string times_of(const quasimc::TimeSeries& series) {
    if (series.cumulative_sky == quasimc::CumulativeSky::none) {
        const auto lit = std::count_if(
            series.notes.begin(), series.notes.end(),
            [](const auto& notes) { return notes.daylight.global() > 0; });
        return fmt::format(
            "{}, {}, {} of them with daylight\n", counted(series.time_steps.size(), "time step"),
            counted(series.days.size(), "day"), lit);
    }
    std::size_t times = 0;
    std::size_t suns = 0;
    for (const quasimc::TimeStepNotes& notes : series.notes) {
        times += notes.cumulated->times;
        suns += notes.suns;
    }
    return fmt::format(
        "{} in {} with {}\n", counted(times, "time step"),
        series.time_steps.size() == 1
            ? "1 cumulative sky"
            : fmt::format("{} cumulative skies", series.time_steps.size()),
        counted(suns, "sun position"));
}

/// The sources as text; the sun and sky of time steps are not among the sources of the file.
std::string light_of(const quasimc::RunFile& run) {
    const std::size_t given = run.sources.size();
    if (!run.series) {
        return counted(given, "source");
    }
    return fmt::format(
        "sun and sky for {}{}", counted(run.series->time_steps.size(), "time step"),
        given > 0 ? ", " + counted(given, "source") : "");
}

Exit check(const CheckArguments& arguments) {
    quasimc::RunSweep sweep = quasimc::read_run_sweep(
        arguments.file, arguments.flags.overrides(), quasimc::FileAccess(),
        points_line(ProgressLines::on_terminal));
    end_progress_line();
    const std::size_t warnings = sweep.warnings().size();
    print_warnings(sweep.warnings());
    const quasimc::RunFile run = sweep.take(0);
    std::string text = fmt::format(
        "{}: no errors, {}; {}, {}, {}, {}, {}\n", run.path,
        warnings == 0 ? "no warnings" : counted(warnings, "warning"),
        counted(run.scene.organs().size(), "organ"),
        counted(run.scene.triangle_count(), "triangle"),
        counted(run.scene.material_names().size(), "material"),
        counted(run.scene.bands().size(), "band"), light_of(run));
    if (run.sweep) {
        text += fmt::format("a sweep of {}\n", counted(sweep.size(), "point"));
    }
    text += run.series ? times_of(*run.series) : "";
    std::fputs(text.c_str(), stdout);
    return Exit::done;
}

}  // namespace

Command check_command() {
    const auto arguments = std::make_shared<CheckArguments>();
    Command command{
        "check",
        "read a run file and all that it names, and report errors and warnings",
        {{"FILE", &arguments->file, "run file, - for standard input", true}},
        [arguments] { return check(*arguments); }};
    arguments->flags.add_to(command.flags);
    return command;
}

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "commands.h"
#include "io/runfile/run_file.h"
#include "option_flags.h"
#include "progress.h"
#include "quasimc/quasimc.h"

namespace {

struct CheckArguments {
    std::string file;
    OptionFlags flags;
};

std::string times_of(const quasimc::TimeSeries& series) {
    if (series.collapse == quasimc::Collapse::none) {
        const auto lit = std::count_if(
            series.notes.begin(), series.notes.end(),
            [](const auto& notes) { return notes.daylight.global() > 0; });
        return fmt::format(
            "{} times of {} days, {} of them with daylight\n", series.time_steps.size(),
            series.days.size(), lit);
    }
    std::size_t times = 0;
    std::size_t suns = 0;
    for (const quasimc::MomentNotes& notes : series.notes) {
        times += notes.collapsed->times;
        suns += notes.suns;
    }
    return fmt::format(
        "{} times collapsed into {} traces of {} suns in all\n", times, series.time_steps.size(),
        suns);
}

/// Sun and sky of a series are not among the sources that the file states.
std::string light_of(const quasimc::RunFile& run) {
    const std::size_t stated = run.sources.size();
    if (!run.series) {
        return fmt::format("{} sources", stated);
    }
    return stated > 0 ? fmt::format("sun, sky and {} sources", stated) : "sun and sky";
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
        "{}: no fault, {} warnings; {} organs, {} triangles, {} materials, {} bands, {}\n",
        run.path, warnings, run.scene.organs().size(), run.scene.triangle_count(),
        run.scene.material_names().size(), run.scene.bands().size(), light_of(run));
    if (run.sweep) {
        text += fmt::format("a sweep of {} points\n", sweep.size());
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
        "read a run file and all it names, say what is wrong, run nothing",
        {{"FILE", &arguments->file, "run file; - is standard input", true}},
        [arguments] { return check(*arguments); }};
    arguments->flags.add_to(command.flags);
    return command;
}

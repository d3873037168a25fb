#include <cstdio>
#include <memory>

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
        return fmt::format("{} times of {} days\n", series.time_steps.size(), series.days.size());
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

Exit check(const CheckArguments& arguments) {
    quasimc::RunSweep sweep = quasimc::read_run_sweep(
        arguments.file, arguments.flags.overrides(), quasimc::FileAccess(),
        points_line(ProgressLines::on_terminal));
    end_progress_line();
    const std::size_t warnings = sweep.warnings().size();
    print_warnings(sweep.warnings());
    const quasimc::RunFile run = sweep.take(0);
    std::string text = fmt::format(
        "{}: no fault, {} warnings; {} organs, {} triangles, {} materials, {} bands, {} sources\n",
        run.path, warnings, run.scene.organs().size(), run.scene.triangle_count(),
        run.scene.material_names().size(), run.scene.bands().size(), run.sources.size());
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

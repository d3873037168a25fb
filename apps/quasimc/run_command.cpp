#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/process_time.h"
#include "commands.h"
#include "files/writable.h"
#include "help_run.h"
#include "parallel/part_file.h"
#include "part_run.h"
#include "progress.h"
#include "quasimc/quasimc.h"
#include "rank_team.h"
#include "repetition.h"
#include "resultio/describe_result.h"
#include "resultio/read_result.h"
#include "run_flags.h"
#include "run_writers.h"
#include "sweep_run.h"
#include "team_files.h"
#include "terminal.h"

quasimc::StoredSweep read_runs(
    const RunArguments& arguments, const quasimc::FileAccess& access) try {
    std::vector<quasimc::Override> overrides = overrides_of(arguments.choice);
    const std::vector<quasimc::Override> given = arguments.flags.overrides();
    overrides.insert(overrides.end(), given.begin(), given.end());
    if (arguments.from.empty()) {
        quasimc::StoredSweep read{
            quasimc::read_run_sweep(
                arguments.file, overrides, access, points_line(progress_lines(arguments))),
            ""};
        end_progress_line();
        return read;
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

quasimc::InputError error_of_file(
    const quasimc::InputError& error,
    const quasimc::RunFile& file,
    const std::vector<quasimc::Override>& flags) {
    std::vector<quasimc::Fault> faults = error.faults();
    for (quasimc::Fault& fault : faults) {
        const auto flag = std::find_if(flags.begin(), flags.end(), [&](const auto& given) {
            return given.key == fault.where;
        });
        fault.where = flag != flags.end() ? flag->where : file.path + ": " + fault.where;
    }
    return quasimc::InputError(std::move(faults));
}

namespace {

/// Prints a failed audit on stderr, even with --quiet.
void print_audit(double p_value) {
    const std::string warning = quasimc::audit_warning(p_value);
    if (!warning.empty()) {
        print_warning(warning);
    }
}

Exit exit_of(const quasimc::RunFile& file, const quasimc::SeriesSummary& summary) {
    if (summary.stop == quasimc::StopReason::interrupted) {
        return Exit::interrupted;
    }
    const bool missed = file.spec.target_error > 0 && summary.at_target < summary.computed;
    return missed || summary.stop == quasimc::StopReason::time_limit ? Exit::target_missed
                                                                     : Exit::done;
}

/// Warns on stderr if nothing was lit: the numbers are right, but the scene is probably wrong.
void print_unlit(const quasimc::SeriesSummary& summary, bool has_times) {
    if (summary.unlit > 0) {
        const std::string when =
            has_times
                ? fmt::format(" at {} of the {} computed times", summary.unlit, summary.computed)
                : "";
        print_warning(fmt::format(
            "no light reaches the scene{}: all surfaces are parallel to the light or outside of "
            "it; all results are 0 there",
            when));
    }
}

/// Warns on stderr if the run was stopped before the light on sensors was computed.
void print_missing_sensors(const quasimc::RunFile& run, const quasimc::SeriesSummary& summary) {
    if (summary.without_sensors > 0) {
        const std::string when =
            summary.computed > 1
                ? fmt::format(
                      "at {} of the {} computed times: ", summary.without_sensors, summary.computed)
                : "";
        print_warning(fmt::format(
            "sensors: {}{}; the results have none there", when,
            quasimc::describe_missing_sensors(run.spec, summary.stop)));
    }
}

/// @param reading  started when reading the files began
Exit run(
    const RunArguments& arguments,
    const quasimc::Stopwatch& reading,
    quasimc::StoredSweep stored,
    quasimc::PartFiles* parts,
    quasimc::RunTeam* team = nullptr) {
    if (!arguments.quiet) {
        print_warnings(stored.runs.warnings());
    }
    SweepRun sweep(arguments, stored.runs, parts, team, reading);
    sweep.compute();
    if (parts != nullptr) {
        parts->expect_end();
    }
    end_progress_line();
    const RunWriters::Repeated repeated = sweep.writers().finish(sweep.last());
    const Repetition repetition =
        judge_repetition(arguments, stored, repeated.digest, repeated.difference, sweep.all().stop);
    print_unlit(sweep.all(), stored.runs.size() > 1 || sweep.file().series.has_value());
    print_missing_sensors(sweep.file(), sweep.all());
    print_audit(sweep.all().audit_p_value);
    if (!arguments.quiet) {
        sweep.writers().print_summary(
            sweep.all(), repetition.verdict.empty()
                             ? ""
                             : fmt::format("{:<10}{}\n", "repeated", repetition.verdict));
    }
    sweep.writers().faults().throw_if_any();
    sweep.checkpoint().throw_if_given_up();
    if (repetition.has_failed) {
        throw quasimc::InputError({{arguments.from, repetition.verdict, "", ""}});
    }
    sweep.stay();
    return exit_of(sweep.file(), sweep.all());
}

/// Access to files that examines the outputs of a run file, except those that flags replace.
quasimc::FileAccess access_with_outputs(const RunArguments& arguments) {
    quasimc::FileAccess access;
    access.why_unwritable = [&arguments](std::string_view key, const std::filesystem::path& path) {
        const auto flag = arguments.outputs.find(key);
        const bool is_replaced = flag != arguments.outputs.end() && !flag->second.empty();
        return is_replaced ? std::string() : quasimc::why_unwritable(path);
    };
    return access;
}

/// Runs together with the other ranks of the job, if there are any.
Exit run_with_others(const RunArguments& arguments) {
    const std::unique_ptr<RankTeam> ranks = RankTeam::join();
    const quasimc::Stopwatch reading;
    if (!ranks) {
        return run(
            arguments, reading, read_runs(arguments, access_with_outputs(arguments)), nullptr);
    }
    RankTeam& team = *ranks;
    return team.run([&] {
        return team.is_first()
                   ? run(arguments, reading, read_for_team(arguments, team), nullptr, &team)
                   : help_run(arguments, team);
    });
}

Exit merge(const RunArguments& arguments) {
    const quasimc::Stopwatch reading;
    quasimc::PartFiles parts(arguments.parts);
    return run(arguments, reading, parts.read_runs(), &parts);
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
        "merge", "join the parts of a run and write its results", flags_of_merge(*arguments),
        [arguments] { return merge(*arguments); }};
}

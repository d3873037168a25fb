#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands.h"
#include "io/atomic_file.h"
#include "io/results/audit_words.h"
#include "option_flags.h"
#include "progress.h"
#include "quasimc/quasimc.h"

namespace {

/// What the command line of `quasimc run` says.
struct RunArguments {
    std::string file, from, csv, json, days;
    bool quiet = false;
    OptionFlags flags;
};

/// The files to write, opened before the run so that a wrong path is told at once.
struct Outputs {
    std::unique_ptr<quasimc::AtomicFile> csv, json, days;
    std::vector<std::string> names;  ///< of real files
    bool uses_stdout = false;

    std::unique_ptr<quasimc::AtomicFile> open(const std::optional<std::string>& path) {
        if (!path) {
            return nullptr;
        }
        (*path == "-") ? static_cast<void>(uses_stdout = true) : names.push_back(*path);
        return std::make_unique<quasimc::AtomicFile>(*path);
    }
};

/// Paths on the command line count from the current folder, and go before those of the run file.
Outputs open_outputs(const RunArguments& arguments, quasimc::OutputSpec spec) {
    if (!arguments.csv.empty()) {
        spec.csv = arguments.csv;
    }
    if (!arguments.json.empty()) {
        spec.json = arguments.json;
    }
    if (!arguments.days.empty()) {
        spec.days = arguments.days;
    }
    Outputs outputs;
    outputs.csv = outputs.open(spec.csv);
    outputs.json = outputs.open(spec.json);
    outputs.days = outputs.open(spec.days);
    return outputs;
}

void write_outputs(Outputs& outputs, const quasimc::RunFile& run, const quasimc::Result& result) {
    if (outputs.csv) {
        quasimc::write_csv(run, result, [&](std::string_view text) { outputs.csv->write(text); });
        outputs.csv->commit();
    }
    if (outputs.json) {
        quasimc::write_json(run, result, [&](std::string_view text) { outputs.json->write(text); });
        outputs.json->commit();
    }
}

quasimc::StoredRun read_run(const RunArguments& arguments) {
    const std::vector<quasimc::Override> overrides = arguments.flags.overrides();
    if (arguments.from.empty()) {
        return {quasimc::read_run_file(arguments.file, overrides), ""};
    }
    return quasimc::read_result_file(arguments.from, overrides);
}

std::string comparison(
    const RunArguments& arguments,
    const quasimc::StoredRun& stored,
    const std::string& organs_sha256) {
    if (arguments.from.empty()) {
        return "";
    }
    const bool same = organs_sha256 == stored.organs_sha256;
    const std::string_view verdict = same ? "the same numbers as in" : "OTHER numbers than in";
    return fmt::format("{:<10}{} {}\n", "repeated", verdict, arguments.from);
}

quasimc::TextSink sink_of(const std::unique_ptr<quasimc::AtomicFile>& file) {
    return [&file](std::string_view text) {
        if (file) {
            file->write(text);
        }
    };
}

/// What a series writes while it is computed.
struct SeriesOutputs {
    Outputs files;
    quasimc::TextSink csv = sink_of(files.csv), days = sink_of(files.days);

    void commit() const {
        for (const auto* file : {&files.csv, &files.json, &files.days}) {
            if (*file) {
                (*file)->commit();
            }
        }
    }
};

/// What an audit found goes to stderr, whether or not there is a summary.
void print_audit(double chance) {
    const std::string warning = quasimc::audit_warning(chance);
    if (!warning.empty()) {
        std::fprintf(stderr, "warning: %s\n", warning.c_str());
    }
}

Exit run_times(const RunArguments& arguments, const quasimc::StoredRun& stored, Outputs opened) {
    const quasimc::RunFile& file = stored.run;
    const SeriesOutputs outputs{std::move(opened)};
    const bool has_csv = outputs.files.csv != nullptr;
    const bool has_days = outputs.files.days != nullptr;
    std::optional<quasimc::SeriesJson> json;
    if (outputs.files.json || !arguments.from.empty()) {
        json.emplace(file, sink_of(outputs.files.json));
    }
    if (has_csv) {
        quasimc::write_series_csv_head(file, outputs.csv);
    }
    if (has_days) {
        quasimc::write_days_head(file, outputs.days);
    }
    quasimc::SeriesEvents events;
    events.on_progress = progress_line();
    events.on_time_step = [&](std::size_t time_step, const quasimc::Result& result,
                              std::size_t traced) {
        if (has_csv) {
            quasimc::write_series_csv_moment(file, time_step, result, outputs.csv);
        }
        if (json) {
            json->add_moment(time_step, result, traced);
        }
    };
    events.on_day = [&](std::size_t day, const quasimc::SeriesSum& sum) {
        if (has_days) {
            quasimc::write_days_day(file, day, sum, outputs.days);
        }
        if (json) {
            json->add_day(day, sum);
        }
    };
    const quasimc::SeriesSummary summary =
        quasimc::run_series(file.scene, file.series->time_steps, file.spec, events);
    end_progress_line();
    const std::string digest = json ? json->finish(summary) : "";
    outputs.commit();
    print_audit(summary.audit_chance);
    if (!arguments.quiet) {
        const std::string text = quasimc::series_summary(file, summary, outputs.files.names) +
                                 comparison(arguments, stored, digest);
        std::fputs(text.c_str(), outputs.files.uses_stdout ? stderr : stdout);
    }
    const bool missed = file.spec.target_error > 0 && summary.at_target < summary.traced;
    return missed ? Exit::target_missed : Exit::done;
}

Exit run(const RunArguments& arguments) {
    const quasimc::StoredRun stored = read_run(arguments);
    const quasimc::RunFile& file = stored.run;
    print_warnings(file.warnings);
    if (!arguments.days.empty() && !file.series) {
        throw quasimc::InputError(
            {{"--days", "the run has no [time]", "sums over days need times", ""}});
    }
    Outputs outputs = open_outputs(arguments, file.output);
    if (file.series) {
        return run_times(arguments, stored, std::move(outputs));
    }
    const quasimc::Result result =
        quasimc::run(file.scene, file.sources, file.spec, progress_line());
    end_progress_line();
    write_outputs(outputs, file, result);
    print_audit(result.audit ? result.audit->chance : 1);
    if (!arguments.quiet) {
        const std::string text =
            quasimc::summary(file, result, outputs.names) +
            comparison(
                arguments, stored,
                arguments.from.empty() ? "" : quasimc::digest_of_organs(file, result));
        std::fputs(text.c_str(), outputs.uses_stdout ? stderr : stdout);
    }
    const bool missed =
        file.spec.target_error > 0 && result.stop != quasimc::StopReason::target_reached;
    return missed ? Exit::target_missed : Exit::done;
}

}  // namespace

void add_run_command(CLI::App& program, Action& action) {
    const auto arguments = std::make_shared<RunArguments>();
    CLI::App* command =
        program.add_subcommand("run", "compute the light on every organ of a scene");
    CLI::Option* file = command->add_option(
        "FILE", arguments->file, "run file (docs/formats/run-file.md); - is standard input");
    CLI::Option* from =
        command->add_option("--from", arguments->from, "repeat the run of this JSON result instead")
            ->type_name("RESULT");
    file->excludes(from);
    command
        ->add_option(
            "--csv", arguments->csv, "write the table of organs here; - is standard output")
        ->type_name("FILE");
    command->add_option("--json", arguments->json, "write everything here; - is standard output")
        ->type_name("FILE");
    command
        ->add_option(
            "--days", arguments->days,
            "of a run with [time]: write the table of sums over days here; - is standard output")
        ->type_name("FILE");
    command->add_flag("-q,--quiet", arguments->quiet, "no summary");
    arguments->flags.add_to(*command);
    command->callback([arguments, &action] {
        if (arguments->file.empty() && arguments->from.empty()) {
            throw CLI::RequiredError("FILE or --from RESULT");
        }
        if (!arguments->csv.empty() && arguments->csv == arguments->json) {
            throw CLI::ValidationError("--csv and --json", "name the same file");
        }
        if (!arguments->days.empty() &&
            (arguments->days == arguments->csv || arguments->days == arguments->json)) {
            throw CLI::ValidationError("--days", "names the same file as another output");
        }
        action = [arguments] { return run(*arguments); };
    });
}

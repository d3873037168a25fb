#include <array>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "commands.h"
#include "io/atomic_file.h"
#include "io/results/audit_words.h"
#include "option_flags.h"
#include "output_choice.h"
#include "progress.h"
#include "quasimc/quasimc.h"

namespace {

/// What the command line of `quasimc run` says.
struct RunArguments {
    std::string file, from, csv, json, days, groups_csv, groups_days;
    OutputChoice choice;
    bool quiet = false;
    OptionFlags flags;
};

/// The files to write, opened before the run so that a wrong path is told at once.
struct Outputs {
    std::unique_ptr<quasimc::AtomicFile> csv, json, days, groups_csv, groups_days;
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
    const auto set = [](std::optional<std::string>& path, const std::string& stated) {
        path = stated.empty() ? path : stated;
    };
    set(spec.csv, arguments.csv);
    set(spec.json, arguments.json);
    set(spec.days, arguments.days);
    set(spec.groups_csv, arguments.groups_csv);
    set(spec.groups_days, arguments.groups_days);
    Outputs outputs;
    outputs.csv = outputs.open(spec.csv);
    outputs.json = outputs.open(spec.json);
    outputs.days = outputs.open(spec.days);
    outputs.groups_csv = outputs.open(spec.groups_csv);
    outputs.groups_days = outputs.open(spec.groups_days);
    return outputs;
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
    const bool is_same = organs_sha256 == stored.organs_sha256;
    const bool can_tell = stored.is_comparable && !stored.organs_sha256.empty();
    const std::string_view verdict =
        is_same    ? "the same numbers as in"
        : can_tell ? "OTHER numbers than in"
                   : "whether the numbers are the same can't be told (another version wrote it):";
    return fmt::format("{:<10}{} {}\n", "repeated", verdict, arguments.from);
}

/// What a run writes while it is computed.
class RunWriters {
  public:
    /// Opens the files, so that a wrong path is told before anything is computed.
    RunWriters(const RunArguments& arguments, const quasimc::RunFile& run)
        : run_(run), outputs_(open_outputs(arguments, run.output)), summary_(run) {
        if (outputs_.csv) {
            csv_.emplace(run, sink_of(*outputs_.csv));
        }
        if (outputs_.days) {
            days_.emplace(run, sink_of(*outputs_.days));
        }
        if (outputs_.groups_csv) {
            groups_.emplace(run, sink_of(*outputs_.groups_csv));
        }
        if (outputs_.groups_days) {
            group_days_.emplace(run, sink_of(*outputs_.groups_days));
        }
        if (outputs_.json) {
            json_.emplace(run, sink_of(*outputs_.json));
        } else if (!arguments.from.empty()) {
            json_.emplace(run);  // for the digest
        }
    }

    /// What the run is to tell.
    [[nodiscard]] quasimc::SeriesEvents events() {
        quasimc::SeriesEvents events;
        events.on_progress = progress_line();
        events.on_time_step = [this](auto time_step, const auto& result, auto traced) {
            add_moment(time_step, result, traced);
        };
        events.wants_total = run_.series && outputs_.json;
        if (days_ || group_days_ || events.wants_total) {
            events.on_day = [this](auto day, const auto& sum) { add_day(day, sum); };
        }
        return events;
    }

    /// Gives the files their names. @returns the digest of the organs, if it was asked for
    std::string finish(const quasimc::SeriesSummary& summary) {
        std::string digest = json_ ? json_->finish(summary) : "";
        for (const auto* file :
             {&outputs_.csv, &outputs_.json, &outputs_.days, &outputs_.groups_csv,
              &outputs_.groups_days}) {
            if (*file) {
                (*file)->commit();
            }
        }
        return digest;
    }

    void print_summary(const quasimc::SeriesSummary& summary, const std::string& comparison) const {
        const std::string text = summary_.text(summary, outputs_.names) + comparison;
        std::fputs(text.c_str(), outputs_.uses_stdout ? stderr : stdout);
    }

  private:
    static quasimc::TextSink sink_of(quasimc::AtomicFile& file) {
        return [&file](std::string_view text) { file.write(text); };
    }

    void add_moment(std::size_t time_step, const quasimc::Result& result, std::size_t traced) {
        end_progress_line();
        summary_.add_moment(result);
        if (csv_) {
            csv_->add_moment(time_step, result);
        }
        if (groups_) {
            groups_->add_moment(time_step, result);
        }
        if (json_) {
            json_->add_moment(time_step, result, traced);
        }
    }

    void add_day(std::size_t day, const quasimc::SeriesSum& sum) {
        if (days_) {
            days_->add_day(day, sum);
        }
        if (group_days_) {
            group_days_->add_day(day, sum);
        }
        if (json_) {
            json_->add_day(day, sum);
        }
    }

    const quasimc::RunFile& run_;
    Outputs outputs_;
    quasimc::Summary summary_;
    std::optional<quasimc::CsvWriter> csv_;
    std::optional<quasimc::DaysWriter> days_;
    std::optional<quasimc::GroupsWriter> groups_;
    std::optional<quasimc::GroupDaysWriter> group_days_;
    std::optional<quasimc::JsonWriter> json_;
};

/// What an audit found goes to stderr, whether or not there is a summary.
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

Exit run(const RunArguments& arguments) {
    quasimc::StoredRun stored = read_run(arguments);
    apply_choice(arguments.choice, stored.run);
    const quasimc::RunFile& file = stored.run;
    print_warnings(file.warnings);
    require_times(arguments, file);
    RunWriters writers(arguments, file);
    const quasimc::SeriesSummary summary =
        quasimc::run_series(file.scene, quasimc::moments_of(file), file.spec, writers.events());
    end_progress_line();
    const std::string digest = writers.finish(summary);
    print_audit(summary.audit_chance);
    if (!arguments.quiet) {
        writers.print_summary(summary, comparison(arguments, stored, digest));
    }
    const bool missed = file.spec.target_error > 0 && summary.at_target < summary.traced;
    return missed ? Exit::target_missed : Exit::done;
}

/// @throws UsageError
void check_usage(const RunArguments& arguments) {
    if (arguments.file.empty() && arguments.from.empty()) {
        throw UsageError("FILE or --from RESULT is required");
    }
    const std::array<std::pair<std::string_view, const std::string*>, 5> files{{
        {"--csv", &arguments.csv},
        {"--json", &arguments.json},
        {"--days", &arguments.days},
        {"--groups-csv", &arguments.groups_csv},
        {"--groups-days", &arguments.groups_days},
    }};
    for (std::size_t i = 0; i < files.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (!files[i].second->empty() && *files[i].second == *files[j].second) {
                throw UsageError(
                    fmt::format("{} and {}: name the same file", files[j].first, files[i].first));
            }
        }
    }
}

std::vector<Flag> flags_of(RunArguments& arguments) {
    std::vector<Flag> flags{
        {.name = "FILE",
         .target = &arguments.file,
         .summary = "run file (docs/formats/run-file.md); - is standard input",
         .excludes = "--from"},
        {.name = "--from",
         .target = &arguments.from,
         .summary = "repeat the run of this JSON result instead",
         .type_name = "RESULT"},
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
        {"-q,--quiet", &arguments.quiet, "no summary"}};
    add_choice_flags(arguments.choice, flags);
    arguments.flags.add_to(flags);
    return flags;
}

}  // namespace

Command run_command() {
    const auto arguments = std::make_shared<RunArguments>();
    return {
        "run", "compute the light on every organ of a scene", flags_of(*arguments),
        [arguments] { return run(*arguments); }, [arguments] { check_usage(*arguments); }};
}

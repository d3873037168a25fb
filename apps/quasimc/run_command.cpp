#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "commands.h"
#include "interrupt.h"
#include "io/output_files.h"
#include "io/results/audit_words.h"
#include "io/results/part_file.h"
#include "option_flags.h"
#include "output_choice.h"
#include "progress.h"
#include "quasimc/quasimc.h"

namespace {

/// What the command line of `quasimc run` says.
struct RunArguments {
    std::string file, from, csv, json, days, groups_csv, groups_days;
    std::string part, sums;          // of `run` alone
    std::vector<std::string> parts;  // of `merge` alone: files
    OutputChoice choice;
    bool quiet = false, progress = false;
    OptionFlags flags;
};

/// The files that a run may write, in the order in which they get their names: the result that has
/// everything is the last.
using Output = std::size_t;
constexpr Output kCsv = 0, kDays = 1, kGroups = 2, kGroupDays = 3, kJson = 4, kOutputs = 5;

/// Which of them a run writes, and where.
struct Asked {
    std::array<std::optional<std::size_t>, kOutputs> numbers;  // among the paths
    std::vector<quasimc::OutputPath> paths;
};

/// Paths on the command line count from the current folder, and go before those of the run file.
Asked asked_outputs(const RunArguments& arguments, const quasimc::RunFile& run) {
    Asked asked;
    const auto ask = [&](Output output, std::string_view key, const std::string& flag,
                         const std::optional<std::string>& stated) {
        if (!flag.empty()) {
            asked.numbers[output] = asked.paths.size();
            std::string name = fmt::format("--{}", key);
            std::replace(name.begin(), name.end(), '_', '-');
            asked.paths.push_back({flag, std::move(name)});
        } else if (stated) {
            asked.numbers[output] = asked.paths.size();
            asked.paths.push_back({*stated, fmt::format("{}: [output]: {}", run.path, key)});
        }
    };
    ask(kCsv, "csv", arguments.csv, run.output.csv);
    ask(kDays, "days", arguments.days, run.output.days);
    ask(kGroups, "groups_csv", arguments.groups_csv, run.output.groups_csv);
    ask(kGroupDays, "groups_days", arguments.groups_days, run.output.groups_days);
    ask(kJson, "json", arguments.json, run.output.json);
    return asked;
}

/// What was read: beside the files of the run, the result that is repeated.
std::vector<quasimc::InputFile> inputs_of(
    const RunArguments& arguments, const quasimc::RunFile& run) {
    std::vector<quasimc::InputFile> inputs = run.inputs;
    if (!arguments.from.empty()) {
        inputs.push_back({arguments.from, arguments.from, "", 0, false});
    }
    for (const std::string& part : arguments.parts) {
        inputs.push_back({part, part, "", 0, false});
    }
    return inputs;
}

quasimc::StoredRun read_run(const RunArguments& arguments) try {
    const std::vector<quasimc::Override> overrides = arguments.flags.overrides();
    if (arguments.from.empty()) {
        return {quasimc::read_run_file(arguments.file, overrides), ""};
    }
    return quasimc::read_result_file(arguments.from, overrides);
} catch (const std::bad_alloc&) {
    throw quasimc::InputError(
        {{arguments.from.empty() ? arguments.file : arguments.from,
          "there is not enough memory for the scene", "for it and the files that it names", ""}});
}

std::string comparison(
    const RunArguments& arguments,
    const quasimc::StoredRun& stored,
    const std::string& organs_sha256) {
    if (arguments.from.empty() || organs_sha256.empty()) {
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
        : run_(run),
          asked_(asked_outputs(arguments, run)),
          outputs_(asked_.paths, inputs_of(arguments, run)),
          summary_(run) {
        if (wants(kCsv)) {
            csv_.emplace(run, sink_of(kCsv));
        }
        if (wants(kDays)) {
            days_.emplace(run, sink_of(kDays));
        }
        if (wants(kGroups)) {
            groups_.emplace(run, sink_of(kGroups));
        }
        if (wants(kGroupDays)) {
            group_days_.emplace(run, sink_of(kGroupDays));
        }
        if (wants(kJson)) {
            json_.emplace(run, sink_of(kJson));
        } else if (!arguments.from.empty()) {
            json_.emplace(run);  // for the digest
        }
    }

    /// What the run is to tell.
    [[nodiscard]] quasimc::SeriesEvents events(ProgressLines lines) {
        quasimc::SeriesEvents events;
        events.on_progress = progress_line(lines);
        events.on_time_step = [this](auto time_step, const auto& result, auto traced) {
            add_moment(time_step, result, traced);
        };
        events.wants_total = run_.series && wants(kJson);
        if (days_ || group_days_ || events.wants_total) {
            events.on_day = [this](auto day, const auto& sum) { add_day(day, sum); };
        }
        return events;
    }

    /// Gives the files their names. @returns the digest of the organs, if it was asked for
    std::string finish(const quasimc::SeriesSummary& summary) {
        std::string digest;
        write_json([&](quasimc::JsonWriter& json) { digest = json.finish(summary); });
        outputs_.commit();
        return digest;
    }

    void print_summary(const quasimc::SeriesSummary& summary, const std::string& comparison) const {
        const std::string text = summary_.text(summary, outputs_.written()) + comparison;
        std::fputs(text.c_str(), outputs_.uses_standard_output() ? stderr : stdout);
    }

    /// @throws InputError  if some of the files could not be written
    void throw_if_given_up() const { outputs_.throw_if_given_up(); }

  private:
    [[nodiscard]] bool wants(Output output) const { return asked_.numbers[output].has_value(); }

    quasimc::TextSink sink_of(Output output) { return outputs_.sink(*asked_.numbers[output]); }

    /// No room for what the writer keeps until the end costs no more than its own file.
    template <typename Action>
    void write_json(Action action) {
        if (!json_) {
            return;
        }
        try {
            action(*json_);
        } catch (const quasimc::InputError& error) {
            if (!wants(kJson)) {
                throw;
            }
            json_.reset();
            outputs_.give_up(*asked_.numbers[kJson], error);
        }
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
        write_json([&](auto& json) { json.add_moment(time_step, result, traced); });
    }

    void add_day(std::size_t day, const quasimc::SeriesSum& sum) {
        if (days_) {
            days_->add_day(day, sum);
        }
        if (group_days_) {
            group_days_->add_day(day, sum);
        }
        write_json([&](auto& json) { json.add_day(day, sum); });
    }

    const quasimc::RunFile& run_;
    Asked asked_;
    quasimc::OutputFiles outputs_;
    quasimc::Summary summary_;
    std::optional<quasimc::CsvWriter> csv_;
    std::optional<quasimc::DaysWriter> days_;
    std::optional<quasimc::GroupsWriter> groups_;
    std::optional<quasimc::GroupDaysWriter> group_days_;
    std::optional<quasimc::JsonWriter> json_;
};

/// What an audit found goes to stderr, quiet or not: it is about errors.
void print_audit(double chance) {
    const std::string warning = quasimc::audit_warning(chance);
    if (!warning.empty()) {
        std::fprintf(stderr, "warning: %s\n", warning.c_str());
    }
}

ProgressLines progress_lines(const RunArguments& arguments) {
    if (arguments.quiet) {
        return ProgressLines::none;
    }
    return arguments.progress ? ProgressLines::always : ProgressLines::on_terminal;
}

InterruptWatch interrupt_watch(const RunArguments& arguments) {
    return InterruptWatch([&arguments] {
        if (!arguments.quiet) {
            std::fputs("\nstopping; Ctrl-C again ends at once\n", stderr);
        }
    });
}

/// Faults that show only when a run begins are of the run file.
[[noreturn]] void rethrow_of_file(const quasimc::InputError& error, const quasimc::RunFile& file) {
    std::vector<quasimc::Fault> faults = error.faults();
    for (quasimc::Fault& fault : faults) {
        fault.place = file.path + ": " + fault.place;
    }
    throw quasimc::InputError(std::move(faults));
}

/// Computes the run, which Ctrl-C stops.
quasimc::SeriesSummary compute(
    const RunArguments& arguments,
    const quasimc::RunFile& file,
    RunWriters& writers,
    quasimc::PartFiles* parts) {
    const InterruptWatch interrupt = interrupt_watch(arguments);
    quasimc::SeriesEvents events = writers.events(progress_lines(arguments));
    if (parts != nullptr) {
        events.sums_of = [parts](std::size_t moment) { return parts->next(moment); };
    }
    try {
        return quasimc::run_series(
            file.scene, quasimc::moments_of(file), file.spec, events, interrupt.token());
    } catch (const quasimc::InputError& error) {
        writers.throw_if_given_up();
        if (parts != nullptr) {
            throw;
        }
        rethrow_of_file(error, file);
    }
}

/// "canopy.3of16.part" in the current folder for canopy.toml.
std::string usual_part_name(const std::string& run_file, const quasimc::PartNumber& number) {
    const std::string stem =
        run_file == "-" ? "run" : std::filesystem::path(run_file).stem().string();
    return fmt::format("{}.{}of{}.part", stem, number.part, number.parts);
}

/// Computes a part of the run, and writes its sums.
Exit run_part(const RunArguments& arguments) {
    const quasimc::PartNumber number = quasimc::read_part_number(arguments.part, "--part");
    const quasimc::StoredRun stored = read_run(arguments);
    const quasimc::RunFile& file = stored.run;
    if (!arguments.quiet) {
        print_warnings(file.warnings);
    }
    const std::string name =
        arguments.sums.empty() ? usual_part_name(file.path, number) : arguments.sums;
    quasimc::OutputFiles output({{name, "--sums"}}, inputs_of(arguments, file));
    quasimc::PartWriter writer(file, number, output.sink(0));
    const InterruptWatch interrupt = interrupt_watch(arguments);
    try {
        quasimc::trace_share(
            file.scene, quasimc::moments_of(file), file.spec,
            quasimc::share_of(number.part, number.parts),
            [&](std::size_t moment, const quasimc::Sums& sums) {
                end_progress_line();
                writer.add(moment, sums);
            },
            {.on_progress = progress_line(progress_lines(arguments)), .stop = interrupt.token()});
    } catch (const quasimc::InputError& error) {
        output.throw_if_given_up();
        rethrow_of_file(error, file);
    }
    end_progress_line();
    writer.finish();
    output.commit();
    output.throw_if_given_up();
    if (!arguments.quiet) {
        std::fprintf(
            output.uses_standard_output() ? stderr : stdout,
            "part %llu of %llu: %s; put all together with: quasimc merge PART...\n",
            static_cast<unsigned long long>(number.part),
            static_cast<unsigned long long>(number.parts), name.c_str());
    }
    return Exit::done;
}

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

Exit run(
    const RunArguments& arguments, quasimc::StoredRun stored, quasimc::PartFiles* parts = nullptr) {
    apply_choice(arguments.choice, stored.run);
    const quasimc::RunFile& file = stored.run;
    if (!arguments.quiet) {
        print_warnings(file.warnings);
    }
    require_times(arguments, file);
    RunWriters writers(arguments, file);
    const quasimc::SeriesSummary summary = compute(arguments, file, writers, parts);
    end_progress_line();
    if (parts != nullptr) {
        parts->expect_end();
    }
    const std::string digest = writers.finish(summary);
    print_unlit(summary, file.series.has_value());
    print_audit(summary.audit_chance);
    if (!arguments.quiet) {
        writers.print_summary(summary, comparison(arguments, stored, digest));
    }
    writers.throw_if_given_up();
    return exit_of(file, summary);
}

Exit run(const RunArguments& arguments) {
    return arguments.part.empty() ? run(arguments, read_run(arguments)) : run_part(arguments);
}

Exit merge(const RunArguments& arguments) {
    quasimc::PartFiles parts(arguments.parts);
    return run(arguments, parts.read_run(), &parts);
}

/// The flags that name files to be written, and those files.
std::array<std::pair<std::string_view, const std::string*>, 5> outputs_of(
    const RunArguments& arguments) {
    return {{
        {"--csv", &arguments.csv},
        {"--json", &arguments.json},
        {"--days", &arguments.days},
        {"--groups-csv", &arguments.groups_csv},
        {"--groups-days", &arguments.groups_days},
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
         .type_name = "FILE"}};
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
        [arguments] { return run(*arguments); }, [arguments] { check_usage(*arguments); }};
}

Command merge_command() {
    const auto arguments = std::make_shared<RunArguments>();
    return {
        "merge", "put the parts of a run together, which other machines have computed",
        flags_of_merge(*arguments), [arguments] { return merge(*arguments); },
        [arguments] { check_outputs(*arguments); }};
}

#include <cstddef>
#include <cstdio>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "base/stop.h"
#include "commands.h"
#include "files/output_files.h"
#include "interrupt.h"
#include "option_flags.h"
#include "quasimc/quasimc.h"
#include "resultio/gap_texts.h"
#include "runfile/run_file.h"

namespace {

struct GapsArguments {
    std::string file, csv;
    std::size_t threads = 0;
};

/// The table of gap fractions.
std::string table_of(
    const quasimc::SceneOfRun& read, const std::vector<quasimc::GapFractions>& found) {
    std::string text =
        fmt::format("# QuasiMC {}, table of gap fractions, format 1\n", quasimc::version());
    for (const quasimc::InputFile& input : read.inputs) {
        text += fmt::format("# input: {} (sha256 {})\n", input.path, input.sha256);
    }
    text += quasimc::gap_header({});
    for (const quasimc::GapFractions& gaps : found) {
        text += quasimc::gap_rows(gaps, "");
    }
    return text;
}

Exit measure_gaps(const GapsArguments& arguments) {
    const InterruptWatch interrupt([] {});
    const quasimc::SceneOfRun read = quasimc::read_scene_of_run(arguments.file);
    print_warnings(read.warnings);
    if (read.gap_fractions.empty()) {
        throw quasimc::InputError(
            {{arguments.file, "it has no [[gap_fraction]]", "it names the positions that look up",
              "for example: [[gap_fraction]] with at = [[0, 0, 1]]"}});
    }
    std::vector<quasimc::OutputPath> outputs;
    if (!arguments.csv.empty()) {
        outputs.push_back({arguments.csv, "--csv"});
    }
    quasimc::OutputFiles files(outputs, read.inputs);
    std::vector<quasimc::GapFractions> found;
    for (quasimc::GapFractionSpec spec : read.gap_fractions) {
        spec.threads = static_cast<unsigned>(arguments.threads);
        found.push_back(quasimc::gap_fractions(read.scene, spec, interrupt.token()));
    }
    if (!arguments.csv.empty()) {
        files.sink(0)(table_of(read, found));
        files.commit();
        files.throw_if_given_up();
    }
    for (const quasimc::GapFractions& gaps : found) {
        std::fputs(
            quasimc::describe_gaps(gaps).c_str(), files.uses_standard_output() ? stderr : stdout);
    }
    return Exit::done;
}

Exit measure_or_stop(const GapsArguments& arguments) {
    try {
        return measure_gaps(arguments);
    } catch (const quasimc::StopRequested&) {
        return Exit::interrupted;
    }
}

}  // namespace

Command gaps_command() {
    const auto arguments = std::make_shared<GapsArguments>();
    return {
        "gaps",
        "measure gap fractions and plant area indices from positions in a canopy",
        {{"FILE", &arguments->file, "run file, - for standard input", true},
         {.name = "--csv",
          .target = &arguments->csv,
          .summary = "write all numbers as a table (- for standard output)",
          .type_name = "FILE"},
         {.name = "--threads",
          .target = &arguments->threads,
          .summary = "threads; 0: all; does not change results",
          .type_name = "N"}},
        [arguments] { return measure_or_stop(*arguments); }};
}

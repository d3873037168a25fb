#include "part_run.h"

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "files/output_files.h"
#include "option_flags.h"
#include "parallel/part_file.h"

namespace {

/// "canopy.3of16.part" in the current folder for canopy.toml.
std::string default_name(const std::string& run_file, const quasimc::PartNumber& number) {
    const std::string stem = run_file.empty() || run_file == "-"
                                 ? "run"
                                 : std::filesystem::path(run_file).stem().string();
    return fmt::format("{}.{}of{}.part", stem, number.part, number.parts);
}

/// Traces a part of every point of a sweep.
void trace_points(
    const RunArguments& arguments,
    const quasimc::PartNumber& number,
    const quasimc::RunFile& first,
    quasimc::RunSweep& sweep,
    quasimc::PartWriter& writer) {
    const InterruptWatch interrupt(stopping_note(arguments));
    ProgressLine line(progress_lines(arguments));
    const quasimc::Work all({&line});
    const double each = 1 / static_cast<double>(sweep.size());
    quasimc::Simulator simulator;  // for lamps under control
    std::size_t before = 0;        // time steps of the points before
    for (std::size_t point = 0; point < sweep.size(); ++point) {
        quasimc::RunFile run = point == 0 ? first : sweep.take(point);
        const std::vector<quasimc::TimeStep> time_steps = quasimc::time_steps_of(run, simulator);
        try {
            quasimc::trace_share(
                run.scene, time_steps, run.spec, quasimc::share_of(number.part, number.parts),
                [&](std::size_t time_step, const quasimc::Sums& sums) {
                    end_progress_line();
                    writer.add(before + time_step, sums);
                },
                {.stop = interrupt.token(),
                 .work = all.part(static_cast<double>(point) * each, each)});
        } catch (const quasimc::InputError& error) {
            throw error_of_file(error, run, arguments.flags.overrides());
        }
        before += time_steps.size();
    }
}

}  // namespace

Exit run_part(const RunArguments& arguments) {
    const quasimc::PartNumber number = quasimc::read_part_number(arguments.part, "--part");
    quasimc::StoredSweep stored = read_runs(arguments);
    if (!arguments.quiet) {
        print_warnings(stored.runs.warnings());
    }
    const quasimc::RunFile first = stored.runs.take(0);
    const std::string name =
        arguments.sums.empty() ? default_name(arguments.file, number) : arguments.sums;
    quasimc::OutputFiles output({{name, "--part-file"}}, inputs_of(arguments, first));
    quasimc::PartWriter writer(first, number, output.sink(0));
    try {
        trace_points(arguments, number, first, stored.runs, writer);
    } catch (const quasimc::InputError&) {
        output.throw_if_given_up();
        throw;
    }
    end_progress_line();
    writer.finish();
    output.commit();
    output.throw_if_given_up();
    if (!arguments.quiet) {
        const std::string text = fmt::format(
            "part {} of {}: {}; join all parts with: quasimc merge PART...\n", number.part,
            number.parts, name);
        std::fputs(text.c_str(), output.uses_standard_output() ? stderr : stdout);
    }
    return Exit::done;
}

#include "convert_netcdf.h"

#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "io/input_files.h"
#include "io/output_files.h"
#include "io/results/read_light.h"
#include "io/results/read_result.h"
#include "netcdf/netcdf_writer.h"

namespace {

void refuse_choices(const ValueChoice& choice) {
    quasimc::Faults faults;
    const auto refuse = [&](bool is_stated, const char* flag, const char* axis) {
        if (is_stated) {
            faults.add(
                {flag, std::string("a NetCDF file has all ") + axis,
                 "each has its place along an axis", "leave it out"});
        }
    };
    refuse(!choice.time.empty(), "--time", "times");
    refuse(!choice.day.empty(), "--day", "days");
    refuse(choice.point > 0, "--point", "points of a sweep");
    faults.throw_if_any();
}

/// @param text  of the run in the result
void add_run(
    std::string_view text,
    const std::string& path,
    const quasimc::RunFile& run,
    quasimc::NetcdfWriter& writer) {
    quasimc::LightEvents events;
    events.on_time_step = [&](std::size_t time_step, const quasimc::Result& result) {
        writer.add_moment(time_step, result);
    };
    events.on_day = [&](std::size_t day, const quasimc::SeriesSum& sum) {
        writer.add_day(day, sum);
    };
    quasimc::read_light(text, path, run, events);
}

}  // namespace

void convert_to_netcdf(
    const std::string& input, const std::string& output, const ValueChoice& choice) {
    refuse_choices(choice);
    const std::string text = quasimc::read_file(input);
    quasimc::StoredSweep stored =
        quasimc::read_result_text(text, input, quasimc::absolute_path(input).parent_path());
    quasimc::RunFile run = stored.runs.take(0);
    std::vector<quasimc::InputFile> inputs = run.inputs;
    inputs.push_back({input, input, "", 0, false});
    quasimc::OutputFiles outputs({{output, "OUTPUT"}}, inputs);
    quasimc::NetcdfWriter writer(run, outputs.sink(0), stored.program_version);
    if (!run.sweep) {
        add_run(text, input, run, writer);
    } else {
        // Those of a sweep that was stopped are the first ones.
        const std::vector<std::string_view> points = quasimc::point_texts(text, input);
        for (std::size_t i = 0; i < points.size() && i < stored.runs.size(); ++i) {
            if (i > 0) {
                run = stored.runs.take(i);
                writer.next_run(run);
            }
            add_run(points[i], input, run, writer);
        }
    }
    writer.finish();
    outputs.commit();
    outputs.throw_if_given_up();
}

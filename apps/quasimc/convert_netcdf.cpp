#include "convert_netcdf.h"

#include <vector>

#include "files/input_files.h"
#include "files/output_files.h"
#include "netcdf/netcdf_writer.h"
#include "resultio/read_result.h"
#include "resultio/replay_result.h"

namespace {

void refuse_choices(const ValueChoice& choice) {
    quasimc::Faults faults;
    const auto refuse = [&](bool is_given, const char* flag, const char* axis) {
        if (is_given) {
            faults.add(
                {flag, std::string("a NetCDF file has all ") + axis,
                 "each has its place along an axis", "remove it"});
        }
    };
    refuse(!choice.time.empty(), "--time", "times");
    refuse(!choice.day.empty(), "--day", "days");
    refuse(choice.point > 0, "--sweep-point", "points of a sweep");
    faults.throw_if_any();
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
    const auto writer = quasimc::make_netcdf_writer(run, outputs.sink(0), stored.program_version);
    quasimc::replay_result(text, input, stored.runs, run, *writer);
    outputs.commit();
    outputs.throw_if_given_up();
}

#pragma once

// The catalogue of outputs: the files that a run may write.
//
// To add an output, tools/new.py output NAME makes its writer, its test and its page, and enters it
// here: a declaration and a row. The key of [output], its check, the flag, `quasimc list outputs`
// and the order in which files get their names follow from the row.

#include <memory>
#include <string_view>
#include <vector>

namespace quasimc {

class OutputWriter;  // quasimc/result_file.h
struct OutputInput;  // resultio/output_input.h

/// What a run file must have for an output; nothing by default.
struct OutputNeed {
    std::string_view table = {};   ///< the key of a table: "time"
    std::string_view shown = {};   ///< the same for messages: "[time]"
    std::string_view reason = {};  ///< why it must be there
};
inline constexpr OutputNeed kNeedsTimes{"time", "[time]", "sums over days need times"};
inline constexpr OutputNeed kNeedsDetectors{
    "detector", "[[detector]]", "there is nothing to be written without"};

/// An output as users see it.
struct OutputKey {
    std::string_view name;     ///< the key of [output]; its flag is called so too, with hyphens
    std::string_view summary;  ///< one line for the manual
    OutputNeed need = {};
};

/// Makes the writer of an output. The modules that write stand above this one: a program that reads
/// run files alone links none of them.
using MakeOutput = std::unique_ptr<OutputWriter>(const OutputInput& input);
MakeOutput make_csv, make_daily_csv, make_groups_csv, make_groups_daily_csv, make_detectors,
    make_picture, make_vtp, make_ply, make_glb, make_netcdf, make_json;
// (tools/new.py declares an output above this line)

/// Calls take(key, make) for each output, in the order in which files get their names: the result
/// that has everything is the last. `make` may be stored as a MakeOutput*.
template <typename Take>
void for_each_output(Take take) {
    take(
        OutputKey{"csv", "write the table of organs here; - is standard output"},
        [](const auto& input) { return make_csv(input); });
    take(
        OutputKey{
            "daily_csv",
            "of a run with [time]: write the table of sums over days here; - is standard "
            "output",
            kNeedsTimes},
        [](const auto& input) { return make_daily_csv(input); });
    take(
        OutputKey{"groups_csv", "write the table of groups of organs here; - is standard output"},
        [](const auto& input) { return make_groups_csv(input); });
    take(
        OutputKey{
            "groups_daily_csv",
            "of a run with [time]: write the table of sums of groups over days here; - is standard "
            "output",
            kNeedsTimes},
        [](const auto& input) { return make_groups_daily_csv(input); });
    take(
        OutputKey{
            "detectors", "write the table of what detectors saw here; - is standard output",
            kNeedsDetectors},
        [](const auto& input) { return make_detectors(input); });
    take(
        OutputKey{
            "picture", "draw the light that organs absorb here, PNG; `quasimc show` draws more"},
        [](const auto& input) { return make_picture(input); });
    take(
        OutputKey{"vtp", "write the scene with its numbers here, for ParaView and pyvista"},
        [](const auto& input) { return make_vtp(input); });
    take(OutputKey{"ply", "the same as PLY, for MeshLab and CloudCompare"}, [](const auto& input) {
        return make_ply(input);
    });
    take(OutputKey{"glb", "the same as binary glTF, coloured, for Blender"}, [](const auto& input) {
        return make_glb(input);
    });
    take(
        OutputKey{"netcdf", "write the light by organ, band and time here, for xarray and others"},
        [](const auto& input) { return make_netcdf(input); });
    // (tools/new.py enters an output above this line)
    take(OutputKey{"json", "write everything here; - is standard output"}, [](const auto& input) {
        return make_json(input);
    });
}

/// The rows without their makers.
[[nodiscard]] std::vector<OutputKey> output_keys();

}  // namespace quasimc

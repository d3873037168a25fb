#pragma once

// The catalogue of outputs: the files that a run may write.
//
// To add an output, tools/new.py output NAME makes its writer, its test and its page, and enters it
// here: a declaration and a row. The key of [output], its check, the flag, `quasimc list outputs`
// and the order in which files get their names follow from the row.

#include <array>
#include <memory>
#include <string_view>
#include <vector>

namespace quasimc {

class OutputWriter;  // quasimc/result_file.h
struct OutputInput;  // resultio/output_input.h

/// A table that a run file must have for an output; none by default.
struct OutputNeed {
    std::string_view table = {};   ///< the key of a table: "time"
    std::string_view shown = {};   ///< the key in messages: "[time]"
    std::string_view reason = {};  ///< why it is needed
};
inline constexpr OutputNeed kNeedsTimes{"time", "[time]", "daily sums need [time]"};
inline constexpr OutputNeed kNeedsGapFraction{
    "gap_fraction", "[[gap_fraction]]", "it names the positions that look up"};
inline constexpr OutputNeed kNeedsDetectors{
    "detector", "[[detector]]", "there is nothing to be written without"};

inline constexpr OutputNeed kNeedsSensors{
    "sensors", "[[sensors]]", "there is nothing to be written without"};

/// Key and description of an output for users.
struct OutputKey {
    std::string_view name;     ///< the key of [output]; the flag is the same with hyphens
    std::string_view summary;  ///< one line for the manual
    std::array<OutputNeed, 2> needs = {};
};

/// Function that makes the writer of an output. Programs that only read run files need not link the
/// writers, which are in higher modules.
using MakeOutput = std::unique_ptr<OutputWriter>(const OutputInput& input);
MakeOutput make_csv, make_daily_csv, make_groups_csv, make_groups_daily_csv, make_sensors_csv,
    make_sensors_daily_csv, make_sensors_picture, make_detectors, make_gaps_csv, make_picture,
    make_vtp, make_ply, make_glb, make_netcdf, make_json;
/// Makes the writer of OutputInput::table.
MakeOutput make_table;
// (tools/new.py declares an output above this line)

/// Calls take(key, make) for each output, in the order in which files get their names: the complete
/// result is the last. `make` may be stored as a MakeOutput*.
template <typename Take>
void for_each_output(Take take) {
    take(
        OutputKey{"csv", "write the table of organs (- for standard output)"},
        [](const auto& input) { return make_csv(input); });
    take(
        OutputKey{"daily_csv", "with [time]: write daily sums by organ", {kNeedsTimes}},
        [](const auto& input) { return make_daily_csv(input); });
    take(OutputKey{"groups_csv", "write sums by group"}, [](const auto& input) {
        return make_groups_csv(input);
    });
    take(
        OutputKey{"groups_daily_csv", "with [time]: write daily sums by group", {kNeedsTimes}},
        [](const auto& input) { return make_groups_daily_csv(input); });
    take(
        OutputKey{"sensors_csv", "write the table of sensors", {kNeedsSensors}},
        [](const auto& input) { return make_sensors_csv(input); });
    take(
        OutputKey{
            "sensors_daily_csv",
            "with [time]: write daily sums by sensor",
            {kNeedsTimes, kNeedsSensors}},
        [](const auto& input) { return make_sensors_daily_csv(input); });
    take(
        OutputKey{"detectors", "write the table of detectors", {kNeedsDetectors}},
        [](const auto& input) { return make_detectors(input); });
    take(OutputKey{"gaps_csv", "write gap fractions", {kNeedsGapFraction}}, [](const auto& input) {
        return make_gaps_csv(input);
    });
    take(
        OutputKey{"picture", "draw absorbed light, PNG (`quasimc show` draws more)"},
        [](const auto& input) { return make_picture(input); });
    take(
        OutputKey{"sensors_picture", "draw maps of arrays of sensors, PNG", {kNeedsSensors}},
        [](const auto& input) { return make_sensors_picture(input); });
    take(OutputKey{"vtp", "write scene and results for ParaView"}, [](const auto& input) {
        return make_vtp(input);
    });
    take(OutputKey{"ply", "write scene and results for MeshLab"}, [](const auto& input) {
        return make_ply(input);
    });
    take(OutputKey{"glb", "write scene and results for Blender"}, [](const auto& input) {
        return make_glb(input);
    });
    take(OutputKey{"netcdf", "write results for xarray"}, [](const auto& input) {
        return make_netcdf(input);
    });
    // (tools/new.py enters an output above this line)
    take(OutputKey{"json", "write the complete result"}, [](const auto& input) {
        return make_json(input);
    });
}

/// The keys of all outputs.
[[nodiscard]] std::vector<OutputKey> output_keys();

}  // namespace quasimc

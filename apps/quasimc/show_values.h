#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "command_line.h"
#include "meshio/geometry_scene.h"
#include "quasimc/quasimc.h"

/// The choice of numbers to show.
struct ValueChoice {
    std::string quantity = "absorbed_flux_density", band;
    std::string time, day;  ///< beginning of its name
    std::size_t point = 0;  ///< point of a sweep, from 1; 0: the first
    bool error = false;     ///< the standard error over the mean instead of the mean
};

/// The flag that sets ValueChoice::point.
[[nodiscard]] Flag point_flag(std::size_t& point);

/// The run of a run file or of a result, and the text of that result.
struct ShownRun {
    quasimc::RunFile run;
    std::string result_text;                 ///< empty: the file is a run file
    std::vector<quasimc::InputFile> inputs;  ///< inputs of the run, and the file itself
};
/// The format of a geometry file, or null for another file.
/// @param format  its name; empty: by the name of the file
/// @throws quasimc::InputError  for a format that can only be written
[[nodiscard]] const quasimc::FormatEntry* geometry_of(
    const std::string& path, const std::string& format = "");
/// A geometry file as a run without sources.
[[nodiscard]] ShownRun read_shown_geometry(
    const std::string& path, const quasimc::FormatEntry& format);
/// All points of a run file or a result. See ShownRun
struct ShownSweep {
    quasimc::RunSweep runs;
    std::string result_text;
};
[[nodiscard]] ShownSweep read_shown_sweep(const std::string& path);
/// @param point  from 1; 0: the first
[[nodiscard]] ShownRun read_shown_run(const std::string& path, std::size_t point);
/// The inputs of a run, and the file itself.
[[nodiscard]] std::vector<quasimc::InputFile> shown_inputs(
    const quasimc::RunFile& run, const std::string& path);

/// Numbers of each organ, with texts for headings.
struct ShownValues {
    std::vector<quasimc::Estimate> estimates;  ///< in the order of the scene
    std::string name, unit;                    ///< "absorbed flux density, PAR", "W m-2"
    std::string key;                           ///< "absorbed_flux_density_PAR"
    std::string when;                          ///< time, day or period; empty without [time]
    std::string minus = {};  ///< file of the run whose values were subtracted, or empty
};
/// ShownValues of a quantity and a band, without the estimates.
[[nodiscard]] ShownValues named_values(
    const quasimc::RunFile& run,
    const quasimc::QuantityEntry& entry,
    const quasimc::Band& band,
    bool is_sum);
/// @throws quasimc::InputError  if the result has none of this kind
[[nodiscard]] ShownValues read_shown_values(
    const ShownRun& shown, const std::string& path, const ValueChoice& choice);

/// The numbers of every time step with light, in their order.
/// @throws quasimc::InputError  if there are none
[[nodiscard]] std::vector<ShownValues> read_shown_times(
    const ShownRun& shown, const std::string& path, const ValueChoice& choice);

/// Subtracts the values of the same organs, by id, of another run. Errors are those of independent
/// results.
/// @param title  of the other run
/// @throws quasimc::InputError  if their units differ
void subtract(
    const quasimc::Scene& scene,
    const ShownRun& other,
    const std::string& title,
    const ShownValues& of_other,
    ShownValues& values);

/// All numbers of each organ at the chosen time, day or point: every quantity in every band, the
/// sunlit fraction, ratios. The chosen quantity and band are ignored.
/// @throws quasimc::InputError  if there are none
[[nodiscard]] std::vector<ShownValues> read_all_shown_values(
    const ShownRun& shown, const std::string& path, const ValueChoice& choice);

#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "netcdf/netcdf_file.h"
#include "runfile/written.h"

namespace quasimc {

/// Bands that have one unit: the variables of a quantity have them as a dimension, or there is one
/// for each variable.
struct NetcdfBands {
    std::vector<std::size_t> bands;  ///< of the scene
    std::string suffix;              ///< of the names of variables; "" with a dimension
};
/// One list of all bands if they have one unit, else a list for each.
[[nodiscard]] std::vector<NetcdfBands> netcdf_bands(
    const RunFile& run, const WrittenColumns& columns);

/// Seconds since 1970 began, UTC; rounded to the millisecond that a Julian day tells.
/// @param time  as TimeStepNotes has it
[[nodiscard]] double netcdf_seconds(const std::string& time);

/// The time steps that are in the file: those with light, or all with `night`, within the hours.
/// @param may_be_dark  whether light may shine at other points of the sweep: all have rows
[[nodiscard]] std::vector<std::size_t> netcdf_rows(const RunFile& run, bool may_be_dark);

/// What a file says of itself: where its numbers come from.
/// @param program_version  that computed them
[[nodiscard]] NetcdfAttributes netcdf_attributes(
    const RunFile& run, std::string_view program_version);

}  // namespace quasimc

#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "netcdf/netcdf_file.h"
#include "runfile/written.h"

namespace quasimc {

/// Bands with one unit, which are a dimension of the variables, or a single band with its own
/// variables.
struct NetcdfBands {
    std::vector<std::size_t> bands;  ///< indices in the scene
    std::string suffix;              ///< suffix of variable names; "" with a dimension
};
/// Returns one list of all bands if they have one unit, else a list for each band.
[[nodiscard]] std::vector<NetcdfBands> netcdf_bands(
    const RunFile& run, const WrittenColumns& columns);

/// Seconds since 1970-01-01 UTC, rounded to a millisecond, the resolution of a Julian day.
/// @param time  text of a TimeStepNotes
[[nodiscard]] double netcdf_seconds(const std::string& time);

/// The time steps in the file: those with light, or all with `include_night`, within `time_of_day`.
/// @param may_be_dark  whether other points of the sweep may have light: then all time steps have
/// rows
[[nodiscard]] std::vector<std::size_t> netcdf_rows(const RunFile& run, bool may_be_dark);

/// Attributes of the file that describe the origin of its numbers.
/// @param program_version  version that computed them
[[nodiscard]] NetcdfAttributes netcdf_attributes(
    const RunFile& run, std::string_view program_version);

}  // namespace quasimc

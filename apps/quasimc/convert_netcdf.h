#pragma once

#include <string>

#include "show_values.h"

/// Writes a JSON result, all points of its sweep, as NetCDF.
/// @param choice  none of time, day and point may be chosen: all of them are in the file
/// @throws quasimc::InputError  if it is no result, or can't be written
void convert_to_netcdf(
    const std::string& input, const std::string& output, const ValueChoice& choice);

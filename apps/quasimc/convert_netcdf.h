#pragma once

#include <string>

#include "show_values.h"

/// Writes a JSON result, all points of its sweep, as NetCDF.
/// @param choice  must not choose time, day or point: all of them are written
/// @throws quasimc::InputError  if it is no result, or can't be written
void convert_to_netcdf(
    const std::string& input, const std::string& output, const ValueChoice& choice);

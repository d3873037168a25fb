#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "quasimc/lamp_control.h"
#include "runfile/run_file.h"
#include "text/document.h"

namespace quasimc {

/// Reads the lamps under control of a series from a JSON result.
/// @param rest   the result without its rows (RowsQuery::Rest::all)
/// @param point  of a sweep; else 0
/// @param path   for messages
/// @returns  for each control, sums in the units of sums (in_summed_units); none if the result has
/// none
/// @throws InputError  if it has other controls, time steps or days than the run
[[nodiscard]] std::vector<ControlOutcome> read_controls(
    const Node& rest, std::size_t point, const RunFile& run, const std::string& path);

}  // namespace quasimc

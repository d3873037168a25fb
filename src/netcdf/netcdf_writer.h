#pragma once

#include <memory>
#include <string_view>

#include "quasimc/error.h"
#include "quasimc/result_file.h"
#include "quasimc/run_file.h"
#include "quasimc/version.h"

namespace quasimc {

/// Whether the program was built with the netCDF library.
[[nodiscard]] bool has_netcdf();

/// Makes the writer of the light on organs, on sensors and in detectors, and of lamps under control
/// as netCDF-4 with the CF conventions (docs/reference/netcdf.md): by organ and band, with [time]
/// also by time and (sums) by day, in sweeps also by point. Its next_run() throws InputError if the
/// points of a sweep have different times, organs or controls.
/// @param program_version  version that computed the light
/// @throws InputError  if the program was built without netCDF, or a temporary file can't be made
[[nodiscard]] std::unique_ptr<OutputWriter> make_netcdf_writer(
    const RunFile& run, TextSink sink, std::string_view program_version = version());
std::unique_ptr<OutputWriter> make_netcdf_writer(const RunFile&&, TextSink, std::string_view = {}) =
    delete;

}  // namespace quasimc

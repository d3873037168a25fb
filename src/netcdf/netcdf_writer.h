#pragma once

#include <cstddef>
#include <memory>
#include <string_view>
#include <vector>

#include "quasimc/error.h"
#include "quasimc/lamp_control.h"
#include "quasimc/result_file.h"
#include "quasimc/run_file.h"
#include "quasimc/version.h"

namespace quasimc {

/// Whether the program was built with the netCDF library.
[[nodiscard]] bool has_netcdf();

/// Writes the light on organs, on sensors and in detectors, and lamps under control as netCDF-4
/// with the CF conventions (docs/reference/netcdf.md): by organ and band, with [time] also by time
/// and (sums) by day, in sweeps also by point.
class NetcdfWriter : public OutputWriter {
  public:
    /// Adds a day, like on_day(). @param sum  in the units of sums (in_summed_units)
    virtual void add_day(std::size_t day, const SeriesSum& sum) = 0;
    /// Adds the lamps under control of the current run, which a run that was read does not have.
    /// @param outcomes  in the units of sums (in_summed_units)
    virtual void add_controls(const std::vector<ControlOutcome>& outcomes) = 0;
};

/// Makes the writer. Its next_run() throws InputError if the points of a sweep have different
/// times, organs or controls. @param program_version  version that computed the light
/// @throws InputError  if the program was built without netCDF, or a temporary file can't be made
[[nodiscard]] std::unique_ptr<NetcdfWriter> make_netcdf_writer(
    const RunFile& run, TextSink sink, std::string_view program_version = version());
std::unique_ptr<NetcdfWriter> make_netcdf_writer(const RunFile&&, TextSink, std::string_view = {}) =
    delete;

}  // namespace quasimc

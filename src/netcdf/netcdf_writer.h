#pragma once

#include <cstddef>
#include <memory>
#include <string_view>

#include "quasimc/file.h"
#include "quasimc/result_file.h"
#include "quasimc/run_file.h"
#include "quasimc/version.h"

namespace quasimc {

/// Whether the program was built with the netCDF library.
[[nodiscard]] bool has_netcdf();

/// The light on organs as netCDF-4 after the CF conventions (docs/formats/netcdf.md): by organ and
/// band, of a run with [time] by time and, summed, by day, of a sweep by point. The run must
/// outlive it, or the call of next_run().
class NetcdfWriter {
  public:
    /// @param program_version  that computed the light
    /// @throws InputError  if the program was built without netCDF, or a temporary file can't be
    /// made
    NetcdfWriter(const RunFile& run, TextSink sink, std::string_view program_version = version());
    ~NetcdfWriter();
    NetcdfWriter(const NetcdfWriter&) = delete;
    NetcdfWriter& operator=(const NetcdfWriter&) = delete;
    NetcdfWriter(NetcdfWriter&&) = delete;
    NetcdfWriter& operator=(NetcdfWriter&&) = delete;

    void add_moment(std::size_t time_step, const Result& result);
    /// Of a run with [time]. @param sum  in the units of sums (in_summed_units)
    void add_day(std::size_t day, const SeriesSum& sum);
    /// What follows is of this run, of the same sweep.
    /// @throws InputError  if its times or organs are not those of the first point
    void next_run(const RunFile& run);
    /// Gives the file to the sink.
    void finish();

  private:
    class State;
    std::unique_ptr<State> state_;
};

}  // namespace quasimc

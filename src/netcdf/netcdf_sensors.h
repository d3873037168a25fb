#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "netcdf/light_variables.h"
#include "netcdf/netcdf_axes.h"
#include "netcdf/netcdf_file.h"

namespace quasimc {

/// The light on sensors: for each set variables that begin with its name, along the axes of its
/// shape.
class NetcdfSensors {
  public:
    /// Defines the variables and writes names and positions. @param axes  must outlive this
    NetcdfSensors(const RunFile& run, NetcdfAxes& axes, NetcdfFile& file);

    /// Writes the light of a time step. @param start  indices along the axes of the sweep, and time
    void put(const std::vector<std::size_t>& start, const Result& result);
    /// Writes the sum of a day, which is in the units of sums (in_summed_units).
    void put_day(const std::vector<std::size_t>& start, const SeriesSum& sum);

  private:
    std::vector<LightVariables> sets_;
};

}  // namespace quasimc

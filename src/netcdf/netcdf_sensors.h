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
    /// @param axes, file  must outlive this
    NetcdfSensors(NetcdfAxes& axes, NetcdfFile& file) : axes_(axes), file_(file) {}

    /// Writes the light of a time step. @param start  indices along the axes of the sweep, and time
    void put(const RunFile& run, const std::vector<std::size_t>& start, const Result& result);
    /// Writes the sum of a day, which is in the units of sums (in_summed_units).
    void put_day(const RunFile& run, const std::vector<std::size_t>& start, const SeriesSum& sum);

  private:
    /// A set, with the variables of its transmittance once it has some.
    struct Set {
        LightVariables light;
        std::vector<NetcdfEstimates> transmittance = {}, of_days = {};
    };

    /// Defines the variables and writes names and positions, with the first light: a run that was
    /// stopped has none.
    void define(const RunFile& run);
    template <typename Light>
    void put_transmittance(
        const RunFile& run, const std::vector<std::size_t>& start, const Light& light);

    NetcdfAxes& axes_;
    NetcdfFile& file_;
    std::vector<Set> sets_;
};

}  // namespace quasimc

#pragma once

#include <cstddef>
#include <vector>

#include "netcdf/netcdf_axes.h"
#include "quasimc/result.h"

namespace quasimc {

/// The flux in detectors: for each a variable of its name along its bins.
class NetcdfDetectors {
  public:
    /// Defines the variables. @param axes  must outlive this
    NetcdfDetectors(const RunFile& run, NetcdfAxes& axes);

    /// Writes the flux of a time step. @param start  indices along the axes of the sweep, and time
    void put(const std::vector<std::size_t>& start, const Result& result);

  private:
    NetcdfAxes& axes_;
    std::vector<std::vector<NetcdfEstimates>> variables_;  // [detector][list of bands]
};

}  // namespace quasimc

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "netcdf/netcdf_axes.h"
#include "netcdf/netcdf_file.h"
#include "quasimc/gap_fraction.h"

namespace quasimc {

/// Gap fractions: for each [[gap_fraction]] variables that begin with its name, along axes of its
/// positions, rings and sectors. They follow from the scene alone.
class NetcdfGaps {
  public:
    /// Defines the variables and writes positions and bounds. @param axes  must outlive this
    NetcdfGaps(const RunFile& run, NetcdfAxes& axes, NetcdfFile& file);

    /// Measures the gaps of a run and writes them.
    void put(const RunFile& run);

  private:
    /// Indices of a position, or of all positions together.
    struct Indices {
        NetcdfEstimates gap, clumping;  // by ring
        NetcdfEstimates sky_transmittance, effective_plant_area_index, plant_area_index,
            clumping_index, lai_2000;
    };
    struct Variables {
        NetcdfEstimates gap;
        Indices by_position, all;
    };

    Indices define_indices(
        const GapFractionSpec& spec,
        const std::string& suffix,
        const std::string& coordinates,
        const std::vector<NetcdfAxes::Axis>& positions,
        const NetcdfAxes::Axis& rings);
    void put_indices(
        const Indices& to,
        const std::vector<std::size_t>& start,
        const std::vector<GapIndices>& from,
        const std::vector<std::size_t>& sizes);

    NetcdfAxes& axes_;
    std::vector<Variables> variables_;
    std::vector<GapFractions> found_;  // of the last run
};

}  // namespace quasimc

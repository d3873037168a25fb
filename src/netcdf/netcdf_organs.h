#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "netcdf/light_variables.h"
#include "netcdf/netcdf_axes.h"
#include "netcdf/netcdf_file.h"
#include "runfile/written.h"

namespace quasimc {

/// A quantity of sunlit and shaded parts, in bands of one unit.
struct NetcdfPart {
    SunShadeEntry entry;
    std::vector<std::size_t> bands;  ///< indices in the scene; one without an axis
    bool has_axis = false;
    NetcdfEstimates light = {};
    std::optional<NetcdfEstimates> days = {};
};

/// The light on organs, and their names, areas and labels.
class NetcdfOrgans {
  public:
    /// Defines the variables and writes all but the light. @param run, axes, file  must outlive
    /// this
    NetcdfOrgans(const RunFile& run, NetcdfAxes& axes, NetcdfFile& file);

    /// Writes the areas of the organs of a run, if they may differ between points.
    void put_areas(const RunFile& run);
    /// Writes the light of a time step. @param start  indices along the axes of the sweep, and time
    void put(const std::vector<std::size_t>& start, const Result& result);
    /// Writes the sum of a day, which is in the units of sums (in_summed_units).
    void put_day(const std::vector<std::size_t>& start, const SeriesSum& sum);

  private:
    using Axis = NetcdfAxes::Axis;

    void define_organs();
    void define_areas();
    void define_labels();
    void define_parts();
    void define_part(NetcdfPart part, const std::string& suffix);
    void put_part(
        const NetcdfPart& part,
        const NetcdfEstimates& to,
        const std::vector<std::size_t>& start,
        const SunShadeLight& parts);
    [[nodiscard]] Axis organ_axis() const { return {organ_, count_}; }

    const RunFile& run_;
    NetcdfAxes& axes_;
    NetcdfFile& file_;
    std::size_t count_;                            // of organs
    std::string coordinates_ = "organ_name area";  // auxiliary ones
    int organ_ = 0, area_ = 0;
    std::optional<LightVariables> light_;
    std::vector<NetcdfPart> parts_;
};

}  // namespace quasimc

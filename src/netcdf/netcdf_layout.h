#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "netcdf/netcdf_file.h"
#include "netcdf/netcdf_parts.h"
#include "netcdf/netcdf_sweep.h"
#include "runfile/written.h"

namespace quasimc {

/// An estimate with its error: four variables of one shape.
struct NetcdfEstimates {
    std::array<int, 4> variables{};  ///< mean, standard error, ends of the interval
};

/// A quantity of sunlit and shaded parts, in bands of one unit.
struct NetcdfPart {
    SunShadeEntry entry;
    std::vector<std::size_t> bands;  ///< indices in the scene; one without an axis
    bool has_axis = false;
    NetcdfEstimates light = {};
    std::optional<NetcdfEstimates> days = {};
};

/// Names and dimensions of the variables of a file, and positions of a run's numbers in them.
class NetcdfLayout {
  public:
    /// Defines all variables and writes everything but the light.
    /// @param program_version  version that computed the light
    NetcdfLayout(const RunFile& run, std::string_view program_version, NetcdfFile& file);

    const WrittenColumns columns;
    const std::vector<NetcdfBands> bands;
    std::vector<NetcdfEstimates> light;  ///< [bands * quantities + quantity]
    std::vector<NetcdfEstimates> days;   ///< daily sums, same order; empty without [time]
    /// The same with an axis of origins; empty if light is not kept apart.
    std::vector<NetcdfEstimates> light_by_origin, days_by_origin;
    std::vector<NetcdfPart> parts;
    std::optional<NetcdfEstimates> sunlit, sunlit_hours, ratios;
    std::vector<std::vector<NetcdfEstimates>> detectors;  ///< [detector][list of bands]

    /// Writes the areas of the organs of a run, if they may differ between points.
    void put_areas(const RunFile& run);
    /// Position of a run along the axes of the sweep.
    [[nodiscard]] std::vector<std::size_t> indices_of(const RunFile& run) const {
        return sweep_.indices_of(run.point);
    }
    /// Row of a time step; empty if it is not in the file.
    [[nodiscard]] std::optional<std::size_t> row_of(std::size_t time_step) const;

  private:
    void define_axes();
    void define_organs();
    void define_areas();
    void define_labels();
    void define_times();
    void define_days();
    void define_points();
    void define_light();
    void define_parts();
    void define_part(NetcdfPart part, const std::string& suffix);
    void define_detectors();
    using Axis = std::pair<std::optional<int>, std::size_t>;  // dimension, if present, and size
    [[nodiscard]] Axis time_axis() const { return {time_, std::max<std::size_t>(rows_.size(), 1)}; }
    [[nodiscard]] Axis day_axis() const {
        return {day_, run_.series ? std::max<std::size_t>(run_.series->days.size(), 1) : 1};
    }
    [[nodiscard]] Axis organ_axis() const { return {organ_, run_.scene.organs().size()}; }
    [[nodiscard]] Axis band_axis() const { return {band_, columns.bands.size()}; }
    /// Defines an estimate along the axes of the sweep and those.
    NetcdfEstimates define_estimates(
        const std::string& name,
        const std::string& unit,
        const std::string& summary,
        const std::vector<Axis>& axes,
        const std::string& coordinates);
    /// A valid and unused name of a variable.
    std::string free_name(std::string_view wish);

    const RunFile& run_;
    NetcdfFile& file_;
    const NetcdfSweep sweep_;
    std::set<std::string> names_;
    // Auxiliary coordinates of all variables, and of the light on organs.
    std::string coordinates_, organ_coordinates_ = "organ_name area";
    std::vector<std::size_t> rows_;        // time steps in the file
    std::vector<int> points_;              // dimensions of the sweep
    std::vector<std::string> axis_names_;  // names of `points_`
    std::optional<int> time_, day_, band_, ratio_, origin_;
    int organ_ = 0, area_ = 0;
};

}  // namespace quasimc

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "netcdf/netcdf_axes.h"
#include "quasimc/result.h"
#include "quasimc/series.h"

namespace quasimc {

/// Rows of a result that have variables of their own: all organs, or a set of sensors.
struct NetcdfRows {
    std::string prefix;                       ///< begins the names of its variables
    std::vector<NetcdfAxes::Axis> axes = {};  ///< none for a single row
    std::string coordinates = {};             ///< names of auxiliary coordinates
    std::size_t first = 0, count = 0;         ///< indices in the result
    std::vector<QuantityEntry> quantities;    ///< with their names in the file
};

/// The light on rows of a result: a variable of each quantity along bands of one unit.
class LightVariables {
  public:
    /// Defines the variables. @param axes  must outlive this
    LightVariables(const RunFile& run, NetcdfAxes& axes, NetcdfRows rows);

    /// Writes the light of a time step. @param start  indices along the axes of the sweep, and time
    void put(const std::vector<std::size_t>& start, const Result& result);
    /// Writes the sum of a day, which is in the units of sums (in_summed_units).
    void put_day(const std::vector<std::size_t>& start, const SeriesSum& sum);

    /// Defines fractions of the rows by band, without origins, of time steps or of days.
    /// @returns one for each list of bands
    [[nodiscard]] std::vector<NetcdfEstimates> add_fractions(
        const std::string& name, const std::string& summary, CsvTimes times);
    /// Writes `estimate(row of the result, band of the scene)`.
    /// @param variables  those of add_fractions()
    template <typename GetEstimate>
    void put_fractions(
        const std::vector<NetcdfEstimates>& variables,
        const std::vector<std::size_t>& start,
        const GetEstimate& estimate) {
        for (std::size_t number = 0; number < variables.size(); ++number) {
            const NetcdfBands& list = axes_.bands[number];
            axes_.put(variables[number], start, sizes_in(list), [&](std::size_t i) {
                return estimate(rows_.first + i % rows_.count, list.bands[i / rows_.count]);
            });
        }
    }
    [[nodiscard]] std::size_t first_row() const { return rows_.first; }

    /// Sizes of a block of rows, in some of the bands.
    /// @param bands  their number; 0: without an axis of bands
    [[nodiscard]] std::vector<std::size_t> sizes(std::size_t bands = 0) const;

  private:
    using Axis = NetcdfAxes::Axis;

    [[nodiscard]] std::vector<std::size_t> sizes_in(const NetcdfBands& list) const {
        return sizes(list.suffix.empty() ? list.bands.size() : 0);
    }
    void define(const RunFile& run);
    void define_traits(bool has_days);
    NetcdfEstimates add(
        const std::string& name,
        const std::string& unit,
        const std::string& summary,
        std::vector<Axis> axes);
    template <typename Light>
    void put_light(
        const std::vector<NetcdfEstimates>& variables,
        const std::vector<std::size_t>& start,
        const Light& light);
    template <typename Light>
    void put_origins(
        const std::vector<NetcdfEstimates>& variables,
        const std::vector<std::size_t>& start,
        const Light& light);

    NetcdfAxes& axes_;
    NetcdfRows rows_;
    std::vector<NetcdfEstimates> light_;  // [list of bands * quantities + quantity]
    std::vector<NetcdfEstimates> days_;   // daily sums, same order; empty without [time]
    // The same with an axis of origins; empty if light is not kept apart.
    std::vector<NetcdfEstimates> light_by_origin_, days_by_origin_;
    std::optional<NetcdfEstimates> sunlit_, sunlit_hours_, ratios_;
};

}  // namespace quasimc

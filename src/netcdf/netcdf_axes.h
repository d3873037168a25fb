#pragma once

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
#include "quasimc/mesh.h"
#include "quasimc/sums.h"
#include "runfile/written.h"

namespace quasimc {

/// An estimate with its error: four variables of one shape.
struct NetcdfEstimates {
    std::array<int, 4> variables{};  ///< mean, standard error, ends of the interval
};

/// The text of variables.
struct NetcdfQuantity {
    std::string name;  ///< wish
    std::string unit, summary;
    std::string coordinates = {};  ///< names of auxiliary coordinates, beside those of the sweep
};

/// The dimensions that variables share, with their coordinates, and variables along them.
class NetcdfAxes {
  public:
    /// Defines the dimensions and writes their coordinates.
    NetcdfAxes(const RunFile& run, NetcdfFile& file);

    using Axis = std::pair<std::optional<int>, std::size_t>;  ///< dimension, if present, and size

    const WrittenColumns columns;
    const std::vector<NetcdfBands> bands;
    const NetcdfSweep sweep;

    [[nodiscard]] const Axis& time() const { return time_; }
    [[nodiscard]] const Axis& day() const { return day_; }
    [[nodiscard]] const Axis& band() const { return band_; }
    [[nodiscard]] const Axis& ratio() const { return ratio_; }
    [[nodiscard]] const Axis& origin() const { return origin_; }
    /// The dimensions of the sweep; none for other runs.
    [[nodiscard]] std::vector<Axis> points() const;
    /// The dimension of two bounds of a coordinate, defined at the first call.
    [[nodiscard]] int bounds();

    /// Row of a time step; empty if it is not in the file.
    [[nodiscard]] std::optional<std::size_t> row_of(std::size_t time_step) const;
    /// Position of a run along the axes of the sweep.
    [[nodiscard]] std::vector<std::size_t> indices_of(const RunFile& run) const {
        return sweep.indices_of(run.point);
    }

    /// A name whose characters netCDF allows: `_` replaces others.
    [[nodiscard]] static std::string valid_name(std::string_view wish);
    /// A valid and unused name of a variable.
    std::string free_name(std::string_view wish);
    /// Defines an estimate along the axes of the sweep and those.
    NetcdfEstimates add_estimates(const NetcdfQuantity& quantity, const std::vector<Axis>& axes);
    /// Defines a variable of reals along the axes of the sweep and those.
    int add_reals(const NetcdfQuantity& quantity, const std::vector<Axis>& axes);

    /// Writes a block of an estimate: `estimate(i)` for each of its numbers.
    /// @param sizes  of the axes behind `start`
    template <typename GetEstimate>
    void put(
        const NetcdfEstimates& to,
        const std::vector<std::size_t>& start,
        const std::vector<std::size_t>& sizes,
        const GetEstimate& estimate) {
        const NetcdfBlock block = block_of(start, sizes);
        constexpr std::array kParts{
            &Estimate::mean, &Estimate::standard_error, &Estimate::ci95_low, &Estimate::ci95_high};
        std::vector<double> numbers(size_of(sizes));
        for (std::size_t part = 0; part < kParts.size(); ++part) {
            for (std::size_t i = 0; i < numbers.size(); ++i) {
                numbers[i] = reported(estimate(i)).*kParts[part];
            }
            file_.put(to.variables[part], block, numbers);
        }
    }
    /// Writes a block of reals.
    void put(
        int variable,
        const std::vector<std::size_t>& start,
        const std::vector<std::size_t>& sizes,
        const std::vector<double>& numbers) {
        file_.put(variable, block_of(start, sizes), numbers);
    }

    /// Defines a dimension with names as its coordinate. @param wish  for its name
    [[nodiscard]] Axis add_names(
        const std::string& wish, const std::string& summary, const std::vector<std::string>& all);
    /// Writes the coordinates x, y, z of positions, which are in the axes of the run file.
    /// @param prefix  of their names
    /// @param what    has the positions: "the sensor"
    /// @returns  their names, with a space between them
    std::string add_positions(
        const std::string& prefix,
        const std::string& what,
        const std::vector<int>& dimensions,
        const std::vector<Vec3>& positions);
    /// Writes a variable of texts, along dimensions or none.
    void add_texts(
        const std::string& name,
        const std::string& summary,
        const std::vector<int>& dimensions,
        const std::vector<std::string>& values);

  private:
    void define_points();
    void define_bands();
    void define_times();
    [[nodiscard]] std::vector<int> dimensions_of(const std::vector<Axis>& axes) const;
    [[nodiscard]] std::vector<std::size_t> chunk_of(const std::vector<Axis>& axes) const;
    int add_variable(
        const std::string& name,
        const NetcdfQuantity& quantity,
        const std::vector<Axis>& axes,
        const std::string& ancillary);
    [[nodiscard]] static NetcdfBlock block_of(
        const std::vector<std::size_t>& start, const std::vector<std::size_t>& sizes);
    [[nodiscard]] static std::size_t size_of(const std::vector<std::size_t>& sizes);

    const RunFile& run_;
    NetcdfFile& file_;
    std::set<std::string> names_;
    std::string coordinates_;              // keys of the sweep that have no axis of their own
    std::vector<std::size_t> rows_;        // time steps in the file
    std::vector<Axis> points_;             // of the sweep
    std::vector<std::string> axis_names_;  // names of `points_`
    Axis time_{{}, 1}, day_{{}, 1}, band_{{}, 1}, ratio_{{}, 1}, origin_{{}, 1};
    std::optional<int> bounds_;
};

}  // namespace quasimc

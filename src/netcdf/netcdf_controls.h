#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "netcdf/netcdf_axes.h"
#include "quasimc/lamp_control.h"

namespace quasimc {

/// Lamps under control, along an axis of controls.
class NetcdfControls {
  public:
    /// Defines the variables, if the run has controls, and writes their coordinates.
    /// @param axes  must outlive this
    NetcdfControls(const RunFile& run, NetcdfAxes& axes);

    /// Writes the times and days of a run.
    /// @param outcomes  with the sums of days in the units of sums (in_summed_units)
    void put(const RunFile& run, const std::vector<ControlOutcome>& outcomes);

    /// Whether the controls of another point of the sweep have the same lamps, sensors and bands.
    [[nodiscard]] bool fits(const RunFile& run) const;

  private:
    /// The light at the sensors of controls whose bands have one unit, or are one band.
    struct Light {
        std::vector<bool> has;  // by control
        NetcdfEstimates daylight, lamps, light, lamps_of_day, light_of_day;
    };
    /// Numbers of a control, and their variable.
    using StepNumber = std::pair<int, double (*)(const ControlStep&)>;
    using DayNumber = std::pair<int, double ControlDay::*>;

    void define_numbers();
    void define_light(const RunFile& run);
    void add_light(const std::string& suffix, const std::string& unit, std::vector<bool> has);
    template <typename Part>
    void put_light(
        const NetcdfEstimates& to,
        const std::vector<std::size_t>& start,
        const std::vector<bool>& has,
        const std::vector<const Part*>& parts,
        Estimate Part::*member);
    void put_step(
        const std::vector<std::size_t>& start, const std::vector<const ControlStep*>& steps);
    void put_day(const std::vector<std::size_t>& start, const std::vector<const ControlDay*>& days);

    NetcdfAxes& axes_;
    std::vector<LampControl> controls_;
    NetcdfAxes::Axis axis_;
    std::string coordinates_;
    std::vector<StepNumber> step_numbers_;
    std::vector<DayNumber> day_numbers_;
    std::vector<Light> light_;
};

}  // namespace quasimc

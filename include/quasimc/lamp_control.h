#pragma once

// Lamps that are switched and dimmed by the light at sensors.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "quasimc/run.h"

namespace quasimc {

struct TimeStep;  // quasimc/series.h

/// Rules for some of the lamps of a series. All of them hold, each from the means of a time.
struct LampControl {
    std::string sources = {};  ///< a pattern of names of lamps, in which `*` means any characters
    std::string sensors = {};  ///< the name of a set; the mean of their upper sides counts
    std::size_t band = 0;
    std::optional<double> on_below = {};  ///< lamps are off above this daylight, irradiance unit
    /// Lamps are off until midnight once all light of the day is that, irradiance unit x s.
    std::optional<double> daily_target = {};
    /// Lamps are dimmed so that all light is that, irradiance unit.
    std::optional<double> set_point = {};
    double dim_min = 0.1;           ///< the smallest factor that they can be dimmed to, 0 to 1
    double electrical_power_w = 0;  ///< per lamp; proportional to its light
};

/// Lamps at a time, and the light at the sensors of their control.
struct ControlStep {
    double factor = 0;  ///< by which the lamps are dimmed, mean over the time: 0 to 1
    double on = 0;      ///< part of the time in which they are on, dimmed or not
    double kwh = 0;
    Estimate daylight = {};  ///< irradiance unit
    Estimate lamps = {};     ///< light of the lamps of the control, with the factor
    Estimate light = {};     ///< all light
    /// Whether daylight is within two standard errors of LampControl::on_below.
    bool is_near_threshold = false;
};

/// A day of lamps under control.
struct ControlDay {
    double hours_on = 0, kwh = 0, hours_near_threshold = 0;
    Estimate lamps = {}, light = {};  ///< irradiance unit x s
};

/// The lamps of a control in a series.
struct ControlOutcome {
    std::size_t lamps = 0;                ///< their number
    std::vector<ControlStep> steps = {};  ///< per time step
    std::vector<ControlDay> days = {};    ///< by TimeStep::day
    bool has_file_units = false;          ///< whether the sums of days have the units of files
};

/// The input of control_lamps().
struct ControlInput {
    const Scene& scene;  ///< with the sensors
    /// Sources at their full light. The first sources of each time step are these, in their order,
    /// dimmed by their hours.
    const Sources& sources;
    const RunSpec& spec;  ///< its paths are those for the sensors of a time
    const std::vector<LampControl>& controls;
};

/// Dims the lamps of time steps as their controls say, and reports it.
///
/// The light at the sensors is computed beforehand, of daylight and of the lamps of each control
/// separately, by paths from the sensors. An instant's light is linear in the flux of each lamp, so
/// the factors follow by arithmetic. A control takes account of daylight, lamps without a control,
/// and lamps of the controls before it.
/// @param simulator  keeps the acceleration structure
/// @throws InputError  as run() does
[[nodiscard]] std::vector<ControlOutcome> control_lamps(
    const ControlInput& input, Simulator& simulator, std::vector<TimeStep>& time_steps);

/// Whether a control is that of a source.
[[nodiscard]] bool controls(const LampControl& control, const Source& source);

}  // namespace quasimc

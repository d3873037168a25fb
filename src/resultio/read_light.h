#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/lamp_control.h"
#include "quasimc/result.h"
#include "quasimc/series.h"
#include "runfile/run_file.h"

namespace quasimc {

/// Callbacks for the light in a result. Points of a sweep count from 0.
struct LightEvents {
    /// Called before the light of a point of a sweep. May throw to refuse it.
    std::function<void(std::size_t point)> on_point = [](std::size_t) {};
    /// Called before the light of a series with lamps under control.
    /// @param outcomes  sums in the units of sums (in_summed_units)
    std::function<void(const std::vector<ControlOutcome>& outcomes)> on_controls =
        [](const std::vector<ControlOutcome>&) {};
    /// Called for each time step. Only the written quantities and bands of organs, sensors and
    /// detectors are set; everything else, and unknown values, are NaN.
    std::function<void(std::size_t time_step, const Result& result)> on_time_step;
    /// Called for each day. @param sum  in the units of sums (in_summed_units)
    std::function<void(std::size_t day, const SeriesSum& sum)> on_day;
};

/// Reads the light of organs, sensors and detectors from a JSON result, in the order in which the
/// run wrote it.
/// @param path  for messages
/// @param run   run of the result; in a sweep its first point
/// @throws InputError  if it is not JSON, holds no light of organs or sensors, or has times that
/// the run lacks
void read_light(
    std::string_view text, const std::string& path, const RunFile& run, const LightEvents& events);

}  // namespace quasimc

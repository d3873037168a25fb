#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "quasimc/result.h"
#include "quasimc/series.h"
#include "runfile/run_file.h"

namespace quasimc {

/// Who is told of the light that a result holds. Points of a sweep count from 0.
struct LightEvents {
    /// Before what a point of a sweep has. May refuse it.
    std::function<void(std::size_t point)> on_point = [](std::size_t) {};
    /// Of each time that the result has. Only the light of organs and detectors is filled in, of
    /// those quantities and bands that were written; NaN the rest, and what the result does not
    /// know.
    std::function<void(std::size_t time_step, const Result& result)> on_time_step;
    /// Of each day. @param sum  in the units of sums (in_summed_units)
    std::function<void(std::size_t day, const SeriesSum& sum)> on_day;
};

/// Tells of the light of organs in a JSON result, in the order in which the run told it.
/// @param path  for messages
/// @param run   that the result is of; of a sweep the first
/// @throws InputError  if it is not JSON, holds no light of organs, or has times that the run has
/// not
void read_light(
    std::string_view text, const std::string& path, const RunFile& run, const LightEvents& events);

}  // namespace quasimc

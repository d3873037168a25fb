#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "io/runfile/run_file.h"
#include "quasimc/result.h"
#include "quasimc/series.h"

namespace quasimc {

/// Who is told of the light that a result holds.
struct LightEvents {
    /// Of each time that the result has. Only the light of organs is filled in, of those quantities
    /// and bands that were written; NaN the rest, and what the result does not know.
    std::function<void(std::size_t time_step, const Result& result)> on_time_step;
    /// Of each day. @param sum  in the units of sums (in_summed_units)
    std::function<void(std::size_t day, const SeriesSum& sum)> on_day;
};

/// The objects of the points of a sweep in the text of its JSON result; each is like the result of
/// a run of its own.
/// @param path  for messages
/// @throws InputError  if it is not JSON
[[nodiscard]] std::vector<std::string_view> point_texts(
    std::string_view text, const std::string& path);

/// Tells of the light of organs in a JSON result, in the order of times, as the run did.
/// @param text  of the result, or of a point of its sweep (point_texts)
/// @param path  for messages
/// @param run   that the result is of
/// @throws InputError  if it is not JSON, or holds no light of organs
void read_light(
    std::string_view text, const std::string& path, const RunFile& run, const LightEvents& events);

}  // namespace quasimc

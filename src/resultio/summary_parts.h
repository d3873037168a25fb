#pragma once

// Texts on energy and errors in summaries. Included by the summary only.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "quasimc/result.h"
#include "runfile/run_file.h"

namespace quasimc {

/// Statistics of the errors of absorbed light.
struct ErrorStatistics {
    std::size_t organs = 0;       ///< measured organs, without the ground
    std::size_t unknown = 0;      ///< organs of which some band has no standard error
    std::size_t badly_known = 0;  ///< other organs with a relative standard error above kBadlyKnown
    double median = 0;            ///< relative standard error of organs and bands that have one
    double worst = 0;
    std::int64_t worst_id = 0;

    [[nodiscard]] bool has_median() const { return unknown < organs || median > 0; }
};
inline constexpr double kBadlyKnown = 0.5;

[[nodiscard]] ErrorStatistics error_statistics(const Scene& scene, const Result& result);
/// The errors in words, and how to get them down if they are large.
[[nodiscard]] std::string describe_errors(const ErrorStatistics& errors);
/// A part of 1 as percent, in words: "0.52 %", "43 %", "120 %".
[[nodiscard]] std::string format_percent(double part);
/// How to get a median error down; empty if it is small, or a target was set.
[[nodiscard]] std::string advice_on_error(const RunFile& run, double median);

/// The number of sensors, and the errors of the light on the brighter side of each.
/// @param sensors  Result::sensors
[[nodiscard]] std::string describe_sensors(const Result& sensors);
/// Whether the target of a run was reached, and by how much of its light.
[[nodiscard]] std::string describe_target(const RunFile& run, const Result& result);

/// Flux or energy as text. The printed parts add up to the emitted light.
/// @param unit  of the numbers
[[nodiscard]] std::string describe_energy(
    const BandBudget& budget, const std::string& unit, bool escaped_by_difference);

}  // namespace quasimc

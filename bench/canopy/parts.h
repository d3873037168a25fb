#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace quasimc::bench {

/// How thorough the benchmark is.
struct Effort {
    std::uint32_t replicates = 20;
    std::uint64_t paths = 65536;
    std::uint32_t most_leaves = 1000000;
    int repeats = 5;                            ///< of timings, of which the median counts
    std::uint32_t repetitions = 200;            ///< of runs, to count how many are right
    std::uint32_t corner_runs = 500;            ///< of runs in each corner
    std::uint64_t plain_paths = 1'000'000'000;  ///< of plain tracing, to agree with
    std::uint32_t most_triangles = 1'000'000;   ///< of canopies
    std::string cases;                          ///< of bars: only names that hold this
};

/// Variance, CPU time and figure of merit of every sampler and direction of tracing.
void print_efficiency(const Effort& effort);
/// What tracing from lit surfaces is held to, mark by mark.
void print_bars(const Effort& effort);
/// Figure of merit of each way of tracing, and which of them the planner chooses.
void print_planner(const Effort& effort);
/// Whether "auto" is within twice the best method's time, on canopies of code, whose every light is
/// a case, and on those of run files, under the same suns and sky.
/// @param words  that the name of a case, "maize, sun at 90", must hold
[[nodiscard]] bool print_canopies(
    const Effort& effort, const std::vector<std::string>& files, const std::string& words);
/// Errors and times of ray bundles, by leaves, light and paths.
void print_bundles(const Effort& effort);
/// How often 95 % intervals hold the truth where that is hard: closed forms, every method.
void print_corners(const Effort& effort);
/// How often 95 % intervals hold the truth.
void print_coverage(const Effort& effort);
/// Whether every way of tracing agrees with plain Monte Carlo tracing on scenes of many kinds.
void print_agreement(const Effort& effort);
/// Ratio of two bands: one path for both against one for each.
void print_band_ratio(const Effort& effort);
/// What further bands cost.
void print_band_cost(const Effort& effort);
/// Rays per second against a bare Embree loop over the same rays.
void print_engine_speed(const Effort& effort);
/// A day by the hour against one hour, and collapsed into one trace.
void print_day(const Effort& effort);
/// A year, its hours together, against one hour at the same error.
void print_season(const Effort& effort);
/// One thread against two.
void print_scaling(const Effort& effort);

}  // namespace quasimc::bench

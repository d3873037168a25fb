#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace quasimc::bench {

/// Effort of the benchmark.
struct Effort {
    std::uint32_t replicates = 20;
    std::uint64_t paths = 65536;
    std::uint32_t most_leaves = 1000000;
    int repeats = 5;                            ///< timings, of which the median counts
    std::uint32_t repetitions = 200;            ///< runs for coverage
    std::uint32_t corner_runs = 500;            ///< runs for each corner
    std::uint64_t plain_paths = 1'000'000'000;  ///< plain light tracing, as the reference
    std::string cases;                          ///< only names that contain this
    std::vector<std::string> files;             ///< choice: run files with further scenes
    std::string truths;               ///< width: folder where truths are stored; empty: none
    std::string method;               ///< width: of the runs; empty: automatic
    std::uint64_t only_paths = 0;     ///< width: paths per replicate; 0: both numbers
    std::uint32_t width_runs = 100;   ///< width: seeds
    std::uint64_t truth_divisor = 1;  ///< width: divides the paths of truths
};

/// Prints variance, CPU time and figure of merit of every sampler and direction of tracing.
void print_efficiency(const Effort& effort);
/// Prints the targets of first_hits.
void print_bars(const Effort& effort);
/// Prints cost and error of each method, and of the planner's choice at equal cost.
void print_choice(const Effort& effort);
/// Prints the processor time of each unit of work.
void print_costs(const Effort& effort);
/// Prints errors and times of ray bundles, by leaves, light and paths.
void print_bundles(const Effort& effort);
/// Prints the coverage of 95 % intervals in hard cases: closed forms, every method.
void print_corners(const Effort& effort);
/// Prints the coverage of 95 % intervals.
void print_coverage(const Effort& effort);
/// Prints whether every method agrees with plain Monte Carlo light tracing on many kinds of scenes.
void print_agreement(const Effort& effort);
/// Prints the ratio of two bands: one path for both against one for each.
void print_band_ratio(const Effort& effort);
/// Prints the cost of further bands.
void print_band_cost(const Effort& effort);
/// Prints rays per second against a bare Embree loop over the same rays.
void print_engine_speed(const Effort& effort);
/// Prints a day by the hour against one hour, and its cumulative light.
void print_day(const Effort& effort);
/// Prints a year with daylight coefficients against one hour at the same error.
void print_season(const Effort& effort);
/// Prints reported over true errors and coverage, by kind of quantity, in hard scenes.
void print_width(const Effort& effort);
/// Prints one thread against two.
void print_scaling(const Effort& effort);

}  // namespace quasimc::bench

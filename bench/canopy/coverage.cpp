// Coverage of 95 % intervals: many runs of every method against a long one.

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "parts.h"
#include "scenes.h"
#include "sums/statistics.h"
#include "ways.h"

namespace quasimc::bench {
namespace {

constexpr std::uint64_t kPaths = 4096;

RunSpec spec_of(const Way& way, std::uint64_t seed) {
    RunSpec spec;
    spec.sampler = way.sampler;
    spec.method = way.from;
    spec.paths = kPaths;
    spec.replicates = 8;
    spec.seed = seed;
    return spec;
}

/// A reference with errors about a sixteenth of those of the tested runs, or less.
Result long_run(const Scene& scene, const Sources& sources, const Way& way) {
    RunSpec spec = spec_of(way, 987654321);
    spec.paths = 64 * kPaths;
    spec.replicates = 32;
    return run(scene, sources, spec);
}

bool holds(const Estimate& interval, const Estimate& truth) {
    return interval.ci95_low <= truth.mean && truth.mean <= interval.ci95_high;
}

/// The fraction of the organs whose intervals contain the truth.
double organs_right(const Result& result, const Result& truth) {
    double right = 0;
    for (std::size_t i = 0; i < result.organs(); ++i) {
        const Quantity q = Quantity::absorbed_flux;
        right += holds(result.at(i, q, 0), truth.at(i, q, 0)) ? 1 : 0;
    }
    return right / static_cast<double>(result.organs());
}

void print_row(
    const Scene& scene,
    const Sources& sources,
    const Way& way,
    const Result& truth,
    std::uint32_t repetitions) {
    std::vector<double> organs;
    double totals = 0;
    for (std::uint32_t i = 1; i <= repetitions; ++i) {
        const Result result = run(scene, sources, spec_of(way, i));
        organs.push_back(organs_right(result, truth));
        totals +=
            holds(result.budget[0].absorbed_by_organs, truth.budget[0].absorbed_by_organs) ? 1 : 0;
    }
    // Organs of one run are not independent: each run is one observation.
    const Estimate all = estimate_mean(organs);
    const double part = totals / repetitions;
    std::printf(
        "  %-22s %6.2f +- %.2f %% %8.1f +- %.1f %%\n", way.name, 100 * all.mean,
        100 * all.standard_error, 100 * part, 100 * std::sqrt(.95 * .05 / repetitions));
    std::fflush(stdout);
}

}  // namespace

void print_coverage(const Effort& effort) {
    constexpr std::uint32_t kLeaves = 80;
    std::printf(
        "\n== Coverage: intervals (95 %%) of the absorbed flux that contain the truth, %u runs of "
        "8 "
        "replicates of %lu paths, %u leaves\n",
        effort.repetitions, kPaths, kLeaves);
    for (const Light light : {Light::sun, Light::sky}) {
        for (const double albedo : {0.2, 0.9}) {
            const Scene scene = make_canopy({.leaves = kLeaves, .albedos = {albedo}});
            const Sources sources = make_light(light, 1);
            const Result truth =
                long_run(scene, sources, light == Light::sun ? kWays[4] : kWays[3]);
            std::printf(
                "\n  %-22s %17s %19s\n",
                (std::string(albedo < .5 ? "PAR, " : "NIR, ") +
                 (light == Light::sun ? "sun" : "uniform sky"))
                    .c_str(),
                "organs", "all organs");
            for (const Way& way : kWays) {
                print_row(scene, sources, way, truth, effort.repetitions);
            }
        }
    }
}

}  // namespace quasimc::bench

// Performance targets of first_hits and ray_bundles: variance of the irradiance of leaves (both
// sides, per one-sided area, mean over leaves) and CPU time of one replicate, one thread. The
// constants in solvers/direct/sampling_budget.cpp were chosen on the canopy of seed 1; the other
// seeds are independent of it.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "parts.h"
#include "scenes.h"

namespace quasimc::bench {
namespace {

constexpr std::array<std::uint64_t, 3> kSeeds{1, 7, 8};
constexpr int kTimings = 5;

struct Measured {
    double variance = 0;  ///< of the irradiance
    double seconds = 0;
    double error = 0;  ///< root of the variance over the mean irradiance

    [[nodiscard]] double merit() const { return 1 / (variance * seconds); }
};

struct Case {
    std::uint32_t leaves = 500;
    double albedo = 0.2;
    Light light = Light::sun;
};

Measured measure(
    const Scene& scene, const Sources& sources, const RunSpec& spec, double absorptance) {
    const Result result = run(scene, sources, spec);
    std::vector<double> seconds{result.solve_cpu_seconds};
    // Short runs are repeated, for the machine may be busy.
    constexpr double kShort = 0.5;
    for (int i = 1; i < kTimings && result.solve_cpu_seconds < kShort; ++i) {
        seconds.push_back(run(scene, sources, spec).solve_cpu_seconds);
    }
    double mean = 0;
    for (std::size_t i = 0; i < result.organs(); ++i) {
        mean += result.at(i, Quantity::absorbed_flux_density, 0).mean;
    }
    mean /= static_cast<double>(result.organs());
    const double variance = mean_variance(result);
    return {
        variance / (absorptance * absorptance), median(seconds) / spec.replicates,
        std::sqrt(variance) / mean};
}

RunSpec make_spec(Method from, std::string sampler, std::uint64_t paths, const Effort& effort) {
    RunSpec spec;
    spec.method = from;
    spec.sampler = std::move(sampler);
    spec.paths = paths;
    spec.replicates = effort.replicates;
    spec.threads = 1;
    return spec;
}

bool is_asked_for(const std::string& name, const Effort& effort) {
    return name.find(effort.cases) != std::string::npos;
}

const char* met(bool is_met) {
    return is_met ? "met" : "MISSED";
}

/// Direct light alone: black leaves.
void print_direct(
    const char* name,
    const Case& one,
    std::uint64_t paths,
    double most_variance,
    double most_ms,
    const Effort& effort) {
    if (!is_asked_for(name, effort)) {
        return;
    }
    for (const std::uint64_t seed : kSeeds) {
        const Scene scene = make_canopy({.leaves = one.leaves, .albedos = {0}, .seed = seed});
        const Sources sources = make_light(one.light, 1);
        const Measured m =
            measure(scene, sources, make_spec(Method::first_hits, "sobol", paths, effort), 1);
        std::printf(
            "  %-37s seed %lu: variance %.2e in %6.2f ms (at most %.0e in %g ms: %s)\n", name, seed,
            m.variance, 1e3 * m.seconds, most_variance, most_ms,
            met(m.variance <= most_variance && 1e3 * m.seconds <= most_ms));
    }
}

/// Prints the figure of merit relative to light tracing with a sampler.
void print_merit(
    Method method,
    const char* name,
    const Case& one,
    const std::string& sampler,
    double least,
    std::uint64_t paths,
    const Effort& effort) {
    if (!is_asked_for(name, effort)) {
        return;
    }
    for (const std::uint64_t seed : kSeeds) {
        const Scene scene =
            make_canopy({.leaves = one.leaves, .albedos = {one.albedo}, .seed = seed});
        const Sources sources = make_light(one.light, 1);
        const double absorptance = 1 - one.albedo;
        const Measured lit =
            measure(scene, sources, make_spec(method, "sobol", paths, effort), absorptance);
        const Measured plain = measure(
            scene, sources, make_spec(Method::light_tracing, sampler, paths, effort), absorptance);
        const double ratio = lit.merit() / plain.merit();
        std::printf(
            "  %-37s seed %lu: %6.1f times %s from sources at %lu paths (at least %g: %s)\n", name,
            seed, ratio, sampler.c_str(), paths, least, met(ratio >= least));
    }
}

/// Prints the CPU time of one replicate until the error of a leaf is 1 % of the mean irradiance,
/// with scattering.
void print_time(
    Method method, const char* name, const Case& one, double most_ms, const Effort& effort) {
    constexpr double kError = 0.01;
    constexpr double kMinStep = 1.03;
    if (!is_asked_for(name, effort)) {
        return;
    }
    for (const std::uint64_t seed : kSeeds) {
        const Scene scene =
            make_canopy({.leaves = one.leaves, .albedos = {one.albedo}, .seed = seed});
        const Sources sources = make_light(one.light, 1);
        std::uint64_t paths = 1024;
        const auto try_paths = [&] {
            const RunSpec spec = make_spec(method, "sobol", paths, effort);
            return measure(scene, sources, spec, 1 - one.albedo);
        };
        Measured m = try_paths();
        while (m.error > kError) {
            // Variance falls at least with the number of paths.
            const double missing = std::pow(m.error / kError, 2);
            paths = static_cast<std::uint64_t>(
                static_cast<double>(paths) * std::clamp(missing, kMinStep, 2.0));
            m = try_paths();
        }
        std::printf(
            "  %-37s seed %lu: error %.2f %% in %7.1f ms, %lu paths (1 %% in %g ms: %s)\n", name,
            seed, 100 * m.error, 1e3 * m.seconds, paths, most_ms,
            met(m.error <= kError && 1e3 * m.seconds <= most_ms));
    }
}

/// Prints the ratio of times of bundles in five bands and in one, pair by pair.
void print_bands(const char* name, const Case& one, double most, const Effort& effort) {
    constexpr std::size_t kBands = 5;
    if (!is_asked_for(name, effort)) {
        return;
    }
    const auto seconds_of = [&](std::size_t bands) {
        const Scene scene = make_canopy(
            {.leaves = one.leaves,
             .albedos = std::vector<double>(bands, one.albedo),
             .seed = kSeeds[0]});
        const RunSpec spec = make_spec(Method::ray_bundles, "sobol", effort.paths, effort);
        return run(scene, make_light(one.light, bands), spec).solve_cpu_seconds;
    };
    std::vector<double> ratios;
    for (int repeat = 0; repeat < std::max(3, effort.repeats); ++repeat) {
        const double of_one = seconds_of(1);
        ratios.push_back(seconds_of(kBands) / of_one);
    }
    std::printf(
        "  %-37s %.2f times the time of one band (at most %g: %s)\n", name, median(ratios), most,
        met(median(ratios) <= most));
}

/// Prints the targets of ray bundles.
void print_bundle_bars(const Effort& effort) {
    std::printf("\n== Targets of ray bundles\n");
    constexpr Method kBundles = Method::ray_bundles;
    constexpr double kPar = 0.2, kNir = 0.9;
    print_time(kBundles, "bundles, 500 leaves, PAR, sun", {500, kPar, Light::sun}, 5, effort);
    print_time(
        kBundles, "bundles, 10,000 leaves, PAR, sun", {10000, kPar, Light::sun}, 100, effort);
    print_time(
        kBundles, "bundles, 10,000 leaves, NIR, sun", {10000, kNir, Light::sun}, 600, effort);
    print_time(
        kBundles, "bundles, 10,000 leaves, PAR, overcast", {10000, kPar, Light::overcast}, 600,
        effort);
    print_time(
        kBundles, "bundles, 10,000 leaves, NIR, overcast", {10000, kNir, Light::overcast}, 1000,
        effort);
    print_bands("bundles, five bands, NIR, sun", {10000, kNir, Light::sun}, 1.5, effort);
    print_bands("bundles, five bands, NIR, sky", {10000, kNir, Light::sky}, 1.5, effort);
    struct Merit {
        const char* name;
        Case one;
        double least;
    };
    constexpr Merit kMerits[]{
        {"bundles, 500 leaves, PAR, sun", {500, kPar, Light::sun}, 300},
        {"bundles, 10,000 leaves, PAR, sun", {10000, kPar, Light::sun}, 200},
        {"bundles, 500 leaves, NIR, sun", {500, kNir, Light::sun}, 40},
        {"bundles, 10,000 leaves, NIR, sun", {10000, kNir, Light::sun}, 25},
        {"bundles, 500 leaves, PAR, sky", {500, kPar, Light::sky}, 40},
        {"bundles, 10,000 leaves, PAR, sky", {10000, kPar, Light::sky}, 20},
        {"bundles, 500 leaves, NIR, sky", {500, kNir, Light::sky}, 100},
        {"bundles, 10,000 leaves, NIR, sky", {10000, kNir, Light::sky}, 60},
    };
    for (const Merit& merit : kMerits) {
        print_merit(
            kBundles, merit.name, merit.one, "monte_carlo", merit.least, effort.paths, effort);
    }
}

}  // namespace

void print_bars(const Effort& effort) {
    std::printf("\n== Targets of first_hits\n");
    constexpr Method kFirst = Method::first_hits;
    print_direct("direct sun, 500 leaves", {}, 5 << 15, 1e-7, 3, effort);
    print_direct("direct sun, 10,000 leaves", {.leaves = 10000}, 1 << 17, 1e-5, 20, effort);
    print_direct(
        "direct overcast, 500 leaves", {.light = Light::overcast}, 1 << 20, 2e-6, 200, effort);
    const std::uint64_t paths = effort.paths;
    for (const std::uint64_t n : {paths, 16 * paths}) {
        print_merit(kFirst, "500 leaves, PAR, sun", {}, "monte_carlo", 60, n, effort);
        print_merit(kFirst, "500 leaves, PAR, sun", {}, "korobov", 6, n, effort);
    }
    constexpr Case kMany{.leaves = 10000};
    constexpr Case kSky{.light = Light::sky};
    constexpr Case kNir{.albedo = 0.9};
    print_merit(kFirst, "10,000 leaves, PAR, sun", kMany, "monte_carlo", 20, paths, effort);
    print_merit(kFirst, "500 leaves, PAR, sky", kSky, "monte_carlo", 10, paths, effort);
    print_merit(kFirst, "500 leaves, NIR, sun", kNir, "monte_carlo", 4, paths, effort);
    print_merit(
        kFirst, "500 leaves, NIR, sky", {500, 0.9, Light::sky}, "monte_carlo", 1, paths, effort);
    print_merit(kFirst, "10,000 leaves, NIR, sun", {10000, 0.9}, "monte_carlo", 1, paths, effort);
    print_merit(
        kFirst, "10,000 leaves, PAR, sky", {10000, 0.2, Light::sky}, "monte_carlo", 1, paths,
        effort);
    print_merit(
        kFirst, "10,000 leaves, NIR, sky", {10000, 0.9, Light::sky}, "monte_carlo", 1, paths,
        effort);
    print_time(kFirst, "500 leaves, PAR, sun", {}, 20, effort);
    print_time(kFirst, "10,000 leaves, PAR, sun", {.leaves = 10000}, 1000, effort);
    print_bundle_bars(effort);
    if (is_asked_for("season", effort)) {
        print_season(effort);
    }
}

}  // namespace quasimc::bench

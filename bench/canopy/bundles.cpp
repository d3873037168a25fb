// Errors and times of ray bundles: the table of docs/develop/notebook/ray-bundles.md. Errors are
// those of one replicate: root of the mean variance over leaves, over the mean.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "parts.h"
#include "scenes.h"

namespace quasimc::bench {
namespace {

constexpr std::uint64_t kSeed = 7;
constexpr int kTimings = 3;

/// Relative to all light on leaves.
struct Errors {
    double all = 0, direct = 0, scattered = 0;
};

/// The mean over leaves of the squared error of a quantity in one replicate, where it is known.
double square_of(const Result& result, Quantity quantity, double replicates) {
    double sum = 0;
    for (std::size_t i = 0; i < result.organs(); ++i) {
        const double error = result.at(i, quantity, 0).standard_error;
        sum += std::isfinite(error) ? error * error * replicates : 0;
    }
    return sum / static_cast<double>(result.organs());
}

double mean_of(const Result& result, Quantity quantity) {
    double sum = 0;
    for (std::size_t i = 0; i < result.organs(); ++i) {
        sum += result.at(i, quantity, 0).mean;
    }
    return sum / static_cast<double>(result.organs());
}

Errors errors_of(const Scene& scene, const Sources& sources, const RunSpec& spec) {
    const Result result = run(scene, sources, spec);
    const double incident =
        mean_of(result, Quantity::incident_direct) + mean_of(result, Quantity::incident_scattered);
    const auto error = [&](Quantity quantity, double mean) {
        return std::sqrt(square_of(result, quantity, spec.replicates)) / mean;
    };
    const double absorbed = mean_of(result, Quantity::absorbed_flux_density);
    return {
        error(Quantity::absorbed_flux_density, absorbed),
        error(Quantity::incident_direct, incident), error(Quantity::incident_scattered, incident)};
}

/// CPU seconds of a replicate.
double time_of(const Scene& scene, const Sources& sources, const RunSpec& spec) {
    std::vector<double> seconds;
    while (seconds.size() < kTimings) {
        seconds.push_back(run(scene, sources, spec).solve_cpu_seconds / spec.replicates);
    }
    return median(seconds);
}

struct Case {
    std::uint32_t leaves;
    const char* waveband;
    double albedo;
    Light light;
    const char* light_name;
};

void print_case(const Case& one, std::uint64_t paths, const Effort& effort) {
    const std::string name =
        fmt::format("{} leaves, {}, {}, {} paths", one.leaves, one.waveband, one.light_name, paths);
    if (name.find(effort.cases) == std::string::npos) {
        return;
    }
    const Scene scene = make_canopy({.leaves = one.leaves, .albedos = {one.albedo}, .seed = kSeed});
    const Sources sources = make_light(one.light, 1);
    RunSpec spec;
    spec.method = Method::ray_bundles;
    spec.sampler = "sobol";
    spec.paths = paths;
    spec.replicates = effort.replicates;
    spec.threads = 1;
    const Errors errors = errors_of(scene, sources, spec);
    const double seconds = time_of(scene, sources, spec);
    std::printf(
        "  %-42s error %6.3f %% (direct %6.3f, scattered %6.3f), %8.2f ms, "
        "1 / (error^2 s) %8.3g\n",
        name.c_str(), 100 * errors.all, 100 * errors.direct, 100 * errors.scattered, 1e3 * seconds,
        1 / (errors.all * errors.all * seconds));
    std::fflush(stdout);
}

}  // namespace

void print_bundles(const Effort& effort) {
    std::printf("\n== Ray bundles: error of a leaf and CPU time of a replicate\n");
    constexpr double kPar = 0.2, kNir = 0.9;
    constexpr Case kCases[]{
        {500, "PAR", kPar, Light::sun, "sun"},
        {500, "PAR", kPar, Light::overcast, "overcast"},
        {500, "NIR", kNir, Light::sun, "sun"},
        {500, "NIR", kNir, Light::overcast, "overcast"},
        {500, "NIR", kNir, Light::sky, "sky"},
        {10000, "PAR", kPar, Light::sun, "sun"},
        {10000, "PAR", kPar, Light::overcast, "overcast"},
        {10000, "NIR", kNir, Light::sun, "sun"},
        {10000, "NIR", kNir, Light::overcast, "overcast"},
    };
    for (const Case& one : kCases) {
        for (std::uint64_t paths = 4096; paths <= 16 * effort.paths; paths *= 4) {
            print_case(one, paths, effort);
        }
    }
}

}  // namespace quasimc::bench

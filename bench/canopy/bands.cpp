#include <cmath>
#include <cstdio>

#include "parts.h"
#include "scenes.h"

namespace quasimc::bench {
namespace {

// Red and far-red leaves: rho + tau.
constexpr double kRed = 0.1;
constexpr double kFarRed = 0.8;

RunSpec plain_spec(const Effort& effort) {
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.paths = effort.paths;
    spec.replicates = effort.replicates;
    spec.threads = 1;
    return spec;
}

/// Incident light of an organ: absorbed flux density / absorptance.
Estimate incident(const Result& result, std::size_t organ, std::size_t band, double albedo) {
    Estimate e = result.at(organ, Quantity::absorbed_flux_density, band);
    e.mean /= 1 - albedo;
    e.standard_error /= 1 - albedo;
    return e;
}

/// Mean relative variance of R:FR per replicate with one path per band: the two are independent.
double separate_variance(const Result& red, const Result& far, std::uint32_t replicates) {
    double sum = 0;
    for (std::size_t i = 0; i < red.organs(); ++i) {
        const Estimate r = incident(red, i, 0, kRed);
        const Estimate f = incident(far, i, 0, kFarRed);
        if (r.mean > 0 && f.mean > 0) {
            sum +=
                (std::pow(r.standard_error / r.mean, 2) + std::pow(f.standard_error / f.mean, 2)) *
                replicates;
        }
    }
    return sum / static_cast<double>(red.organs());
}

double common_variance(const Result& both, std::uint32_t replicates) {
    double sum = 0;
    for (std::size_t i = 0; i < both.organs(); ++i) {
        const Estimate& ratio = both.ratio(i, 0);
        if (ratio.mean > 0) {
            sum += std::pow(ratio.standard_error / ratio.mean, 2) * replicates;
        }
    }
    return sum / static_cast<double>(both.organs());
}

}  // namespace

void print_band_ratio(const Effort& effort) {
    std::printf(
        "\n== R:FR on 500 leaves (rho + tau %.2f and %.2f): mean relative variance per leaf, sun "
        "and sky\n",
        kRed, kFarRed);
    std::printf(
        "  %-6s %15s %15s %8s %18s\n", "light", "path per band", "one path", "ratio",
        "CPU ms (each, one)");
    for (const Light light : {Light::sun, Light::sky}) {
        RunSpec spec = plain_spec(effort);
        const Result red = run(make_canopy({500, {kRed}, 1}), make_light(light, 1), spec);
        spec.seed = 2;
        const Result far = run(make_canopy({500, {kFarRed}, 1}), make_light(light, 1), spec);
        spec.ratios = {"band0:band1"};
        const Result both = run(make_canopy({500, {kRed, kFarRed}, 1}), make_light(light, 2), spec);
        const double separate = separate_variance(red, far, spec.replicates);
        const double common = common_variance(both, spec.replicates);
        const double to_ms = 1e3 / spec.replicates;
        std::printf(
            "  %-6s %15.3e %15.3e %8.2f %9.2f %8.2f\n", light == Light::sun ? "sun" : "sky",
            separate, common, separate / common,
            (red.solve_cpu_seconds + far.solve_cpu_seconds) * to_ms,
            both.solve_cpu_seconds * to_ms);
    }
}

void print_band_cost(const Effort& effort) {
    std::printf("\n== Cost of bands: 500 leaves, PAR, sun, CPU of the run relative to one band\n");
    std::printf("  %6s %10s %10s %16s\n", "bands", "CPU ms", "relative", "per further band");
    std::vector<Scene> scenes;
    const std::vector<std::size_t> counts{1, 2, 4, 20, 100, 200};
    for (const std::size_t bands : counts) {
        scenes.push_back(make_canopy({500, std::vector<double>(bands, 0.2), 1}));
    }
    std::vector<std::vector<double>> ratios(counts.size());
    std::vector<double> seconds(counts.size());
    for (int repeat = 0; repeat < effort.repeats; ++repeat) {
        for (std::size_t i = 0; i < counts.size(); ++i) {
            const Result result =
                run(scenes[i], make_light(Light::sun, counts[i]), plain_spec(effort));
            seconds[i] = result.solve_cpu_seconds;
            ratios[i].push_back(seconds[i] / seconds[0]);
        }
    }
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const double relative = median(ratios[i]);
        const double further =
            counts[i] > 1 ? (relative - 1) / static_cast<double>(counts[i] - 1) : 0;
        std::printf(
            "  %6zu %10.2f %10.3f %15.2f%%\n", counts[i], 1e3 * seconds[i], relative,
            100 * further);
    }
}

}  // namespace quasimc::bench

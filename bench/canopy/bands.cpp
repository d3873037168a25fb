#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

#include "optics/prospect.h"
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

/// Albedos of a green leaf in bands that are spread over 400 to 2400 nm; one is the brightest.
std::vector<double> leaf_albedos(std::size_t bands) {
    constexpr LeafConstituents kGreen{
        .structure = 1.5, .chlorophyll = 40, .carotenoids = 10, .water = .015, .dry_matter = .009};
    constexpr std::size_t kUsed = 400;  // 5 nm each
    std::vector<double> albedos;
    for (std::size_t b = 0; b < bands; ++b) {
        constexpr std::size_t kBrightest = 80;  // 800 nm
        const std::size_t row = bands == 1 ? kBrightest : b * kUsed / bands;
        const LeafOptics leaf = prospect(leaf_constants()[row], kGreen);
        albedos.push_back(leaf.reflectance + leaf.transmittance);
    }
    return albedos;
}

/// A number of /proc/self/status in bytes; 0 where there is none.
double bytes_of_status(const std::string& name) {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        if (word == name + ":") {
            double kilobytes = 0;
            status >> kilobytes;
            return 1024 * kilobytes;
        }
    }
    return 0;
}

struct Cost {
    double seconds = 0, bytes = 0;
};

/// CPU time and largest additional memory of a run.
Cost cost_of(std::uint32_t leaves, std::size_t bands, const Effort& effort) {
    const Scene scene = make_canopy({leaves, leaf_albedos(bands), 1});
    RunSpec spec = plain_spec(effort);
    spec.method = Method::ray_bundles;
    spec.replicates = 8;
    std::vector<double> seconds;
    double bytes = 0;
    for (int repeat = 0; repeat < (leaves < 1000 ? effort.repeats : 1); ++repeat) {
        std::ofstream("/proc/self/clear_refs") << 5;  // the peak begins anew
        const double before = bytes_of_status("VmRSS");
        seconds.push_back(run(scene, make_light(Light::sun, bands), spec).solve_cpu_seconds);
        bytes = std::max(bytes, bytes_of_status("VmHWM") - before);
    }
    return {median(seconds), bytes};
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
    for (const std::uint32_t leaves : {500U, 10000U}) {
        const std::string name = std::to_string(leaves) + " leaves";
        if (leaves > effort.most_leaves || name.find(effort.cases) == std::string::npos) {
            continue;
        }
        std::printf(
            "\n== Cost of bands: %s of PROSPECT-D, sun, ray bundles; CPU and memory of the "
            "run\n",
            name.c_str());
        std::printf(
            "  %6s %10s %10s %10s %24s\n", "bands", "CPU ms", "relative", "MB",
            "bytes per organ and band");
        double one = 0;
        for (const std::size_t bands : {1, 50, 200, 400}) {
            const Cost cost = cost_of(leaves, bands, effort);
            one = bands == 1 ? cost.seconds : one;
            std::printf(
                "  %6zu %10.1f %10.2f %10.1f %24.0f\n", bands, 1e3 * cost.seconds,
                cost.seconds / one, 1e-6 * cost.bytes,
                cost.bytes / static_cast<double>(leaves * bands));
        }
    }
}

}  // namespace quasimc::bench

#include <cstdio>
#include <map>
#include <string>

#include "parts.h"
#include "samplers/catalogue.h"
#include "scenes.h"

namespace quasimc::bench {
namespace {

struct Measured {
    double variance = 0;
    double seconds = 0;  ///< CPU, per replicate

    [[nodiscard]] double merit() const { return 1 / (variance * seconds); }
};

Measured measure(const Scene& scene, const Sources& sources, const RunSpec& spec) {
    const Result result = run(scene, sources, spec);
    return {mean_variance(result), result.solve_cpu_seconds / spec.replicates};
}

const char* name_of(Method from) {
    switch (from) {
        case Method::light_tracing:
            return "sources";
        case Method::from_organs:
            return "organs";
        case Method::first_hits:
            break;
        case Method::ray_bundles:
            return "bundles";
        case Method::automatic:
            return "auto";
    }
    return "lit";
}

void print_case(const Canopy& canopy, Light light, const std::string& title, const Effort& effort) {
    const Scene scene = make_canopy(canopy);
    const Sources sources = make_light(light, canopy.albedos.size());
    std::printf("\n%s, %u leaves, %lu paths\n", title.c_str(), canopy.leaves, effort.paths);
    std::printf(
        "  %-12s %-9s %11s %10s %12s %8s\n", "sampler", "from", "variance", "CPU ms", "1/(var s)",
        "x MC");
    double reference = 0;
    for (const Method from : {Method::light_tracing, Method::from_organs, Method::first_hits}) {
        for (const SamplerEntry& sampler : sampler_catalogue()) {
            RunSpec spec;
            spec.sampler = sampler.name;
            spec.method = from;
            spec.paths = effort.paths;
            spec.replicates = effort.replicates;
            spec.threads = 1;
            const Measured measured = measure(scene, sources, spec);
            // The first row is plain Monte Carlo light tracing.
            reference = reference > 0 ? reference : measured.merit();
            std::printf(
                "  %-12s %-9s %11.3e %10.2f %12.3e %8.2f\n", spec.sampler.c_str(), name_of(from),
                measured.variance, 1e3 * measured.seconds, measured.merit(),
                measured.merit() / reference);
        }
    }
}

}  // namespace

void print_efficiency(const Effort& effort) {
    std::printf(
        "\n== Efficiency: variance of the absorbed flux density per leaf (mean over leaves), CPU "
        "time "
        "and figure of merit of one replicate\n");
    for (const std::uint32_t leaves : {500U, 10000U}) {
        for (const Light light : {Light::sun, Light::sky}) {
            for (const double albedo : {0.2, 0.9}) {
                print_case(
                    {leaves, {albedo}, 1}, light,
                    std::string(albedo < 0.5 ? "PAR (rho = tau = 0.1)" : "NIR (rho = tau = 0.45)") +
                        (light == Light::sun ? ", sun" : ", uniform sky"),
                    effort);
            }
        }
    }
}

}  // namespace quasimc::bench

// The target of "auto": on any canopy, under any light, at most twice the time of the best method
// at equal error.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "crops.h"
#include "methods.h"
#include "parts.h"
#include "quasimc/run.h"
#include "quasimc/run_file.h"
#include "run/plan_run.h"
#include "scenes.h"

namespace quasimc::bench {
namespace {

constexpr double kMaxTimesBest = 2;
/// The cost of a method that can't be used.
constexpr double kNever = std::numeric_limits<double>::infinity();

/// The cost of one method: CPU time, and relative variances of a replicate.
struct Cost {
    double seconds = 1;
    double organ_variance = kNever;  ///< median over organs and bands of the absorbed flux
    double total_variance = kNever;  ///< absorbed flux of all organs, mean over the bands
    [[nodiscard]] double of_organs() const { return seconds * organ_variance; }
    [[nodiscard]] double of_total() const { return seconds * total_variance; }
};

double square(double x) {
    return x * x;
}

/// Mean of all methods of the absorbed flux of an organ in a band, weighted by precision; 0 if none
/// sampled light there.
double agreed_mean(const std::vector<Result>& results, std::size_t organ, std::size_t band) {
    double sum = 0;
    double weights = 0;
    for (const Result& result : results) {
        const Estimate& e = result.at(organ, Quantity::absorbed_flux, band);
        if (e.mean > 0 && e.standard_error > 0) {
            sum += e.mean / square(e.standard_error);
            weights += 1 / square(e.standard_error);
        }
    }
    return weights > 0 ? sum / weights : 0;
}

/// A lit organ without contributions has an error of 100 %.
double median_organ_variance(
    const Scene& scene, const Result& result, const std::vector<Result>& all) {
    std::vector<double> squares;
    for (std::size_t organ = 0; organ < result.organs(); ++organ) {
        for (std::size_t band = 0; band < result.bands; ++band) {
            const double mean = agreed_mean(all, organ, band);
            if (mean > 0 && scene.organs()[organ].measured && !scene.organs()[organ].is_ground) {
                const Estimate& e = result.at(organ, Quantity::absorbed_flux, band);
                squares.push_back(e.mean > 0 ? square(e.standard_error / mean) : 1);
            }
        }
    }
    return squares.empty() ? 0 : median(squares) * result.replicates;
}

double total_variance(const Result& result) {
    double sum = 0;
    for (const BandBudget& budget : result.budget) {
        const Estimate& e = budget.absorbed_by_organs;
        sum += e.mean > 0 ? square(e.standard_error / e.mean) : 1;
    }
    return sum / static_cast<double>(result.bands) * result.replicates;
}

/// Runs a method; times are the minimum of several, for the machine may be busy. Slow methods have
/// fewer replicates: their cost need not be accurate.
Result run_and_time(
    const Scene& scene,
    const Sources& sources,
    RunSpec spec,
    int repeats,
    Simulator& simulator,
    double& seconds) {
    constexpr std::uint32_t kMinReplicates = 4;
    constexpr double kMaxSeconds = 10, kLong = 2;
    const std::uint32_t wanted = spec.replicates;
    spec.replicates = kMinReplicates;
    Result result = simulator.run(scene, sources, spec);
    const double most = kMaxSeconds / result.solve_cpu_seconds * kMinReplicates;
    if (most > 2 * kMinReplicates) {
        spec.replicates = static_cast<std::uint32_t>(std::min<double>(wanted, most));
        result = simulator.run(scene, sources, spec);
    }
    seconds = result.solve_cpu_seconds;
    for (int i = 1; i < repeats && seconds < kLong; ++i) {
        seconds = std::min(seconds, simulator.run(scene, sources, spec).solve_cpu_seconds);
    }
    seconds /= spec.replicates;
    return result;
}

std::vector<Cost> costs_of(
    const Scene& scene, const Sources& sources, RunSpec spec, int repeats, Simulator& simulator) {
    std::vector<Cost> costs(kMethods.size());
    std::vector<Result> results;
    std::vector<std::size_t> methods;
    for (std::size_t i = 0; i < kMethods.size(); ++i) {
        if (can_run(kMethods[i], scene)) {
            spec.method = kMethods[i];
            results.push_back(
                run_and_time(scene, sources, spec, repeats, simulator, costs[i].seconds));
            methods.push_back(i);
        }
    }
    for (std::size_t k = 0; k < methods.size(); ++k) {
        costs[methods[k]].organ_variance = median_organ_variance(scene, results[k], results);
        costs[methods[k]].total_variance = total_variance(results[k]);
    }
    return costs;
}

/// Ratio of one cost to the smallest.
double times_best(const std::vector<Cost>& costs, std::size_t i, double (Cost::*cost)() const) {
    double best = kNever;
    for (const Cost& one : costs) {
        best = std::min(best, (one.*cost)());
    }
    return best > 0 ? (costs[i].*cost)() / best : 1;
}

/// @returns whether auto is within the target
bool print_case(
    const Scene& scene,
    const CropLight& light,
    const Effort& effort,
    std::uint64_t paths,
    Simulator& simulator) {
    RunSpec spec;
    spec.paths = paths;
    // The variance of a single organ is as uncertain as its replicates.
    constexpr std::size_t kFewOrgans = 20;
    constexpr std::uint32_t kOfFewOrgans = 64;
    spec.replicates =
        std::max(effort.replicates, scene.organs().size() < kFewOrgans ? kOfFewOrgans : 0);
    spec.threads = 1;
    spec.method = Method::automatic;
    CachedRayCaster caster;
    const Method chosen = plan_run(scene, light.sources, spec, caster, {}).method;
    const std::vector<Cost> costs = costs_of(scene, light.sources, spec, effort.repeats, simulator);
    std::size_t automatic = 0;
    std::printf("  %-14s", light.name.c_str());
    for (std::size_t i = 0; i < kMethods.size(); ++i) {
        const bool is_chosen = kMethods[i] == chosen;
        automatic = is_chosen ? i : automatic;
        if (!can_run(kMethods[i], scene)) {
            std::printf(" %25s ", "-");
            continue;
        }
        std::printf(
            " %9.2f %7.3f %7.4f%c", 1e3 * costs[i].seconds,
            100 * std::sqrt(costs[i].organ_variance), 100 * std::sqrt(costs[i].total_variance),
            is_chosen ? '*' : ' ');
    }
    const double ratio = times_best(costs, automatic, &Cost::of_organs);
    const bool holds = ratio <= kMaxTimesBest;
    std::printf(
        " %7.2f %7.2f%s\n", ratio, times_best(costs, automatic, &Cost::of_total),
        holds ? "" : "  MISSED");
    std::fflush(stdout);
    return holds;
}

/// The selected lights of a canopy: those whose name contains the given text, or all if the
/// canopy's does.
std::vector<CropLight> chosen_lights(
    const std::string& canopy, std::vector<CropLight> lights, const std::string& words) {
    std::erase_if(lights, [&](const CropLight& light) {
        return (canopy + ", " + light.name).find(words) == std::string::npos;
    });
    return lights;
}

std::size_t print_canopy(
    const std::string& name,
    const Scene& scene,
    const std::vector<CropLight>& all_lights,
    const Effort& effort,
    std::uint64_t paths,
    const std::string& words) {
    const std::vector<CropLight> lights = chosen_lights(name, all_lights, words);
    if (lights.empty()) {
        return 0;
    }
    std::printf(
        "\n%s, %zu triangles, %zu organs, %lu paths\n", name.c_str(), scene.triangle_count(),
        scene.organs().size(), paths);
    Simulator simulator;
    std::size_t missed = 0;
    for (const CropLight& light : lights) {
        missed += print_case(scene, light, effort, paths, simulator) ? 0 : 1;
    }
    return missed;
}

}  // namespace

bool print_canopies(
    const Effort& effort, const std::vector<std::string>& files, const std::string& words) {
    std::printf(
        "\n== Canopies: CPU time of a replicate (ms), median error of what an organ absorbs and "
        "error of what all absorb (%%), of each method; * is what \"auto\" chooses; its time over "
        "that of the best method at equal error, of organs and of the total\n  %-14s",
        "light");
    for (const char* name : kMethodNames) {
        std::printf(" %-26s", name);
    }
    std::printf(" %7s %7s\n", "organs", "total");
    std::size_t missed = 0;
    for (const std::uint64_t paths : {effort.paths / 16, effort.paths}) {
        for (const Crop crop : kCrops) {
            const std::uint32_t size = std::min(full_size(crop), effort.most_triangles);
            missed += print_canopy(
                name_of(crop), make_crop(crop, size), lights_of(crop), effort, paths, words);
        }
        for (const std::string& file : files) {
            missed +=
                print_canopy(file, read_run_file(file).scene, suns_and_sky(), effort, paths, words);
        }
    }
    std::printf("\n%zu cases above %g times the best\n", missed, kMaxTimesBest);
    return missed == 0;
}

}  // namespace quasimc::bench

// The choice of method = "auto": every method on many kinds of scenes, by the variance of the light
// on measured organs.

#include "planner/planner.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "methods.h"
#include "parts.h"
#include "quasimc/source.h"
#include "scene/scene.h"
#include "scenes.h"

namespace quasimc::bench {
namespace {

constexpr std::array kWays{
    Method::light_tracing, Method::from_organs, Method::first_hits, Method::ray_bundles};

struct Case {
    std::string name;
    Canopy canopy;
    Sources sources;
};

Sources make_lamp_above(const Canopy& canopy) {
    LampSpec lamp;
    lamp.name = "panel";
    lamp.position = {5, 5, 15};
    lamp.opening = {.kind = Opening::Kind::rectangle, .length = 6, .width = 4};
    lamp.pattern = cosine_pattern();
    lamp.flux.assign(canopy.albedos.size(), 100);
    return {make_lamp(std::move(lamp))};
}

using Results = std::array<Result, kWays.size()>;

/// The mean of the method with the smallest error.
double best_mean(const Results& all, std::size_t organ, Quantity quantity) {
    double mean = 0;
    double error = std::numeric_limits<double>::infinity();
    for (const Result& result : all) {
        if (result.values.empty()) {
            continue;  // the method can't be used
        }
        const Estimate& e = result.at(organ, quantity, 0);
        if (e.mean > 0 && e.standard_error < error) {
            mean = e.mean;
            error = e.standard_error;
        }
    }
    return mean;
}

/// The variance of a result. If it has no contributions, they are assumed Poisson distributed with
/// a third of the interval's upper end as their size; at least 100 %.
double variance_of(const Estimate& e, double mean) {
    return e.mean > 0 ? e.standard_error * e.standard_error
                      : mean * std::max(mean, e.ci95_high / 3);
}

/// Mean over the measured organs of the variance of the light on both sides.
double variance_of_measured(const Scene& scene, const Result& result, const Results& all) {
    double sum = 0;
    double count = 0;
    for (std::size_t i = 0; i < result.organs(); ++i) {
        if (!scene.organs()[i].measured) {
            continue;
        }
        for (const Quantity q : {Quantity::incident_upper, Quantity::incident_lower}) {
            sum += variance_of(result.at(i, q, 0), best_mean(all, i, q)) * result.replicates;
        }
        ++count;
    }
    return sum / count;
}

/// @returns the ratio of the best figure of merit to that of auto
double print_case(const Case& one, const Effort& effort) {
    const Scene scene = make_canopy(one.canopy);
    RunSpec spec;
    spec.method = Method::automatic;
    spec.paths = effort.paths;
    const ChosenMethod choice = plan_method(scene, one.sources, spec);
    Results results;
    std::size_t chosen = 0;
    for (std::size_t i = 0; i < kWays.size(); ++i) {
        if (!can_run(kWays[i], scene)) {
            continue;
        }
        spec.method = kWays[i];
        spec.replicates = effort.replicates;
        spec.threads = 1;
        results[i] = run(scene, one.sources, spec);
        chosen = choice.method == kWays[i] ? i : chosen;
    }
    std::array<double, kWays.size()> merit{};
    for (std::size_t i = 0; i < kWays.size(); ++i) {
        if (results[i].values.empty()) {
            continue;
        }
        const double variance = variance_of_measured(scene, results[i], results);
        merit[i] = spec.replicates / (variance * std::max(results[i].solve_cpu_seconds, 1e-9));
    }
    const double best = *std::max_element(merit.begin(), merit.end());
    std::printf("  %-38s %7.1f", one.name.c_str(), gain_of_equal_shares(scene));
    for (std::size_t i = 0; i < kWays.size(); ++i) {
        std::printf(" %9.3f%c", merit[i] / best, i == chosen ? '*' : ' ');
    }
    std::printf("\n");
    std::fflush(stdout);
    return best / merit[chosen];
}

/// A point lamp among the leaves.
Sources make_lamp_inside(const Canopy& canopy) {
    LampSpec lamp;
    lamp.name = "point";
    lamp.position = {5, 5, 5};
    lamp.flux.assign(canopy.albedos.size(), 100);
    return {make_lamp(std::move(lamp))};
}

/// PAR and NIR, sun, sky and lamps on one canopy.
void add_lights(std::vector<Case>& cases, const std::string& name, Canopy canopy) {
    for (const double albedo : {0.2, 0.9}) {
        canopy.albedos = {albedo};
        const std::string words = name + (albedo < 0.5 ? ", PAR" : ", NIR");
        cases.push_back({words + ", sun", canopy, make_light(Light::sun, 1)});
        cases.push_back({words + ", sky", canopy, make_light(Light::sky, 1)});
        cases.push_back({words + ", panel", canopy, make_lamp_above(canopy)});
        cases.push_back({words + ", point inside", canopy, make_lamp_inside(canopy)});
    }
}

std::vector<Case> make_cases(const Effort& effort) {
    std::vector<Case> cases;
    for (const std::uint32_t leaves : {20U, 500U, 10000U, 100000U}) {
        if (leaves <= effort.most_leaves) {
            add_lights(cases, std::to_string(leaves), {.leaves = leaves});
        }
    }
    for (const std::uint32_t measured : {100U, 50U, 25U, 10U}) {
        add_lights(
            cases, "500, " + std::to_string(measured) + " measured",
            {.leaves = 500, .measured = measured});
    }
    add_lights(cases, "10000, 100 measured", {.leaves = 10000, .measured = 100});
    add_lights(cases, "500, 10 sensors", {.leaves = 500, .sensors = 10});
    add_lights(cases, "500, repeated", {.leaves = 500, .is_repeated = true});
    constexpr double kMirror = std::numeric_limits<double>::infinity();
    for (const double exponent : {10.0, 100.0, 1000.0, kMirror}) {
        const std::string words = exponent < kMirror
                                      ? ", Phong " + std::to_string(static_cast<int>(exponent))
                                      : ", mirror";
        add_lights(
            cases, "500, 10 measured" + words,
            {.leaves = 500, .measured = 10, .phong_exponent = exponent});
        add_lights(
            cases, "500, 10 sensors" + words,
            {.leaves = 500, .sensors = 10, .phong_exponent = exponent});
    }
    return cases;
}

}  // namespace

void print_planner(const Effort& effort) {
    std::printf(
        "\n== Planner: figure of merit 1/(variance x CPU time) of the light on the measured "
        "organs, "
        "relative to the best; * is what \"auto\" chooses\n");
    std::printf(
        "  %-38s %7s %9s  %9s  %9s  %9s\n", "leaves, albedo, source", "gain", "sources", "organs",
        "lit", "bundles");
    constexpr double kMuch = 2;
    double worst = 1;
    std::size_t above = 0;
    for (const Case& one : make_cases(effort)) {
        if (!(one.canopy.is_repeated && one.sources.front()->traits() == kLampTraits)) {
            const double times = print_case(one, effort);
            worst = std::max(worst, times);
            above += times > kMuch ? 1 : 0;
        }
    }
    std::printf("%zu cases above %g times the best, at most %.2g times\n", above, kMuch, worst);
}

}  // namespace quasimc::bench

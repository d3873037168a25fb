// The cost of each unit of work (planner/work_cost.h): non-negative least squares of relative
// misfits of processor time over runs of all methods.
//
//     ./dev bench costs --cases "500, NIR"    names that contain this

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "base/process_time.h"
#include "choice_cases.h"
#include "methods.h"
#include "parts.h"
#include "planner/work_cost.h"
#include "sums/sum_data.h"

namespace quasimc::bench {
namespace {

constexpr std::array kUnitNames{
    "ray, for each halving of the triangles",
    "triangle of a strip of scan lines",
    "visible segment of a scan line, or piece of it",
    "triangle of an item buffer",
    "pixel",
    "pixel on a patch",
    "triangle of a bundle's direction",
    "segment of a bundle",
    "patch, order and band"};
/// Runs below this time are mostly preparation.
constexpr double kShortest = 2e-3, kLongest = .1;

/// A run: its time and the time that a nanosecond of each unit would take.
struct Timed {
    std::size_t method = 0;
    double seconds = 0;
    std::array<double, kWorkUnits> of_unit{};
};

void add_runs(const ChoiceCase& one, std::vector<Timed>& runs) {
    const ChoiceScene scene = one.make();
    Simulator simulator;
    RunSpec first;
    first.method = Method::light_tracing;
    first.paths = 64;
    static_cast<void>(simulator.sums(scene.scene, scene.sources, first, 0, {}, {}));  // prepares
    for (std::size_t m = 0; m < kMethods.size(); ++m) {
        double seconds = 0;
        for (std::uint64_t paths = 256; paths <= 1U << 20U && seconds < kLongest; paths *= 8) {
            RunSpec spec;
            spec.method = kMethods[m];
            spec.paths = paths;
            spec.threads = 1;
            try {
                const Stopwatch watch;
                const Sums sums = simulator.sums(scene.scene, scene.sources, spec, 0, {}, {});
                seconds = watch.cpu_seconds();
                Timed run{m, seconds, {}};
                for (std::size_t u = 0; u < kWorkUnits; ++u) {
                    run.of_unit[u] =
                        seconds_of_unit(sums, scene.scene, static_cast<WorkUnit>(u), 1);
                }
                if (seconds >= kShortest) {
                    runs.push_back(run);
                }
            } catch (const InputError&) {
                break;  // the method can't be used
            }
        }
    }
}

/// Coordinate descent.
std::array<double, kWorkUnits> fit(const std::vector<Timed>& runs) {
    std::array<double, kWorkUnits> costs{};
    std::vector<double> left(runs.size(), 1);  // of each time, relative
    for (int i = 0; i < 20000; ++i) {
        const std::size_t u = static_cast<std::size_t>(i) % kWorkUnits;
        double product = 0, square = 0;
        for (std::size_t r = 0; r < runs.size(); ++r) {
            const double each = runs[r].of_unit[u] / runs[r].seconds;
            product += each * left[r];
            square += each * each;
        }
        const double change = square > 0 ? std::max(-costs[u], product / square) : 0;
        costs[u] += change;
        for (std::size_t r = 0; r < runs.size(); ++r) {
            left[r] -= change * runs[r].of_unit[u] / runs[r].seconds;
        }
    }
    return costs;
}

double predicted(const Timed& run, const std::array<double, kWorkUnits>& costs) {
    double sum = 0;
    for (std::size_t u = 0; u < kWorkUnits; ++u) {
        sum += run.of_unit[u] * costs[u];
    }
    return sum;
}

void print_ratios(
    const char* words,
    const std::vector<Timed>& runs,
    const std::array<double, kWorkUnits>& costs) {
    for (std::size_t m = 0; m < kMethods.size(); ++m) {
        std::vector<double> ratios;
        for (const Timed& run : runs) {
            if (run.method == m) {
                ratios.push_back(predicted(run, costs) / run.seconds);
            }
        }
        std::ranges::sort(ratios);
        const auto at = [&](double part) {
            return ratios[static_cast<std::size_t>(part * static_cast<double>(ratios.size() - 1))];
        };
        if (!ratios.empty()) {
            std::printf(
                "   %s, %-14s %4zu runs: predicted / measured %.2f (%.2f to %.2f)\n", words,
                kMethodNames[m], ratios.size(), at(0.5), at(0.05), at(0.95));
        }
    }
}

}  // namespace

void print_costs(const Effort& effort) {
    std::printf("\n== Costs of units of work, ns\n");
    std::vector<Timed> runs;
    for (const ChoiceCase& one : choice_cases()) {
        if (one.name.find(effort.cases) != std::string::npos) {
            add_runs(one, runs);
        }
    }
    const std::array<double, kWorkUnits> costs = fit(runs);
    std::array<double, kWorkUnits> used{};
    for (std::size_t u = 0; u < kWorkUnits; ++u) {
        used[u] = nanoseconds_of(static_cast<WorkUnit>(u));
        std::printf("   %-50s %6.1f (planner: %.1f)\n", kUnitNames[u], costs[u], used[u]);
    }
    print_ratios("fitted ", runs, costs);
    print_ratios("planner", runs, used);
}

}  // namespace quasimc::bench

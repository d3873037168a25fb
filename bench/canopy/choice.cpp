// The choice of method = "auto": its error against that of the best method at equal cost.
//
//     ./dev bench choice                     all cases and budgets
//     ./dev bench choice --cases "500, NIR"  some

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "base/process_time.h"
#include "choice_cases.h"
#include "methods.h"
#include "parts.h"
#include "quasimc/run_file.h"
#include "scenes.h"

namespace quasimc::bench {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// Costs up to which methods are tried, and of a choice, s.
constexpr double kMaxSeconds = 0.6;
/// Ratio of paths between the runs of a method, and least number of paths.
constexpr std::uint64_t kStep = 4, kFewest = 64;
/// Paths of the reference over those of the longest run of its method.
constexpr std::uint64_t kLonger = 8;

/// Organs of which a single error is no chance; of fewer, several seeds are run.
constexpr std::size_t kManyOrgans = 10, kSeeds = 8;

/// Runs of some seeds and their mean processor time, with that of pilot runs.
struct TimedRun {
    std::vector<Result> results;
    double cost = 0;
};
TimedRun timed_run(const ChoiceScene& one, RunSpec spec, Simulator& simulator) {
    const auto measured =
        static_cast<std::size_t>(std::ranges::count_if(one.scene.organs(), [](const Organ& organ) {
            return organ.measured && !organ.is_ground && organ.area > 0;
        }));
    const std::size_t seeds = measured < kManyOrgans ? kSeeds : 1;
    TimedRun timed;
    const Stopwatch watch;
    for (; timed.results.size() < seeds; ++spec.seed) {
        timed.results.push_back(simulator.run(one.scene, one.sources, spec));
    }
    timed.cost = watch.cpu_seconds() / static_cast<double>(seeds);
    return timed;
}

/// The light of an organ: what it absorbs or, of sensors, receives.
Estimate light_of(const Result& result, const Result& truth, std::size_t organ, std::size_t band) {
    const bool absorbs = truth.at(organ, Quantity::absorbed_flux, band).mean > 0;
    return result.at(organ, absorbs ? Quantity::absorbed_flux : Quantity::incident_upper, band);
}

double known(double standard_error) {
    return std::isfinite(standard_error) ? standard_error : 0;
}

/// Root mean square error of the measured organs relative to their mean, of the worst band.
/// @param square  of one: (its light, the truth) -> squared error
template <typename Square>
double error_of(
    const Scene& scene, const Result& result, const Result& truth, const Square& square) {
    double worst = 0;
    for (std::size_t b = 0; b < result.bands; ++b) {
        double squares = 0, sum = 0, count = 0;
        for (std::size_t i = 0; i < scene.organs().size(); ++i) {
            const Organ& organ = scene.organs()[i];
            if (organ.measured && !organ.is_ground && organ.area > 0) {
                const Estimate exact = light_of(truth, truth, i, b);
                squares += square(light_of(result, truth, i, b), exact);
                sum += exact.mean;
                ++count;
            }
        }
        if (sum > 0) {
            worst = std::max(worst, std::sqrt(std::max(0., squares) * count) / sum);
        }
    }
    return worst;
}

/// The true error; that of the truth is taken off.
double true_error(const Scene& scene, const Result& result, const Result& truth) {
    return error_of(scene, result, truth, [](const Estimate& e, const Estimate& exact) {
        const double own = known(exact.standard_error);
        return (e.mean - exact.mean) * (e.mean - exact.mean) - own * own;
    });
}

double true_error(const Scene& scene, const TimedRun& run, const Result& truth) {
    double squares = 0;
    for (const Result& result : run.results) {
        squares += std::pow(true_error(scene, result, truth), 2);
    }
    return std::sqrt(squares / static_cast<double>(run.results.size()));
}

double reported_error(const Scene& scene, const Result& result) {
    return error_of(scene, result, result, [](const Estimate& e, const Estimate&) {
        return std::isfinite(e.standard_error) ? e.standard_error * e.standard_error
                                               : e.ci95_high * e.ci95_high;
    });
}

struct Point {
    double cost = 0, error = 0;
};

/// One method: its runs with more and more paths.
struct Ladder {
    std::string method;
    std::vector<std::uint64_t> paths;
    std::vector<TimedRun> runs;
    std::vector<Point> points;  ///< against the reference

    /// The error at a cost; infinite below the least.
    [[nodiscard]] double error_at(double cost) const {
        if (points.empty() || cost < points.front().cost) {
            return kInfinite;
        }
        std::size_t i = 0;
        while (i + 1 < points.size() && points[i + 1].cost < cost) {
            ++i;
        }
        if (i + 1 == points.size()) {
            return points[i].error * std::sqrt(points[i].cost / cost);
        }
        const Point &a = points[i], &b = points[i + 1];
        const double part = std::log(cost / a.cost) / std::log(b.cost / a.cost);
        return a.error * std::pow(std::max(b.error, 1e-12) / std::max(a.error, 1e-12), part);
    }
};

RunSpec spec_for(Method method, std::uint64_t paths) {
    RunSpec spec;
    spec.method = method;
    spec.paths = paths;
    spec.threads = 1;
    return spec;
}

std::vector<Ladder> climb(const ChoiceScene& one, Simulator& simulator) {
    std::vector<Ladder> ladders;
    for (std::size_t i = 0; i < kMethods.size(); ++i) {
        if (!can_run(kMethods[i], one.scene)) {
            continue;
        }
        Ladder& ladder = ladders.emplace_back(Ladder{kMethodNames[i], {}, {}, {}});
        for (std::uint64_t paths = kFewest; paths <= 1U << 24U; paths *= kStep) {
            try {
                ladder.runs.push_back(timed_run(one, spec_for(kMethods[i], paths), simulator));
            } catch (const InputError&) {
                break;  // the method can't be used
            }
            ladder.paths.push_back(paths);
            if (kStep * ladder.runs.back().cost > 2 * kMaxSeconds) {
                break;
            }
        }
    }
    std::erase_if(ladders, [](const Ladder& ladder) { return ladder.runs.empty(); });
    return ladders;
}

Result reference_of(
    const ChoiceScene& one, const std::vector<Ladder>& ladders, Simulator& simulator) {
    const auto merit = [&](const Ladder& ladder) {
        const TimedRun& last = ladder.runs.back();
        return std::pow(reported_error(one.scene, last.results.front()), 2) * last.cost;
    };
    const Ladder& best = *std::min_element(
        ladders.begin(), ladders.end(),
        [&](const Ladder& a, const Ladder& b) { return merit(a) < merit(b); });
    const double affordable = 8 * kMaxSeconds / best.runs.back().cost;
    RunSpec spec = spec_for(
        best.runs.back().results.front().chosen.method,
        best.paths.back() *
            std::clamp<std::uint64_t>(static_cast<std::uint64_t>(affordable), 1, kLonger));
    spec.seed = 97;
    return simulator.run(one.scene, one.sources, spec);
}

/// Prints a case. @returns how many times the best method's cost the choice takes, by budget
std::vector<double> print_case(const ChoiceCase& one) {
    const ChoiceScene scene = one.make();
    Simulator simulator;
    std::vector<Ladder> ladders = climb(scene, simulator);
    const Result truth = reference_of(scene, ladders, simulator);
    for (Ladder& ladder : ladders) {
        for (const TimedRun& run : ladder.runs) {
            ladder.points.push_back({run.cost, true_error(scene.scene, run, truth)});
        }
    }
    std::printf(
        "%s (%zu organs, %zu triangles)\n", one.name.c_str(), scene.scene.organs().size(),
        scene.scene.triangle_count());
    for (const Ladder& ladder : ladders) {
        std::printf("   %-14s", ladder.method.c_str());
        for (std::size_t i = 0; i < ladder.points.size(); ++i) {
            std::printf(" %.4f s %.3g %%;", ladder.points[i].cost, 100 * ladder.points[i].error);
        }
        std::printf("\n");
    }
    std::vector<double> all;
    for (const std::uint64_t paths : {1024U, 65536U, 1048576U}) {
        const TimedRun run = timed_run(scene, spec_for(Method::automatic, paths), simulator);
        const double cost = run.cost, error = true_error(scene.scene, run, truth);
        const ChosenMethod& chosen_method = run.results.front().chosen;
        const Ladder* best = &ladders.front();
        for (const Ladder& ladder : ladders) {
            best = ladder.error_at(cost) < best->error_at(cost) ? &ladder : best;
        }
        const double times = std::max(1., std::pow(error / best->error_at(cost), 2));
        const auto chosen = std::ranges::find(kMethods, chosen_method.method) - kMethods.begin();
        std::printf(
            "   %8llu paths: %-14s %.4f s %.3g %%; best %-14s %.3g %%; %.2f times\n",
            static_cast<unsigned long long>(paths), kMethodNames[static_cast<std::size_t>(chosen)],
            cost, 100 * error, best->method.c_str(), 100 * best->error_at(cost), times);
        std::printf("            %s\n", chosen_method.reason.c_str());
        all.push_back(std::isfinite(best->error_at(cost)) ? times : 1);
        if (16 * cost > 4 * kMaxSeconds) {
            break;
        }
    }
    std::fflush(stdout);
    return all;
}

}  // namespace

void print_choice(const Effort& effort) {
    std::printf(
        "\n== Choice: cost and root mean square error of every method; that of \"auto\", and how "
        "many times the cost of the best method at its error\n");
    std::vector<double> all;
    std::vector<ChoiceCase> cases = choice_cases();
    for (const std::string& file : effort.files) {
        cases.push_back({file, [file] {
                             const RunFile run = read_run_file(file);
                             return ChoiceScene{run.scene, run.sources};
                         }});
    }
    for (const ChoiceCase& one : cases) {
        if (one.name.find(effort.cases) != std::string::npos) {
            const std::vector<double> own = print_case(one);
            all.insert(all.end(), own.begin(), own.end());
        }
    }
    std::printf("%zu choices:", all.size());
    for (const double limit : {1.5, 2., 4., 20.}) {
        const auto within =
            std::ranges::count_if(all, [&](double times) { return times <= limit; });
        std::printf(
            " %.0f %% within %g,",
            100. * static_cast<double>(within) / static_cast<double>(all.size()), limit);
    }
    std::printf(" worst %.3g\n", all.empty() ? 1 : *std::ranges::max_element(all));
}

}  // namespace quasimc::bench

#include "run/plan_run.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/executor.h"
#include "base/parallel.h"
#include "planner/planner.h"
#include "planner/work_cost.h"
#include "results/evaluate.h"
#include "run/evaluation_of.h"
#include "run/trace_plan.h"
#include "samplers/catalogue.h"
#include "solvers/catalogue.h"
#include "transport/prepared_scene.h"

namespace quasimc {
namespace {

/// The paths of a trial are this part of all paths of a run.
constexpr std::uint64_t kPartOfRun = 64;
constexpr std::uint32_t kReplicates = 2;
/// Trials take too large a part of the time of runs with fewer paths in all replicates, for
/// each triangle too.
constexpr std::uint64_t kFewestPaths = 1U << 16U, kFewestForTriangle = 4;
/// Methods are compared at this multiple of the work of the first one's trial. Errors fall with
/// about these powers of the work.
constexpr double kMoreWork = 16, kPower = 0.65, kPowerOfBundles = 0.8;
/// Paths from organs hardly ever find light of suns and lamps through narrow lobes. A trial that
/// does not find it has too small an error.
constexpr double kOverlooked = 3;
/// Methods are alike below this ratio of errors for equal work.
constexpr double kAlike = 1.15;

struct Trial {
    Method method;
    double error = 0, seconds = 0;
    [[nodiscard]] double error_after(double more_seconds) const {
        const double power = method == Method::ray_bundles ? kPowerOfBundles : kPower;
        return error * std::pow(seconds / more_seconds, power);
    }
};

/// Traces a few paths by each method.
class Trials {
  public:
    Trials(const PlanInput& input, const PreparedScene& prepared)
        : input_(input),
          prepared_(prepared),
          asked_(evaluation_of(input.scene, input.sources, input.spec)) {}

    [[nodiscard]] Trial of(Method method) const {
        const RunSpec& spec = input_.spec;
        RunSpec few = planned_spec(
            spec,
            {.method = method,
             .paths = std::bit_floor(spec.paths * spec.replicates / (kPartOfRun * kReplicates))});
        few.replicates = kReplicates;
        Sums sums = empty_sums(prepared_, few);
        Executor executor(thread_count(few.threads), {.stop = input_.stop});
        make_solver({prepared_, input_.sampler, few, input_.stop})
            ->solve({0, few.paths}, executor, sums);
        const bool overlooks =
            method == Method::from_organs && hides_light(input_.scene, input_.sources);
        return {
            method, (overlooks ? kOverlooked : 1) * pooled_error(sums, input_.scene, asked_),
            seconds_of_work(sums, input_.scene)};
    }

  private:
    const PlanInput& input_;
    const PreparedScene& prepared_;
    EvaluationSpec asked_;
};

/// Sets the errors to those for equal work.
void equalize(std::vector<Trial>& trials) {
    const double seconds = kMoreWork * trials.front().seconds;
    for (Trial& trial : trials) {
        trial.error = trial.error_after(seconds);
    }
}

/// The first method whose error is about the least.
const Trial& best_of(const std::vector<Trial>& trials) {
    const double least = std::ranges::min_element(trials, {}, &Trial::error)->error;
    return *std::ranges::find_if(
        trials, [&](const Trial& trial) { return trial.error <= kAlike * least; });
}

std::string reason_for(const Trial& best, const std::vector<Trial>& trials) {
    std::string others;
    for (const Trial& trial : trials) {
        if (trial.method != best.method) {
            others += fmt::format(
                "{}{:.2g} times by {}", others.empty() ? "" : ", ", trial.error / best.error,
                find_solver(trial.method)->name);
        }
    }
    return "trials: the error for equal work would be " + others;
}

bool has_time_for_trials(const PlanInput& input) {
    const std::uint64_t paths = input.spec.paths * input.spec.replicates;
    return paths >= kFewestPaths && paths / kFewestForTriangle >= input.scene.triangle_count();
}

}  // namespace

ChosenMethod plan_run(const PlanInput& input) {
    const RunSpec& spec = input.spec;
    if (spec.method != Method::automatic) {
        return {spec.method, "requested"};
    }
    const auto caster = input.caster.caster_for(input.scene, spec.accelerator, input.stop);
    const std::vector<Method> methods = candidate_methods(input.scene, input.sources, spec, [&] {
        return !input.allows_bundles || caster->crossings(input.stop).gave_up;
    });
    if (methods.size() == 1) {
        return {methods.front(), "no other method can be used"};
    }
    if (!has_time_for_trials(input)) {
        return {methods.front(), "too few paths for trials"};
    }
    const PreparedScene prepared(input.scene, input.sources, spec.start_area, caster, input.stop);
    if (prepared.lights().empty()) {
        return {methods.front(), "no light"};
    }
    const Trials trials(input, prepared);
    std::vector<Trial> done;
    for (const Method method : methods) {
        done.push_back(trials.of(method));
    }
    equalize(done);
    const Trial& best = best_of(done);
    return {best.method, reason_for(best, done)};
}

ChosenMethod plan_method(const Scene& scene, const Sources& sources, const RunSpec& spec) {
    CachedRayCaster caster;
    return plan_run({scene, sources, spec, *make_sampler(spec.sampler), caster, {}});
}

}  // namespace quasimc

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
#include "results/question.h"
#include "run/evaluation_of.h"
#include "run/trace_plan.h"
#include "samplers/catalogue.h"
#include "solvers/catalogue.h"
#include "transport/prepared_scene.h"

namespace quasimc {
namespace {

/// The paths of a pilot run, in all replicates: this part of those of the run, and no more than
/// show what is best, so that a huge run can be stopped soon.
constexpr std::uint64_t kPartOfRun = 64, kEnoughPaths = 1U << 14U;
/// Replicates of a pilot run: two show the scatter of many organs together; of fewer, there are
/// more, so that about kDegrees differences show it.
constexpr std::size_t kDegrees = 16, kMaxReplicates = 8;
/// They take too large a part of the time of runs with fewer paths in all replicates, for
/// each triangle too.
constexpr std::uint64_t kFewPaths = 1U << 16U, kMinPerTriangle = 4;
/// Methods are compared at this multiple of the work of the first pilot run. Errors fall with
/// about these powers of the work.
constexpr double kMoreWork = 16, kPower = 0.65, kPowerOfBundles = 0.8;
/// Paths from organs hardly ever find light of suns and lamps through narrow lobes. A pilot run
/// that does not find it has too small an error.
constexpr double kOverlooked = 3;
/// Methods are alike below this ratio of errors for equal work.
constexpr double kAlike = 1.15;

struct PilotRun {
    Method method;
    double error = 0, seconds = 0;
    [[nodiscard]] double error_after(double more_seconds) const {
        const double power = method == Method::ray_bundles ? kPowerOfBundles : kPower;
        return error * std::pow(seconds / more_seconds, power);
    }
};

/// Traces a few paths by each method.
class PilotRuns {
  public:
    PilotRuns(const PlanInput& input, const PreparedScene& prepared)
        : input_(input),
          prepared_(prepared),
          asked_(evaluation_of(input.scene, input.sources, input.spec)) {
        std::size_t sets = 0;
        for (const AskedLight& asked : asked_light(input.scene, asked_)) {
            sets += asked.sets();
        }
        const std::size_t wanted = 2 + kDegrees / std::max<std::size_t>(sets, 1);
        replicates_ = static_cast<std::uint32_t>(std::min(wanted, kMaxReplicates));
    }

    [[nodiscard]] PilotRun of(Method method) const {
        const RunSpec& spec = input_.spec;
        const std::uint64_t all = std::min(spec.paths * spec.replicates / kPartOfRun, kEnoughPaths);
        RunSpec few =
            planned_spec(spec, {.method = method, .paths = std::bit_floor(all / replicates_)});
        few.replicates = replicates_;
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
    std::uint32_t replicates_ = 2;
};

/// Sets the errors to those for equal work.
void equalize(std::vector<PilotRun>& pilots) {
    const double seconds = kMoreWork * pilots.front().seconds;
    for (PilotRun& pilot : pilots) {
        pilot.error = pilot.error_after(seconds);
    }
}

/// The first method whose error is about the least.
const PilotRun& best_of(const std::vector<PilotRun>& pilots) {
    const double least = std::ranges::min_element(pilots, {}, &PilotRun::error)->error;
    return *std::ranges::find_if(
        pilots, [&](const PilotRun& pilot) { return pilot.error <= kAlike * least; });
}

std::string reason_for(const PilotRun& best, const std::vector<PilotRun>& pilots) {
    if (!(best.error > 0) || !std::isfinite(best.error)) {
        return "pilot runs show no difference";
    }
    std::string others;
    for (const PilotRun& pilot : pilots) {
        if (pilot.method != best.method) {
            others += fmt::format(
                "{}{:.2g} times by {}", others.empty() ? "" : ", ", pilot.error / best.error,
                find_solver(pilot.method)->name);
        }
    }
    return "pilot runs: the error for equal work would be " + others;
}

/// Why there are no pilot runs; empty if there are.
std::string why_untried(const PlanInput& input, std::size_t methods) {
    const RunSpec& spec = input.spec;
    const std::uint64_t paths = spec.paths * spec.replicates;
    if (methods == 1) {
        return "no other method can be used";
    }
    if (spec.max_seconds > 0) {
        return "no pilot runs within a time limit";
    }
    const bool are_few =
        paths < kFewPaths || paths / kMinPerTriangle < input.scene.triangle_count();
    return are_few ? "too few paths for pilot runs" : "";
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
    if (const std::string why = why_untried(input, methods.size()); !why.empty()) {
        return {methods.front(), why};
    }
    const PreparedScene prepared(
        input.scene, input.sources, spec.start_area, caster, input.stop, spec.origins);
    if (prepared.lights().empty()) {
        return {methods.front(), "no light"};
    }
    const PilotRuns pilots(input, prepared);
    std::vector<PilotRun> done;
    done.reserve(methods.size());
    for (const Method method : methods) {
        done.push_back(pilots.of(method));
    }
    equalize(done);
    const PilotRun& best = best_of(done);
    return {best.method, reason_for(best, done)};
}

ChosenMethod plan_method(const Scene& scene, const Sources& sources, const RunSpec& spec) {
    CachedRayCaster caster;
    return plan_run({scene, sources, spec, *make_sampler(spec.sampler), caster, {}});
}

}  // namespace quasimc

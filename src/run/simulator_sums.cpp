#include <string>
#include <utility>

#include "base/executor.h"
#include "base/parallel.h"
#include "base/stop.h"
#include "run/digest.h"
#include "run/plan_run.h"
#include "run/run_control.h"
#include "run/simulator.h"
#include "run/trace_plan.h"
#include "solvers/catalogue.h"
#include "transport/prepared_scene.h"

namespace quasimc {
namespace {

/// Checks that paths from `first` on are a round of run().
void check_first_path(const Sampler& sampler, const RunSpec& spec, std::uint64_t first) {
    const bool is_whole = first % spec.paths == 0;
    if (!is_whole || (sampler.needs_power_of_two() && first > spec.paths)) {
        throw InputError(
            {{"first", std::to_string(first), "rounds of " + spec.sampler + " must be whole",
              "use 0 or " + std::to_string(spec.paths)}});
    }
}

/// Reports the tasks of one round.
class TaskProgress final : public TaskWatcher {
  public:
    explicit TaskProgress(Work work) : work_(std::move(work)) {}
    void on_progress(double part) override { work_.report(part); }

  private:
    Work work_;
};

}  // namespace

Sums Simulator::State::sums(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    std::uint64_t first,
    const Share& share,
    const RunControl& control) try {
    Faults faults;
    check_run(scene, sources, spec, faults);
    faults.throw_if_any();
    const Work work = work_of(control);
    const ChosenMethod chosen =
        plan_run({scene, sources, spec, sampler_for(spec.sampler), caster_, control.stop});
    const RunSpec planned = planned_spec(spec, {.method = chosen.method});
    check_first_path(sampler_for(spec.sampler), spec, first);
    const PreparedScene prepared(
        scene, sources, planned.start_area,
        caster_.caster_for(scene, spec.accelerator, control.stop), control.stop, planned.origins);
    Sums sums = empty_sums(prepared, planned);
    sums->digest = digest_of(prepared, planned);
    if (prepared.lights().empty()) {
        sums->paths = sums->samples = planned.paths;
        return sums;
    }
    TaskProgress progress(work);
    Executor executor(
        thread_count(planned.threads),
        {.stop = control.stop, .share = share, .watcher = &progress});
    make_solver({prepared, sampler_for(planned.sampler), planned, control.stop})
        ->solve({first, planned.paths}, executor, sums);
    return sums;
} catch (const StopRequested&) {
    throw Stopped(
        StopReason::interrupted, "stopped before all paths were computed; there are no sums");
}

}  // namespace quasimc

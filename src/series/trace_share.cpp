#include <string_view>

#include "quasimc/series.h"
#include "run/run_control.h"
#include "series/trace_spec.h"

namespace quasimc {
namespace {

/// A share of a run does not know the others: it can't decide when all of them together are done.
void check_share(const RunSpec& spec, Faults& faults) {
    const auto refuse = [&](bool is_stated, std::string_view key, std::string_view why) {
        if (is_stated) {
            faults.add(
                {std::string(key), "a part of a run can't apply it", std::string(why),
                 "remove it and set paths"});
        }
    };
    refuse(spec.target_error > 0, "target_error", "errors are known only after merging");
    refuse(spec.max_seconds > 0, "max_seconds", "all parts must use the same paths");
    refuse(spec.max_paths > 0, "max_paths", "a part computes one round of paths");
    refuse(
        spec.time_method == TimeMethod::daylight_coefficients, "time_method",
        "daylight coefficients are computed by one process");
    refuse(spec.audit > 0, "audit", "it compares results after merging");
}

}  // namespace

void trace_share(
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const RunSpec& spec,
    const Share& share,
    const std::function<void(std::size_t time_step, const Sums& sums)>& on_sums,
    const RunControl& control) {
    Faults faults;
    check_share(spec, faults);
    faults.throw_if_any();
    const std::vector<Trace> traces = traces_of(scene, time_steps, spec);
    const Work work = work_of(control);
    const double each = 1 / static_cast<double>(traces.size());
    Simulator simulator;
    for (std::size_t n = 0; n < traces.size(); ++n) {
        const auto& [i, own_spec] = traces[n];
        const RunControl own{
            .stop = control.stop, .work = work.part(static_cast<double>(n) * each, each)};
        on_sums(i, simulator.sums(scene, time_steps[i].sources, own_spec, 0, share, own));
    }
}

}  // namespace quasimc

#include "parallel/dealt_runs.h"

#include <cstring>
#include <string>

#include "base/process_time.h"
#include "parallel/stop_by_team.h"
#include "series/trace_spec.h"

namespace quasimc {
namespace {

/// Sent for a run that the first process must trace, and at the end.
constexpr const char* kNotTraced = "?";
constexpr const char* kNoMoreRuns = "";

GivenSums trace_here(
    Simulator& simulator,
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const RunControl& control) {
    const Stopwatch watch;
    Sums sums = simulator.sums(scene, sources, spec, 0, {}, control);
    return {std::move(sums), watch.seconds(), watch.cpu_seconds()};
}

}  // namespace

bool is_dealt(const RunSpec& spec) {
    return spec.target_error == 0 && spec.max_paths == 0 && spec.max_seconds == 0 &&
           spec.time_method == TimeMethod::independent;
}

DealtRuns::DealtRuns(RunTeam& team, std::uint64_t point, std::uint64_t time_step) : team_(team) {
    static_cast<void>(
        team.order({.kind = TeamOrder::kDealt, .point = point, .time_step = time_step}));
}

DealtRuns::~DealtRuns() {
    team_.stop();
    for (std::uint64_t rank = 1; rank < team_.size(); ++rank) {
        while (team_.receive(rank, {}) != kNoMoreRuns) {
        }
    }
}

GivenSums DealtRuns::next(
    Simulator& simulator,
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const RunControl& control) {
    const std::uint64_t rank = number_++ % team_.size();
    const Stopwatch watch;
    const std::string bytes = rank == 0 ? kNotTraced : team_.receive(rank, control.stop);
    if (bytes == kNotTraced) {
        return trace_here(simulator, scene, sources, spec, control);
    }
    double cpu_seconds = 0;
    std::memcpy(&cpu_seconds, bytes.data(), sizeof cpu_seconds);
    return {
        load_sums(std::string_view(bytes).substr(sizeof cpu_seconds)), watch.seconds(),
        cpu_seconds};
}

void HelpedRuns::trace(
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const RunSpec& spec,
    std::size_t first) {
    if (!is_dealt(spec)) {
        return;
    }
    StopByTeam stop(team_);
    const RunControl control{.stop = stop.token(), .listeners = {&stop}};
    for (const Trace& trace : traces_of(scene, time_steps, spec)) {
        if (trace.time_step < first || number_++ % team_.size() != team_.rank()) {
            continue;
        }
        stop.ask();
        try {
            const GivenSums traced = trace_here(
                simulator_, scene, time_steps[trace.time_step].sources, trace.spec, control);
            std::string bytes(sizeof traced.cpu_seconds, '\0');
            std::memcpy(bytes.data(), &traced.cpu_seconds, sizeof traced.cpu_seconds);
            team_.send(bytes.append(save_sums(traced.sums)));
        } catch (const InputError&) {  // the first process finds and reports it too
            team_.send(kNotTraced);
        }
    }
}

void HelpedRuns::end() {
    team_.send(kNoMoreRuns);
    team_.await_stop();
}

}  // namespace quasimc

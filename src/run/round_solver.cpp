#include "run/round_solver.h"

#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/memory_need.h"
#include "base/parallel.h"
#include "base/process_time.h"
#include "run/trace_plan.h"
#include "solvers/catalogue.h"

namespace quasimc {
namespace {

/// Sums the processor time of the other processes in the first one; 0 in the others.
/// @param own  processor time of this process
double cpu_seconds_of_others(RunTeam& team, double own) {
    constexpr double kNano = 1e-9;
    std::vector<std::int64_t> numbers{
        team.is_first() ? 0 : static_cast<std::int64_t>(std::round(own / kNano))};
    team.add_up(numbers);
    return team.is_first() ? kNano * static_cast<double>(numbers.front()) : 0;
}

}  // namespace

RoundSolver::RoundSolver(
    const PreparedScene& prepared,
    const Sampler& sampler,
    const RunSpec& spec,
    std::stop_token stop,
    const TeamRun& team)
    : prepared_(prepared), sampler_(sampler), spec_(spec), stop_(std::move(stop)), team_(team) {}

Solver& RoundSolver::solver_for(std::uint64_t first_paths) {
    if (!solver_ || solved_spec_->paths != first_paths) {
        solver_.reset();
        solved_spec_ = planned_spec(spec_, {.paths = first_paths});
        solver_ = make_solver({prepared_, sampler_, *solved_spec_, stop_});
    }
    return *solver_;
}

Sums RoundSolver::empty_sums(std::uint64_t first_paths) {
    static_cast<void>(solver_for(first_paths));
    const auto regions = static_cast<double>(prepared_.scene().regions().size());
    const BoundLights& lights = prepared_.lights();
    const auto bins = static_cast<double>(
        2 * (lights.spectra().size() + prepared_.bands() * lights.origin_count()) + 1);
    return make_big(
        fmt::format(
            "the sums of {} regions, {} bands, {} spectra and {} replicates",
            prepared_.scene().regions().size(), prepared_.bands(), lights.spectra().size(),
            spec_.replicates),
        regions * bins * spec_.replicates * sizeof(std::int64_t),
        [&] { return quasimc::empty_sums(prepared_, *solved_spec_); });
}

/// Orders the other processes to trace their tasks.
void RoundSolver::order(const RoundStart& start) const {
    if (team_.team != nullptr && team_.team->is_first()) {
        static_cast<void>(team_.team->order(
            {.point = team_.point,
             .time_step = team_.time_step,
             .first_paths = start.first_paths,
             .round = start.round,
             .tasks = start.tasks}));
    }
}

SolvedRound RoundSolver::solve(const RoundStart& start, Sums& sums, TaskWatcher* watcher) {
    Solver& solver = solver_for(start.first_paths);
    Executor executor(
        thread_count(spec_.threads),
        {.stop = stop_, .watcher = watcher, .team = team_.team, .done_before = start.tasks});
    order(start);
    const Stopwatch watch;
    try {
        solver.solve(start.round, executor, sums);
    } catch (...) {
        executor.give_up();
        throw;
    }
    SolvedRound solved{.part_done_before = executor.part_done_before()};
    if (team_.team != nullptr) {
        add_up(*team_.team, sums);
        solved.cpu_seconds_of_others = cpu_seconds_of_others(*team_.team, watch.cpu_seconds());
    }
    return solved;
}

}  // namespace quasimc

#include "help_run.h"

#include <exception>
#include <optional>

#include "part_run.h"
#include "quasimc/quasimc.h"
#include "sweep_jobs.h"
#include "team_files.h"

Exit help_run(const RunArguments& arguments, const quasimc::RunTeam& team) {
    std::optional<quasimc::StoredSweep> stored;
    std::exception_ptr failure;
    try {
        stored.emplace(read_for_team(arguments, team));
    } catch (...) {
        failure = std::current_exception();  // the first rank most likely has it as well
    }
    quasimc::TeamHelper helper;
    quasimc::Simulator simulator;  // of points that are traced here alone
    quasimc::TeamOrder order = team.order({});
    while (order.is_end == 0) {
        if (failure) {
            std::rethrow_exception(failure);
        }
        const quasimc::RunFile run = stored->runs.take(order.point);
        if (order.is_runs == quasimc::TeamOrder::kPoints) {
            quasimc::help_with_runs(
                team, jobs_of_points(run, stored->runs.size(), order.point, team.size),
                point_tracer(simulator, stored->runs));
            order = team.order({});
            continue;
        }
        order = helper.help(run.scene, quasimc::moments_of(run), run.spec, team, order);
    }
    return Exit::done;
}

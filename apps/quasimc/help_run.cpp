#include "help_run.h"

#include <cstddef>
#include <exception>
#include <memory>
#include <optional>
#include <utility>

#include "parallel/dealt_runs.h"
#include "parallel/team_helper.h"
#include "part_run.h"
#include "quasimc/quasimc.h"
#include "team_files.h"

namespace {

/// The run of a point, with its lamps under control as the first process has them.
std::unique_ptr<quasimc::RunFile> take_run(quasimc::RunSweep& sweep, std::size_t point) {
    auto run = std::make_unique<quasimc::RunFile>(sweep.take(point));
    quasimc::Simulator simulator;
    quasimc::control_lamps(*run, simulator);
    return run;
}

/// @param run, taken  last run taken, and its point
void help_with_dealt(
    quasimc::RunTeam& team,
    quasimc::RunSweep& sweep,
    const quasimc::TeamOrder& order,
    std::unique_ptr<quasimc::RunFile> run,
    std::size_t taken) {
    quasimc::HelpedRuns runs(team);
    try {
        std::size_t first = order.time_step;
        for (std::size_t point = order.point; point < sweep.size(); ++point, first = 0) {
            if (point != taken) {
                run = take_run(sweep, point);
            }
            runs.trace(run->scene, quasimc::time_steps_of(*run), run->spec, first);
        }
    } catch (const quasimc::Stopped&) {  // by the first process, which needs no more
    }
    runs.end();
}

}  // namespace

Exit help_run(const RunArguments& arguments, quasimc::RunTeam& team) {
    std::optional<quasimc::StoredSweep> stored;
    std::exception_ptr failure;
    try {
        stored.emplace(read_for_team(arguments, team));
    } catch (...) {
        failure = std::current_exception();  // most likely the first rank fails likewise
    }
    quasimc::TeamHelper helper;
    quasimc::TeamOrder order = team.order({});
    while (order.kind != quasimc::TeamOrder::kEnd) {
        if (failure) {
            std::rethrow_exception(failure);
        }
        const std::size_t point = order.point;
        auto run = take_run(stored->runs, point);
        order = helper.help(run->scene, quasimc::time_steps_of(*run), run->spec, team, order);
        if (order.kind == quasimc::TeamOrder::kDealt) {
            help_with_dealt(team, stored->runs, order, std::move(run), point);
            order = team.order({});
        }
    }
    return Exit::done;
}

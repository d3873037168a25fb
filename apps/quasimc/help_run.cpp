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

/// The run of a point of the sweep, and its times.
struct HelpedPoint {
    HelpedPoint(quasimc::RunSweep& sweep, std::size_t point) : run(sweep.take(point)) {
        quasimc::Simulator simulator;
        time_steps = quasimc::time_steps_of(run, simulator);
    }

    quasimc::RunFile run;
    std::vector<quasimc::TimeStep> time_steps;
};

/// @param point  the one of the order
void help_with_dealt(
    quasimc::RunTeam& team,
    quasimc::RunSweep& sweep,
    const quasimc::TeamOrder& order,
    std::unique_ptr<HelpedPoint> point) {
    quasimc::HelpedRuns runs(team);
    try {
        runs.trace(point->run.scene, point->time_steps, point->run.spec, order.time_step);
        for (std::size_t next = order.point + 1; next < sweep.size(); ++next) {
            point = std::make_unique<HelpedPoint>(sweep, next);
            runs.trace(point->run.scene, point->time_steps, point->run.spec, 0);
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
        auto point = std::make_unique<HelpedPoint>(stored->runs, order.point);
        order = helper.help(point->run.scene, point->time_steps, point->run.spec, team, order);
        if (order.kind == quasimc::TeamOrder::kDealt) {
            help_with_dealt(team, stored->runs, order, std::move(point));
            order = team.order({});
        }
    }
    return Exit::done;
}

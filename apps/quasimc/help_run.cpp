#include "help_run.h"

#include <exception>
#include <optional>

#include "part_run.h"
#include "quasimc/quasimc.h"

Exit help_run(const RunArguments& arguments, const quasimc::RunTeam& team) {
    std::optional<quasimc::StoredSweep> stored;
    std::exception_ptr failure;
    try {
        stored.emplace(read_runs(arguments));
    } catch (...) {
        failure = std::current_exception();  // the first rank most likely has it as well
    }
    quasimc::TeamHelper helper;
    quasimc::TeamOrder order = team.order({});
    while (order.is_end == 0) {
        if (failure) {
            std::rethrow_exception(failure);
        }
        const quasimc::RunFile run = stored->runs.take(order.point);
        order = helper.help(run.scene, quasimc::moments_of(run), run.spec, team, order);
    }
    return Exit::done;
}

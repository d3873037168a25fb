#include "sweep_jobs.h"

#include <memory>

std::vector<quasimc::TeamJob> jobs_of_points(
    const quasimc::RunFile& run, std::size_t points, std::size_t first, std::uint64_t ranks) {
    if (run.series) {
        return {};
    }
    std::vector<quasimc::TimeStepPlan> plans(points);
    for (std::size_t i = 0; i < points; ++i) {
        plans[i].traced = i;
    }
    return quasimc::jobs_of_series(plans, run.spec, first, ranks);
}

quasimc::TraceJob point_tracer(quasimc::Simulator& simulator, quasimc::RunSweep& sweep) {
    /// Parts of a point come one after the other.
    struct Taken {
        std::uint64_t point = 0;
        quasimc::RunFile run;
    };
    const auto last = std::make_shared<std::unique_ptr<Taken>>();
    return [&simulator, &sweep, last](
               const quasimc::TeamJob& job, const quasimc::RunControl& control) {
        if (!*last || (*last)->point != job.run) {
            *last = std::make_unique<Taken>(Taken{job.run, sweep.take(job.run)});
        }
        const quasimc::RunFile& run = (*last)->run;
        return quasimc::trace_job(simulator, run.scene, run.sources, run.spec, job, control);
    };
}

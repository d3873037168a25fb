#include "run/round_tracer.h"

#include <cmath>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "base/memory_need.h"
#include "base/process_time.h"
#include "solvers/catalogue.h"

namespace quasimc {
namespace {

/// Sums of no paths yet.
Sums make_sums(const PreparedScene& prepared, const RunSpec& spec) {
    const auto regions = static_cast<double>(prepared.scene().regions().size());
    const auto bins =
        static_cast<double>(2 * (prepared.lights().spectra().size() + prepared.bands()) + 1);
    return make_big(
        fmt::format(
            "the sums of {} regions, {} bands, {} spectra and {} replicates",
            prepared.scene().regions().size(), prepared.bands(), prepared.lights().spectra().size(),
            spec.replicates),
        regions * bins * spec.replicates * sizeof(std::int64_t),
        [&] { return empty_sums(prepared, spec); });
}

}  // namespace

void RoundTracer::make_solver_for(std::uint64_t first_paths) {
    spec_.paths = first_paths;
    solver_ = make_solver({prepared_, sampler_, spec_, executor_.stop()});
}

void RoundTracer::restore(Sums sums, std::uint64_t first_paths) {
    done_ = std::move(sums);
    first_paths_ = first_paths;
    paths_before_ = static_cast<double>(done_->paths);
}

void RoundTracer::add_watcher(Watcher watcher) {
    watchers_.push_back(std::move(watcher));
    executor_.set_pauses(
        {[this] { return ask_watchers(); }, [this](const Pause& pause) { tell_watchers(pause); }});
}

bool RoundTracer::ask_watchers() {
    bool is_due = false;
    for (Watcher& watcher : watchers_) {
        watcher.was_due = watcher.was_due || (watcher.is_due && watcher.is_due());
        is_due = is_due || watcher.was_due;
    }
    return is_due;
}

void RoundTracer::tell_watchers(const Pause& pause) {
    for (Watcher& watcher : watchers_) {
        if (std::exchange(watcher.was_due, false)) {
            watcher.on_pause(pause, *partial_);
        }
    }
}

void RoundTracer::set_team(const RunTeam* team, std::uint64_t moment) {
    team_ = team;
    moment_ = moment;
    executor_.set_team(team != nullptr ? &team->tasks : nullptr);
}

void RoundTracer::order(
    const Round& round, const TaskPosition& tasks, std::uint64_t first_paths) const {
    if (team_ != nullptr) {
        static_cast<void>(team_->order(
            {.point = team_->point,
             .moment = moment_,
             .first_paths = first_paths,
             .round = round,
             .tasks = tasks}));
    }
}

/// @param own  of this process
void RoundTracer::add_cpu_seconds(double own) {
    constexpr double kNano = 1e-9;
    std::vector<std::int64_t> numbers{
        team_->is_first() ? 0 : static_cast<std::int64_t>(std::round(own / kNano))};
    team_->add_up(numbers);
    if (team_->is_first()) {
        cpu_seconds_of_others_ += kNano * static_cast<double>(numbers.front());
    }
}

void RoundTracer::solve(const Round& round, Sums& sums) {
    const Stopwatch watch;
    partial_ = &sums;
    solver_->solve(round, executor_, sums);
    if (team_ != nullptr) {
        add_up(*team_, sums);
        add_cpu_seconds(watch.cpu_seconds());
    }
    partial_ = nullptr;
}

void RoundTracer::trace(const Round& round, std::optional<PartialRound> from) {
    const std::uint64_t first_paths = round.first == 0 ? round.count : first_paths_;
    const TaskPosition tasks = from ? from->tasks : TaskPosition();
    if (round.first == 0 || !solver_) {
        make_solver_for(first_paths);
    }
    executor_.start_at(tasks);
    Sums sums = from               ? std::move(from->sums)
                : round.first == 0 ? make_sums(prepared_, spec_)
                : may_be_stopped_  ? *done_
                                   : std::move(*done_);
    order(round, tasks, first_paths);
    solve(round, sums);
    paths_before_ = round.first == 0 ? 0 : paths_before_;
    if (from) {
        paths_before_ += executor_.part_done_before() * static_cast<double>(round.count);
    }
    done_ = std::move(sums);
    first_paths_ = first_paths;
}

void RoundTracer::help(const TeamOrder& order) {
    if (prepared_.lights().empty()) {
        return;
    }
    if (order.first_paths != first_paths_ || !solver_) {
        first_paths_ = order.first_paths;
        make_solver_for(first_paths_);
    }
    if (order.is_prepare != 0) {
        return;
    }
    executor_.start_at(order.tasks);
    Sums sums = make_sums(prepared_, spec_);
    solve(order.round, sums);
}

}  // namespace quasimc

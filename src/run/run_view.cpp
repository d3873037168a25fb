#include "run/run_view.h"

#include <utility>

#include "run/digest.h"
#include "run/evaluation_of.h"
#include "sums/sum_data.h"

namespace quasimc {
namespace {

/// The result of the sums of an unfinished run.
Result preview_of(const Sums& sums, const RunFacts& facts) {
    Result result = make_result(sums, facts.prepared.scene(), facts.asked);
    result.chosen.method = facts.spec.method;
    return result;
}

RunPosition position_of(
    const RunFacts& facts, const RoundsState& state, std::uint64_t first_paths) {
    return {
        .rounds = state,
        .first_paths = first_paths,
        .asked_paths = facts.spec.paths,
        .target_error = facts.spec.target_error,
        .target_fraction = facts.spec.target_fraction,
        .round = {},
        .tasks = {},
        .digest = facts.digest()};
}

}  // namespace

std::uint64_t RunFacts::digest() const {
    return cached_digest.get([&] { return digest_of(prepared, spec); });
}

Result RunBetweenRounds::result() const {
    return preview_of(sums_, facts_);
}

RunSnapshot RunBetweenRounds::snapshot() const {
    return {position_of(facts_, state_, first_paths_), &sums_, nullptr};
}

void report(
    const RunControl& control,
    void (RunListener::*event)(const RunSoFar& run),
    const RunBetweenRounds& run) {
    for (RunListener* listener : control.listeners) {
        (listener->*event)(run);
    }
}

/// Later rounds add to replicates that are reported already: one of them alone would have fewer
/// paths than all.
std::size_t RunWithinRound::replicates() const {
    const bool is_first = round_.start.round.first == 0;
    return is_first && pause_.last > 0
               ? pause_.done_of_last * round_.sums->replicates.size() / pause_.last
               : 0;
}

Result RunWithinRound::result() const {
    return preview_of(
        first_replicates(round_.sums, replicates(), round_.start.round.count, samples_), facts_);
}

RunSnapshot RunWithinRound::snapshot() const {
    const DoneRounds* done = round_.done;
    RunPosition position = position_of(
        facts_, done != nullptr ? done->state : RoundsState(),
        done != nullptr ? done->first_paths : 0);
    position.round = round_.start.round;
    position.tasks = pause_.done;
    return {position, done != nullptr ? &done->sums : nullptr, &round_.sums};
}

RoundWatch::RoundWatch(
    const RunFacts& facts,
    const std::vector<RunListener*>& listeners,
    const RoundAtHand& round,
    RoundSolver& solver,
    Work work,
    double at_target)
    : facts_(facts), round_(round), solver_(solver), work_(std::move(work)), at_target_(at_target) {
    for (RunListener* listener : listeners) {
        listeners_.push_back({listener});
    }
}

bool RoundWatch::wants_pause() {
    bool is_requested = false;
    for (Listening& each : listeners_) {
        each.waits = each.waits || each.listener->wants_pause();
        is_requested = is_requested || each.waits;
    }
    return is_requested;
}

void RoundWatch::on_pause(const Pause& pause) {
    const std::uint64_t samples =
        solver_.solver_for(round_.start.first_paths).samples_of(round_.start.round);
    const RunWithinRound run(facts_, round_, pause, samples);
    for (Listening& each : listeners_) {
        if (std::exchange(each.waits, false)) {
            each.listener->on_pause(run);
        }
    }
}

}  // namespace quasimc

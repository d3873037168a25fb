#include "run/run_checkpoint.h"

#include <utility>

#include "quasimc/error.h"
#include "run/digest.h"

namespace quasimc {

StateKeeper::StateKeeper(
    const RunControl& control, const PreparedScene& prepared, const RunSpec& spec)
    : checkpoint_(control.checkpoint), moment_(control.moment) {
    if (checkpoint_ == nullptr) {
        return;
    }
    position_.digest = digest_of(prepared, spec);
    stored_ = checkpoint_->state_of(moment_);
    const auto fits = [&](const std::optional<Sums>& sums) {
        return !sums || sums->replicates.size() == spec.replicates;
    };
    if (stored_ && (stored_->position.digest != position_.digest || !fits(stored_->done) ||
                    !fits(stored_->partial))) {
        throw InputError(
            {{"checkpoint", "it is of another run", "scene, sources, options or version differ",
              ""}});
    }
}

void StateKeeper::begin(
    Rounds& rounds, RoundTracer& tracer, const std::function<double()>& at_target) {
    if (checkpoint_ == nullptr) {
        return;
    }
    if (stored_ && stored_->done) {
        tracer.restore(std::move(*stored_->done), stored_->position.first_paths);
        rounds.restore(stored_->position.rounds, at_target());
        stored_->done.reset();
        position_.rounds = rounds.state();
    }
    tracer.set_pauses(checkpoint_->is_due, [&](const TaskPosition& tasks, const Sums& partial) {
        position_.tasks = tasks;
        position_.first_paths = tracer.first_paths();
        const Sums* done = tracer.has_sums() ? &tracer.sums() : nullptr;
        checkpoint_->save(moment_, {position_, done, &partial});
    });
}

std::optional<PartialRound> StateKeeper::begin_round(const Round& round) {
    position_.round = round;
    std::optional<RunState> stored = std::exchange(stored_, std::nullopt);
    if (!stored || !stored->partial || stored->position.round != round) {
        return std::nullopt;
    }
    return PartialRound{stored->position.tasks, std::move(*stored->partial)};
}

void StateKeeper::finish_round(const Rounds& rounds, const RoundTracer& tracer) {
    position_.rounds = rounds.state();
    position_.round = {};
    position_.tasks = {};
    position_.first_paths = tracer.first_paths();
    if (checkpoint_ != nullptr && checkpoint_->is_due()) {
        checkpoint_->save(moment_, {position_, &tracer.sums(), nullptr});
    }
}

void StateKeeper::finish(const RoundTracer& tracer) {
    if (checkpoint_ == nullptr) {
        return;
    }
    position_.round = {};
    position_.tasks = {};
    position_.first_paths = tracer.first_paths();
    checkpoint_->finish(moment_, {position_, &tracer.sums(), nullptr});
}

}  // namespace quasimc

#include "checkpoint_run.h"

#include <cstdio>
#include <string>

CheckpointRun::CheckpointRun(const RunArguments& arguments, const quasimc::RunFile& first) {
    if (arguments.checkpoint.empty()) {
        return;
    }
    file_.emplace(
        arguments.checkpoint, first, arguments.every,
        arguments.resume ? quasimc::CheckpointStart::resume : quasimc::CheckpointStart::anew);
    if (arguments.resume && !file_->was_there() && !arguments.quiet) {
        std::fprintf(
            stderr, "note: %s is not there yet: the run begins anew\n",
            arguments.checkpoint.c_str());
    }
    hooks_.state_of = [this](std::size_t moment) {
        return file_->state_of(moments_before_ + moment);
    };
    hooks_.has_state = [this](std::size_t moment) {
        return file_->has_state(moments_before_ + moment);
    };
    hooks_.is_due = [this] { return faults_.empty() && file_->is_due(); };
    hooks_.save = [this](std::size_t moment, const quasimc::RunSnapshot& state) {
        attempt([&] { file_->save(moments_before_ + moment, state); });
    };
    hooks_.finish = [this](std::size_t moment, const quasimc::RunSnapshot& state) {
        attempt([&] { file_->finish(moments_before_ + moment, state); });
    };
}

template <typename Save>
void CheckpointRun::attempt(const Save& save) {
    if (!faults_.empty()) {
        return;
    }
    try {
        save();
    } catch (const quasimc::InputError& error) {
        faults_.add(error);
        std::fprintf(stderr, "warning: %s\nThe run goes on without a checkpoint.\n", error.what());
    }
}

void CheckpointRun::flush() {
    if (file_) {
        attempt([this] { file_->flush(); });
    }
}

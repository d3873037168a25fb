#include "checkpoint_run.h"

#include <cstdio>
#include <string>

#include <fmt/format.h>

#include "terminal.h"

CheckpointRun::CheckpointRun(const RunArguments& arguments, const quasimc::RunFile& first) {
    if (arguments.checkpoint.empty()) {
        return;
    }
    file_.emplace(
        arguments.checkpoint, first, arguments.checkpoint_interval,
        arguments.resume ? quasimc::CheckpointStart::resume : quasimc::CheckpointStart::anew);
    if (arguments.resume && !file_->was_there() && !arguments.quiet) {
        std::fprintf(
            stderr, "note: %s is not there yet: the run begins anew\n",
            arguments.checkpoint.c_str());
    }
}

std::optional<quasimc::RunState> CheckpointRun::state_of(std::size_t time_step) {
    return file_->state_of(time_steps_before_ + time_step);
}

bool CheckpointRun::has_state(std::size_t time_step) const {
    return file_ && file_->has_state(time_steps_before_ + time_step);
}

bool CheckpointRun::wants_pause() {
    return file_ && faults_.empty() && file_->is_due();
}

void CheckpointRun::on_pause(const quasimc::RunSoFar& run) {
    attempt([&] { file_->save(time_steps_before_ + run.time_step(), run.snapshot()); });
}

void CheckpointRun::on_round(const quasimc::RunSoFar& run) {
    if (wants_pause()) {
        on_pause(run);
    }
}

void CheckpointRun::on_last_round(const quasimc::RunSoFar& run) {
    attempt([&] { file_->finish(time_steps_before_ + run.time_step(), run.snapshot()); });
}

template <typename Save>
void CheckpointRun::attempt(const Save& save) {
    if (!file_ || !faults_.empty()) {
        return;
    }
    try {
        save();
    } catch (const quasimc::InputError& error) {
        faults_.add(error);
        print_warning(fmt::format("{}; the run goes on without a checkpoint", error.what()));
    }
}

void CheckpointRun::flush() {
    attempt([this] { file_->flush(); });
}

#pragma once

#include <cstddef>
#include <optional>

#include "parallel/checkpoint_file.h"
#include "quasimc/run_file.h"
#include "run/run_state.h"
#include "run_writers.h"

/// The checkpoint of a `quasimc run`, if it keeps one.
class CheckpointRun final : public quasimc::RunListener, public quasimc::StoredStates {
  public:
    /// @param first  run of the sweep
    /// @throws quasimc::InputError  if the checkpoint is not one of this run
    CheckpointRun(const RunArguments& arguments, const quasimc::RunFile& first);

    /// Begins a point of the sweep. @param count  time steps of the points before
    void set_time_steps_before(std::size_t count) { time_steps_before_ = count; }
    /// The states to go on from; null without a checkpoint.
    [[nodiscard]] quasimc::StoredStates* states() { return file_ ? this : nullptr; }
    [[nodiscard]] std::optional<quasimc::RunState> state_of(std::size_t time_step) override;
    [[nodiscard]] bool has_state(std::size_t time_step) const;

    [[nodiscard]] bool wants_pause() override;
    void on_pause(const quasimc::RunSoFar& run) override;
    void on_round(const quasimc::RunSoFar& run) override;
    void on_last_round(const quasimc::RunSoFar& run) override;
    [[nodiscard]] bool wants(quasimc::SeriesPart /*part*/) const override { return false; }

    /// Saves the latest state, if it is not saved yet.
    void flush();
    /// @throws quasimc::InputError  if the checkpoint could not be saved: the run went on without
    void throw_if_given_up() const { faults_.throw_if_any(); }

  private:
    /// Saves. If that fails, the run goes on without checkpoints, so that its results are not lost.
    template <typename Save>
    void attempt(const Save& save);

    std::optional<quasimc::CheckpointFile> file_;
    quasimc::Faults faults_;
    std::size_t time_steps_before_ = 0;
};

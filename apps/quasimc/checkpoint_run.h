#pragma once

#include <cstddef>
#include <optional>

#include "parallel/checkpoint_file.h"
#include "quasimc/run_file.h"
#include "run/run_state.h"
#include "run_writers.h"

/// The checkpoint of a `quasimc run`, if it keeps one.
class CheckpointRun {
  public:
    /// @param first  run of the sweep
    /// @throws quasimc::InputError  if the checkpoint is not one of this run
    CheckpointRun(const RunArguments& arguments, const quasimc::RunFile& first);

    /// What follows is of a point of the sweep that so many moments came before.
    void set_moments_before(std::size_t moments) { moments_before_ = moments; }
    /// For the series of the point; null without a checkpoint.
    [[nodiscard]] const quasimc::RunCheckpoint* hooks() const { return file_ ? &hooks_ : nullptr; }
    /// Saves what was not saved yet.
    void flush();
    /// @throws quasimc::InputError  if the checkpoint could not be saved: the run went on without
    void throw_if_given_up() const { faults_.throw_if_any(); }

  private:
    /// Saves, or gives saving up for this run: what it computes is not lost for want of room.
    template <typename Save>
    void attempt(const Save& save);

    std::optional<quasimc::CheckpointFile> file_;
    quasimc::Faults faults_;
    std::size_t moments_before_ = 0;
    quasimc::RunCheckpoint hooks_;
};

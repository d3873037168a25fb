#pragma once

// The state of a run, from which it can resume later, also on another machine.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/executor.h"
#include "quasimc/sums.h"
#include "run/rounds.h"

namespace quasimc {

/// The position of a run, without its sums.
struct RunPosition {
    RoundsState rounds;                            ///< after the completed rounds
    std::uint64_t first_paths = 0;                 ///< of the first round
    std::uint64_t asked_paths = 0;                 ///< RunSpec::paths
    double target_error = 0, target_fraction = 0;  ///< of RunSpec: target of the rounds
    Round round;                                   ///< current round; without paths: none
    TaskPosition tasks;                            ///< its completed tasks
    std::uint64_t digest = 0;                      ///< digest_of() the run
};

/// A state to resume from.
struct RunState {
    RunPosition position;
    std::optional<Sums> done;     ///< sums of the completed rounds, if any
    std::optional<Sums> partial;  ///< including the completed tasks of the current round, if any
};

/// The state of a running run: refers to its data.
struct RunSnapshot {
    RunPosition position;
    const Sums* done = nullptr;
    const Sums* partial = nullptr;
};

/// Stored states of the runs of a series.
class StoredStates {
  public:
    virtual ~StoredStates() = default;
    /// The state from which the run of a time step resumes, if there is one.
    [[nodiscard]] virtual std::optional<RunState> state_of(std::size_t time_step) = 0;

  protected:
    StoredStates() = default;
};

/// A state as bytes, in native byte order. Its sums have checksums of their own.
[[nodiscard]] std::string save_state(const RunSnapshot& state);
/// @throws std::invalid_argument  if the bytes are not a state
[[nodiscard]] RunState load_state(std::string_view bytes);

}  // namespace quasimc

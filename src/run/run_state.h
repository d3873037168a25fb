#pragma once

// How far a run is: what must be kept of it so that it can go on later, on any machine.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/executor.h"
#include "quasimc/sums.h"
#include "run/rounds.h"

namespace quasimc {

/// How far a run is, but for its sums.
struct RunPosition {
    RoundsState rounds;                            ///< after the rounds that are complete
    std::uint64_t first_paths = 0;                 ///< of the first of them
    std::uint64_t asked_paths = 0;                 ///< RunSpec::paths
    double target_error = 0, target_fraction = 0;  ///< of RunSpec: what the rounds were to reach
    Round round;                                   ///< that is being traced; of no paths: none
    TaskPosition tasks;                            ///< of its tasks, those that are done
    std::uint64_t digest = 0;                      ///< of the run: digest_of()
};

/// A state to go on from.
struct RunState {
    RunPosition position;
    std::optional<Sums> done;     ///< of the rounds that are complete, if any are
    std::optional<Sums> partial;  ///< with what is done of the round at hand, if there is one
};

/// The state of a run that goes on: looks at what the run has.
struct RunSnapshot {
    RunPosition position;
    const Sums* done = nullptr;
    const Sums* partial = nullptr;
};

/// States of the runs of a series that were kept.
class StoredStates {
  public:
    virtual ~StoredStates() = default;
    /// The state from which the run of a time step goes on, if there is one.
    [[nodiscard]] virtual std::optional<RunState> state_of(std::size_t time_step) = 0;

  protected:
    StoredStates() = default;
};

/// A state as bytes, of one byte order. The sums in it have checksums of their own.
[[nodiscard]] std::string save_state(const RunSnapshot& state);
/// @throws std::invalid_argument  if these are not the bytes of a state
[[nodiscard]] RunState load_state(std::string_view bytes);

}  // namespace quasimc

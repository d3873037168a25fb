#pragma once

// How far a run is: what must be kept of it so that it can go on later, on any machine.

#include <cstddef>
#include <cstdint>
#include <functional>
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

/// What keeps the states of the runs of a series, and knows them again. All are called from the
/// thread that called run(). A run is known by the number of its moment.
struct RunCheckpoint {
    /// The state to go on from, if there is one.
    std::function<std::optional<RunState>(std::size_t moment)> state_of;
    std::function<bool(std::size_t moment)> has_state;  ///< whether there is one
    std::function<bool()> is_due;  ///< whether it is time to save; asked after every task
    std::function<void(std::size_t moment, const RunSnapshot& state)> save;
    /// The state at the end of a run: no paths are missing.
    std::function<void(std::size_t moment, const RunSnapshot& state)> finish;
};

/// A state as bytes, of one byte order. The sums in it have checksums of their own.
[[nodiscard]] std::string save_state(const RunSnapshot& state);
/// @throws std::invalid_argument  if these are not the bytes of a state
[[nodiscard]] RunState load_state(std::string_view bytes);

}  // namespace quasimc

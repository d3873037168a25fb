#pragma once

#include <functional>
#include <string>
#include <vector>

namespace quasimc::test {

/// A conversation that is played in a process of its own.
struct Case {
    std::string name;
    /// Plays it; throws, with the reason, if it isn't as it should be.
    std::function<void()> play;
};

/// What became of cases.
struct Played {
    std::vector<std::string> failures;  ///< "name: reason"
    double longest_seconds = 0;         ///< of a wait that was measured (measure_wait)
};

/// Plays cases, `most` at a time. Each is a process that adopts what its descendants leave: one
/// that still runs at the end of its case is a failure, and killed.
[[nodiscard]] Played play_at_once(const std::vector<Case>& cases, unsigned most);

/// Runs `wait` in a case; how long it took is what Played::longest_seconds is the longest of.
void measure_wait(const std::function<void()>& wait);

/// Throws std::runtime_error with `reason` unless `good`.
void require(bool good, const std::string& reason);

}  // namespace quasimc::test

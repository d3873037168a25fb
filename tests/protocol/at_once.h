#pragma once

#include <functional>
#include <string>
#include <vector>

namespace quasimc::test {

/// A session that is played in its own process.
struct Case {
    std::string name;
    /// Plays the session; throws with the reason of a failure.
    std::function<void()> play;
};

/// Outcome of cases.
struct Played {
    std::vector<std::string> failures;  ///< "name: reason"
    double longest_seconds = 0;         ///< longest wait in measure_wait()
};

/// Plays cases, `most` at a time. The process of each case adopts orphaned descendants; one that
/// still runs at the end of its case is a failure, and is killed.
[[nodiscard]] Played play_at_once(const std::vector<Case>& cases, unsigned most);

/// Runs `wait` in a case and measures its time for Played::longest_seconds.
void measure_wait(const std::function<void()>& wait);

/// Throws std::runtime_error with `reason` unless `good`.
void require(bool good, const std::string& reason);

}  // namespace quasimc::test

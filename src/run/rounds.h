#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/run.h"
#include "quasimc/run_spec.h"
#include "scene/scene.h"
#include "solvers/solver.h"

namespace quasimc {

/// Predicts the time of a round from previous ones: a constant plus a time per path.
struct CostModel {
    void add(std::uint64_t paths, double seconds);
    /// Predicted time of a round. Requires at least one add().
    [[nodiscard]] double seconds_for(std::uint64_t paths) const;

    struct Timed {
        double paths = 0, seconds = 0;
    };
    Timed last, before;  ///< before: fewer paths; 0 if none
};

/// State of a run between two rounds.
struct RoundsState {
    std::uint64_t done = 0;  ///< paths
    bool is_pilot = false;   ///< whether these are paths of a pilot round
    CostModel cost;
};

/// Limits of rounds, and their beginning.
struct RoundLimits {
    Deadline deadline = {};
    std::uint64_t fewest = 1;  ///< paths of the first pilot round: a power of two
    double fixed_cost = 0;     ///< cost of a round without paths, as a number of paths
    Deadline::Clock::time_point start = Deadline::Clock::now();  ///< of the first round
    bool may_be_stopped = false;  ///< by other means than the deadline
};

/// How far a run is from its target: ErrorsSoFar.
struct TargetDistance {
    double fraction_at_target = 0;
    double ratio_to_target = std::numeric_limits<double>::infinity();
};

/// Decides how many points to trace next: the specification's first, then, while a target or a
/// limit of paths requires more, as many again as before (so that point sets are complete at every
/// stop).
///
/// With a target, a run begins with pilot rounds of few paths. After each it is complete if the
/// target is reached. Otherwise the next has the paths that are probably missing, at most 16 times
/// as many, until these are the specification's (docs/develop/decisions/targets.md).
///
/// With a time limit, the cost of paths is unknown until something was traced. Then a run begins
/// with pilot rounds of few paths, each larger than the last. Once the specification's paths fit
/// into the remaining time, they are traced as if there were no limit; if they never fit, the run
/// continues from the last pilot round (docs/develop/decisions/time-limits.md).
///
/// A run that may be stopped, and whose first round is huge, begins with pilot rounds too: they are
/// the result if it is stopped, and cost at most 2 %.
class Rounds {
  public:
    explicit Rounds(const RunSpec& spec, const RoundLimits& limits = {})
        : spec_(spec), limits_(limits), now_(limits.start) {}

    /// The next round; nothing when the run is complete. A round whose first point is number 0
    /// begins the run, or restarts it with other paths and discards the earlier ones.
    [[nodiscard]] std::optional<Round> next();
    /// Records that a round was traced.
    void finish(Deadline::Clock::time_point now, const TargetDistance& distance);
    /// The state between two rounds.
    [[nodiscard]] const RoundsState& state() const { return state_; }
    /// Continues from a stored state.
    /// @param distance  from the target in that state
    void restore(const RoundsState& state, const TargetDistance& distance) {
        state_ = state;
        distance_ = distance;
    }
    /// Abandons the current round.
    void interrupt(StopReason why) { stop_ = why; }

    [[nodiscard]] StopReason stop() const { return stop_; }
    [[nodiscard]] double at_target() const { return distance_.fraction_at_target; }
    /// Fraction of the known work that was complete before this round, and fraction of this round.
    [[nodiscard]] double fraction_before() const {
        return static_cast<double>(state_.done) / known_paths();
    }
    [[nodiscard]] double share() const { return static_cast<double>(count_) / known_paths(); }

    /// Whether more than the specification's paths may be traced.
    [[nodiscard]] bool asks_for_more() const { return has_target() || spec_.max_paths > 0; }
    [[nodiscard]] bool has_target() const { return spec_.target_error > 0; }

  private:
    [[nodiscard]] bool has_limit() const { return !limits_.deadline.is_never(); }
    [[nodiscard]] double seconds_left() const { return limits_.deadline.seconds_left(now_); }
    [[nodiscard]] bool is_at_target() const {
        return has_target() && distance_.fraction_at_target >= spec_.target_fraction;
    }
    [[nodiscard]] double known_paths() const {
        return static_cast<double>(state_.is_pilot ? spec_.paths : state_.done + count_);
    }
    [[nodiscard]] bool fits(std::uint64_t paths) const;
    [[nodiscard]] bool may_leap_to(std::uint64_t paths) const;
    [[nodiscard]] std::uint64_t first_for_target() const;
    [[nodiscard]] std::uint64_t next_pilot() const;
    [[nodiscard]] std::uint64_t wanted_paths() const;
    [[nodiscard]] bool may_double() const;
    [[nodiscard]] bool is_doubled() const;
    [[nodiscard]] std::uint64_t paths_for_target() const;
    [[nodiscard]] Round begin(std::uint64_t paths);
    [[nodiscard]] std::uint64_t first_paths() const;
    [[nodiscard]] std::optional<Round> after_pilot();
    [[nodiscard]] std::optional<Round> as_many_again();

    const RunSpec& spec_;
    RoundLimits limits_;
    RoundsState state_;
    std::uint64_t count_ = 0;          // paths of the current round
    Deadline::Clock::time_point now_;  // the end of the last round
    TargetDistance distance_;
    StopReason stop_ = StopReason::finished;
};

/// The bands of RunSpec::ratios, which must name bands of the scene.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> ratio_bands(
    const Scene& scene, const RunSpec& spec);

}  // namespace quasimc

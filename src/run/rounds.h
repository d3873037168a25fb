#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/run.h"
#include "quasimc/run_spec.h"
#include "scene/scene.h"
#include "solvers/solver.h"

namespace quasimc {

/// How long rounds have taken, and from that how long others will: so much for each, and so much
/// for each path.
struct CostModel {
    void add(std::uint64_t paths, double seconds);
    /// For a round of so many paths. At least one must have been added.
    [[nodiscard]] double seconds_for(std::uint64_t paths) const;

    struct Timed {
        double paths = 0, seconds = 0;
    };
    Timed last, before;  ///< before: fewer paths; 0 if there is none
};

/// How far the rounds of a run are, between two of them.
struct RoundsState {
    std::uint64_t done = 0;  ///< paths
    bool is_trial = false;   ///< what is done
    CostModel cost;
};

/// When rounds end, and how they begin.
struct RoundLimits {
    Deadline deadline = {};
    std::uint64_t fewest = 1;  ///< paths to begin with if there is a deadline: a power of two
    Deadline::Clock::time_point start = Deadline::Clock::now();  ///< of the first round
    bool may_be_stopped = false;                                 ///< by others than the deadline
};

/// Decides how many points to trace next: the specification's first, then, while a target or a
/// limit of paths asks for more, as many again as before (so that point sets are whole at every
/// stop).
///
/// With a limit of time that is known to be long enough only once something was traced, a run
/// begins with trials of few paths, each larger than the one before. Once the specification's paths
/// fit into what is left, they are traced as if there were no limit; if they never do, the run goes
/// on from the last trial (docs/develop/decisions/time-limits.md).
///
/// A run that somebody may stop, and whose first round is huge, begins with trials as well: they
/// are what is left if it is stopped, and cost 2 % at most.
class Rounds {
  public:
    explicit Rounds(const RunSpec& spec, const RoundLimits& limits = {})
        : spec_(spec), limits_(limits), now_(limits.start) {}

    /// The next round; nothing when the run is over. One whose first point is number 0 begins the
    /// run, or begins it anew with other paths: what was traced before is then left out.
    [[nodiscard]] std::optional<Round> next();
    /// Takes note of the round just traced.
    void finish(Deadline::Clock::time_point now, double fraction_at_target);
    /// Between two rounds.
    [[nodiscard]] const RoundsState& state() const { return state_; }
    /// Goes on where other rounds were.
    /// @param fraction_at_target  of what they have traced
    void restore(const RoundsState& state, double fraction_at_target) {
        state_ = state;
        at_target_ = fraction_at_target;
    }
    /// The round just begun was given up.
    void interrupt(StopReason why) { stop_ = why; }

    [[nodiscard]] StopReason stop() const { return stop_; }
    [[nodiscard]] double at_target() const { return at_target_; }
    /// Share of the work known so far that was done before this round, and that this round is.
    [[nodiscard]] double fraction_before() const {
        return static_cast<double>(state_.done) / static_cast<double>(state_.done + count_);
    }
    [[nodiscard]] double share() const {
        const std::uint64_t known = state_.is_trial ? spec_.paths : state_.done + count_;
        return static_cast<double>(count_) / static_cast<double>(known);
    }

    /// Than the specification's paths.
    [[nodiscard]] bool asks_for_more() const {
        return spec_.target_error > 0 || spec_.max_paths > 0;
    }

  private:
    [[nodiscard]] bool has_limit() const { return !limits_.deadline.is_never(); }
    [[nodiscard]] double seconds_left() const { return limits_.deadline.seconds_left(now_); }
    [[nodiscard]] bool fits(std::uint64_t paths) const;
    [[nodiscard]] bool may_leap() const;
    [[nodiscard]] Round begin(std::uint64_t paths);
    [[nodiscard]] std::uint64_t first_paths() const;
    [[nodiscard]] std::optional<Round> after_trial();
    [[nodiscard]] std::optional<Round> as_many_again();

    const RunSpec& spec_;
    RoundLimits limits_;
    RoundsState state_;
    std::uint64_t count_ = 0;          // paths of the round at hand
    Deadline::Clock::time_point now_;  // the end of the last round
    double at_target_ = 0;
    StopReason stop_ = StopReason::finished;
};

/// The bands of RunSpec::ratios, which must name bands of the scene.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> ratio_bands(
    const Scene& scene, const RunSpec& spec);

}  // namespace quasimc

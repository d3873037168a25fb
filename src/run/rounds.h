#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/run_spec.h"
#include "scene/scene.h"
#include "solvers/solver.h"

namespace quasimc {

/// Decides how many points to trace next: the specification's first, then, while a target or a
/// budget of time or paths asks for more, as many again as before (so that point sets are whole at
/// every stop).
class Rounds {
  public:
    explicit Rounds(const RunSpec& spec) : spec_(spec) {}

    /// The next round; nothing when the run is over.
    [[nodiscard]] std::optional<Round> next();
    /// Takes note of the round just traced.
    /// @param seconds  since the run began
    void finish(double seconds, double fraction_at_target);

    [[nodiscard]] StopReason stop() const { return stop_; }
    [[nodiscard]] double at_target() const { return at_target_; }
    /// Share of the work known so far that was done before this round, and that this round is.
    [[nodiscard]] double fraction_before() const {
        return static_cast<double>(done_) / static_cast<double>(done_ + count_);
    }
    [[nodiscard]] double share() const { return 1 - fraction_before(); }

  private:
    [[nodiscard]] bool has_budget() const {
        return spec_.target_error > 0 || spec_.max_seconds > 0 || spec_.max_paths > 0;
    }

    const RunSpec& spec_;
    std::uint64_t done_ = 0, count_ = 0;
    double seconds_ = 0, at_target_ = 0;
    StopReason stop_ = StopReason::paths_done;
};

/// The bands of RunSpec::ratios, which must name bands of the scene.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> ratio_bands(
    const Scene& scene, const RunSpec& spec);

}  // namespace quasimc

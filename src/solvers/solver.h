#pragma once

#include <cstdint>
#include <stop_token>

#include "base/executor.h"
#include "quasimc/run_spec.h"
#include "quasimc/sums.h"
#include "samplers/sampler.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// Points that a run traces in one call, the same in every replicate.
struct Round {
    std::uint64_t first = 0;  ///< points traced before
    std::uint64_t count = 0;
    friend bool operator==(const Round&, const Round&) = default;
};

/// A way of computing the light on surfaces.
///
/// A solver owns its loop: it may cut a round into blocks (solvers/block_runner.h, as all present
/// ones do), iterate, or hand a million paths to a device at once. State between rounds is its own.
/// How to add one: its file, its test, its page, a row in solvers/catalogue.cpp.
class Solver {
  public:
    virtual ~Solver() = default;
    Solver() = default;
    Solver(const Solver&) = delete;
    Solver& operator=(const Solver&) = delete;

    /// Adds the light of a round to sums of empty_sums(), to every replicate that of its own
    /// points, and the numbers of paths and samples. The bits do not depend on the number of
    /// workers.
    /// @throws InputError  where light is too strong to be summed
    /// @throws StopRequested  if a stop was requested; sums are then of no use
    ///
    /// The tasks of the last call of the round are in the order of replicates: those before
    /// have all light of the round when it is not complete yet.
    virtual void solve(const Round& round, Executor& executor, Sums& sums) = 0;
    /// Number that a round adds to Sums::samples.
    [[nodiscard]] virtual std::uint64_t samples_of(const Round& round) const { return round.count; }
};

/// Inputs of a solver, which outlive it.
struct SolverInput {
    const PreparedScene& prepared;
    const Sampler& sampler;
    const RunSpec& spec;
    /// Checked within blocks, at least several times a second; the token of the executor.
    std::stop_token stop = {};
};

/// Draw::roulette_threshold of a run, for weights that are summed over its bands.
[[nodiscard]] inline double roulette_threshold(const SolverInput& input) {
    return input.spec.roulette_threshold * static_cast<double>(input.prepared.bands());
}

}  // namespace quasimc

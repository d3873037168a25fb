#pragma once

// Computing the light on every organ of a scene.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/run_listener.h"
#include "quasimc/run_spec.h"
#include "quasimc/scene.h"
#include "quasimc/share.h"
#include "quasimc/source.h"
#include "quasimc/sums.h"

namespace quasimc {

class StoredStates;  // src/run/run_state.h
class RunTeam;       // src/run/run_team.h
class SumsSource;    // quasimc/series.h

/// A point in time at which work ends; by default it never does.
class Deadline {
  public:
    using Clock = std::chrono::steady_clock;

    Deadline() = default;
    /// A deadline so many seconds from now.
    /// @param grace  seconds beyond it that the first few paths may take, so that there is a result
    ///        at all; by default a quarter of a second or 3 % of the time
    [[nodiscard]] static Deadline after(double seconds, std::optional<double> grace = {});

    [[nodiscard]] bool is_never() const { return at_ == Clock::time_point::max(); }
    [[nodiscard]] Clock::time_point at() const { return at_; }
    /// When work ends of which there is no result yet.
    [[nodiscard]] Clock::time_point latest() const { return latest_; }
    /// Infinite if it never comes.
    [[nodiscard]] double seconds_left(Clock::time_point now = Clock::now()) const;
    [[nodiscard]] bool is_over() const { return Clock::now() >= at_; }
    /// The deadline of work that may take a part of the time that is left, and for its first few
    /// paths all of it. The share of never is never.
    [[nodiscard]] Deadline share(double part) const;

  private:
    Deadline(Clock::time_point at, Clock::time_point latest) : at_(at), latest_(latest) {}

    Clock::time_point at_ = Clock::time_point::max();
    Clock::time_point latest_ = Clock::time_point::max();
};

/// A piece of work whose progress is reported. Pieces form a tree: the points of a sweep, the times
/// of each (dark ones weigh nothing), the rounds of each, and their tasks.
class Work {
  public:
    Work() = default;
    /// All of some work, which begins now.
    explicit Work(std::vector<RunListener*> listeners);

    /// A part of this work, as fractions of it.
    [[nodiscard]] Work part(double begin, double share) const;
    /// Reports that a fraction of this work is done.
    /// @param at_target  Progress::fraction_at_target
    void report(double fraction, double at_target = 0) const;
    /// Whether this is no part of any work.
    [[nodiscard]] bool is_empty() const { return whole_ == nullptr; }

  private:
    struct Whole;
    std::shared_ptr<Whole> whole_;
    double begin_ = 0, share_ = 1;
};

/// Where sums of runs come from that are not all traced here from the first path on.
struct SumsOrigin {
    SumsSource* given = nullptr;     ///< sums of time steps; asked by run_series() alone
    StoredStates* states = nullptr;  ///< states from which runs go on
    RunTeam* team = nullptr;         ///< processes that trace with this one
    std::size_t point = 0;           ///< of a sweep, by which the team knows the runs
};

/// How a run or a series is reported, and how its caller may end it.
struct RunControl {
    /// A stop that is requested here ends the run within a fraction of a second. Its result is that
    /// of the rounds that were complete (Result::stop).
    std::stop_token stop = {};
    /// By default RunSpec::max_seconds from the beginning.
    Deadline deadline = {};
    std::vector<RunListener*> listeners = {};
    SumsOrigin origin = {};
    /// What is reported as progress; by default the run is all of the work.
    Work work = {};
};

/// Thrown by a run that was stopped before there was a result: not even a few paths were traced.
class Stopped : public std::runtime_error {
  public:
    Stopped(StopReason why, const std::string& words) : std::runtime_error(words), why_(why) {}
    /// time_is_up or interrupted.
    [[nodiscard]] StopReason why() const { return why_; }

  private:
    StopReason why_;
};

/// The result of darkness: nothing anywhere, without an error.
[[nodiscard]] Result dark_result(const Scene& scene, const RunSpec& spec);

/// Computes the light on every organ.
///
/// The same binary, scene, sources and specification give the same bits on any number of threads
/// (but for the times in the result, and unless max_seconds ends the run).
/// @throws InputError  for a specification that can't be run: every fault at once
/// @throws Stopped  if it is stopped, or max_seconds are over, before there is a result
[[nodiscard]] Result run(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const RunControl& control = {});

/// What sums say of each organ, as run() would have reported it: everything but how it was found
/// (Result::chosen, audit, stop, times).
/// @param sums  of Simulator::sums() for this scene
/// @param sources  of the run; without them intervals of direct light are not cut where it can't be
///        more, and Result::canopy of a scene that is not periodic along both axes is left out
[[nodiscard]] Result evaluate_run(
    const Sums& sums, const Scene& scene, const RunSpec& spec, const Sources& sources = {});

/// Adds the faults of a specification (unknown sampler, paths that are no power of two, unknown
/// bands in ratios, ...).
void check_run(const Scene& scene, const Sources& sources, const RunSpec& spec, Faults& faults);

/// Runs one after the other, as growth or the hours of a day ask for: keeps what the next run can
/// use again. The acceleration structure serves as long as triangles, cell and engine stay the same
/// (whatever happens to optics, sources or the specification), the samplers' tables always. A
/// result is bit for bit that of quasimc::run.
class Simulator {
  public:
    Simulator();
    ~Simulator();
    Simulator(Simulator&& other) noexcept;
    Simulator& operator=(Simulator&& other) noexcept;

    /// As quasimc::run. Not for several threads at a time. After a stop it can be used as before.
    /// @throws InputError  for a specification that can't be run: every fault at once
    /// @throws Stopped  if it is stopped, or max_seconds are over, before there is a result
    [[nodiscard]] Result run(
        const Scene& scene,
        const Sources& sources,
        const RunSpec& spec,
        const RunControl& control = {}) &;
    /// The last run: `std::move(simulator).run(...)`. It gives back what rays need of the scene
    /// before there is a result, which needs as much memory. A simulator that runs on builds it
    /// anew.
    [[nodiscard]] Result run(
        const Scene& scene,
        const Sources& sources,
        const RunSpec& spec,
        const RunControl& control = {}) &&;

    /// The sums of one round of RunSpec::paths, or of a share of it, as a value: they can be saved
    /// (save_sums), added to those of other rounds of the same run, and evaluated (evaluate_run).
    /// Their digest is set. Targets and budgets of time or paths are left alone.
    /// @param first  the round's first path: a multiple of the paths; of a point set whose rounds
    ///        are powers of two 0, or as many as the paths
    /// @throws InputError  as run() does. @throws Stopped  if it was stopped
    [[nodiscard]] Sums sums(
        const Scene& scene,
        const Sources& sources,
        const RunSpec& spec,
        std::uint64_t first = 0,
        const Share& share = {},
        const RunControl& control = {});

    /// How often an acceleration structure had to be built.
    [[nodiscard]] std::size_t builds() const;

  private:
    friend struct SimulatorAccess;
    class State;
    std::unique_ptr<State> state_;
};

}  // namespace quasimc

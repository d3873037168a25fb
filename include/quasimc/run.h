#pragma once

// Computing the light on every organ of a scene.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <string>

#include "quasimc/result.h"
#include "quasimc/run_listener.h"
#include "quasimc/run_spec.h"
#include "quasimc/scene.h"
#include "quasimc/share.h"
#include "quasimc/source.h"
#include "quasimc/sums.h"

namespace quasimc {

struct RunCheckpoint;  // src/run/run_state.h
struct RunTeam;        // src/run/run_team.h

/// Who looks on while a run is computed, and wants to see the result as it is so far: after rounds,
/// and within the first after replicates. Nothing of the run depends on it.
struct RunPreview {
    /// Whether somebody looks on now; asked after every task, from the thread that called run().
    std::function<bool()> is_wanted;
    /// @param moment  RunControl::moment
    /// @param so_far  of the paths and replicates (two at least, if there are more) that are done
    std::function<void(std::size_t moment, Result so_far)> on_result;
};

/// What a caller hears of a run, and how it may end it.
struct RunControl {
    std::function<void(const Progress&)> on_progress = {};
    /// A stop that is requested here ends the run within a fraction of a second. Its result is that
    /// of the rounds that were complete (Result::stop).
    std::stop_token stop = {};
    /// Seconds beyond RunSpec::max_seconds that the first few paths may take, so that there is a
    /// result at all; by default a quarter of a second or 3 % of it.
    std::optional<double> grace_seconds = {};
    /// Sums of all paths of this run, put together from shares elsewhere: nothing is traced.
    const Sums* sums = nullptr;
    /// Seconds that a run may still take after such a stop, if none of its rounds was complete: a
    /// few paths are then traced, so that there is a result. 0: there is none (Stopped).
    double seconds_after_stop = 0;
    /// Where the state of the run is kept, and from what it goes on; null: nowhere.
    const RunCheckpoint* checkpoint = nullptr;
    /// Other processes that trace with this one; null: none.
    const RunTeam* team = nullptr;
    std::size_t moment = 0;               ///< the run's number in both, and for those who look on
    const RunPreview* preview = nullptr;  ///< null: nobody looks on
    /// Whether the simulator runs nothing more on this scene: it gives back what rays need of it
    /// before there is a result, which needs as much.
    bool is_last = false;
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
/// @throws Stopped  if max_seconds are over before there is a result
[[nodiscard]] Result run(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec = {},
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
        const RunControl& control = {});

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
    friend class SeasonSuns;
    class State;
    std::unique_ptr<State> state_;
};

}  // namespace quasimc

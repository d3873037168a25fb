#pragma once

// Computing the light on every organ of a scene, or of the scenes of a growing canopy; progress of
// runs.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/run_spec.h"
#include "quasimc/scene.h"
#include "quasimc/share.h"
#include "quasimc/source.h"
#include "quasimc/sums.h"

namespace quasimc {

struct SeriesSum;      // quasimc/series.h
struct SeriesSums;     // quasimc/series.h
struct SeriesSummary;  // quasimc/series.h
struct RunSnapshot;    // src/run/run_state.h

/// The progress of a run.
struct Progress {
    double fraction = 0;            ///< completed fraction of the current plan, 0..1
    double seconds = 0;             ///< elapsed time
    double expected_seconds = 0;    ///< expected total; grows when a target needs more rounds
    double fraction_at_target = 0;  ///< RoundErrors::fraction_at_target of the last round
};

/// The result of one time of a series.
struct TimeStepResult {
    std::size_t time_step = 0;
    const Result& result;
    /// The time step whose computation this result was scaled from; itself if it was computed.
    std::size_t computed = 0;
};

/// A run that is paused between two of its tasks, or between two of its rounds.
class RunSoFar {
  public:
    virtual ~RunSoFar() = default;
    RunSoFar(const RunSoFar&) = delete;
    RunSoFar& operator=(const RunSoFar&) = delete;

    /// Index of the run in its series; 0 for a single run.
    [[nodiscard]] virtual std::size_t time_step() const = 0;
    /// Number of replicates of result(): those that are complete within the first round, none
    /// within later rounds.
    [[nodiscard]] virtual std::size_t replicates() const = 0;
    /// The result of these replicates, at least two. Bit for bit that of a run with the same
    /// numbers of replicates and paths.
    [[nodiscard]] virtual Result result() const = 0;
    /// The state of the run, for a checkpoint.
    [[nodiscard]] virtual RunSnapshot snapshot() const = 0;

  protected:
    RunSoFar() = default;
};

/// Parts of a series that are computed for its listeners, in addition to the runs.
enum class SeriesPart {
    time_steps,  ///< the result of every time, if it isn't that of a run
    days,        ///< the sums over days
    total,       ///< SeriesSummary::total
    sums,        ///< the sums of the total, for arithmetic replicate by replicate
};

/// Receives the events of runs. All functions are called from the thread that called run(), in the
/// order of the list of listeners; each does nothing unless it is overridden. No listener changes
/// a number. A single run reports progress, pauses and rounds; a series reports its times, its days
/// and its end as well.
class RunListener {
  public:
    virtual ~RunListener() = default;

    virtual void on_progress(const Progress& /*progress*/) {}
    /// Whether a pause of the run is requested. It is called after every task, and must be fast.
    [[nodiscard]] virtual bool wants_pause() { return false; }
    /// The pause that wants_pause() requested.
    virtual void on_pause(const RunSoFar& /*run*/) {}
    /// A round of a run is complete, and another follows.
    virtual void on_round(const RunSoFar& /*run*/) {}
    /// All rounds of a run are complete, or its time is up.
    virtual void on_last_round(const RunSoFar& /*run*/) {}
    virtual void on_time_step(const TimeStepResult& /*step*/) {}
    virtual void on_day(std::size_t /*day*/, const SeriesSum& /*sum*/) {}
    virtual void on_sums(const SeriesSums& /*sums*/) {}
    virtual void on_end(const SeriesSummary& /*summary*/) {}

    /// Whether the listener needs a part of a series. A part that no listener needs isn't computed;
    /// without any listener the total is.
    [[nodiscard]] virtual bool wants(SeriesPart /*part*/) const { return true; }

  protected:
    RunListener() = default;
};

class StoredStates;  // src/run/run_state.h
class RunTeam;       // src/run/run_team.h
class SumsSource;    // quasimc/series.h

/// A point in time at which work ends; by default it never does.
class Deadline {
  public:
    using Clock = std::chrono::steady_clock;

    Deadline() = default;
    /// A deadline `seconds` from now.
    /// @param grace  additional seconds for the first few paths, so that there is a result at all;
    ///        by default a quarter of a second or 3 % of the time
    [[nodiscard]] static Deadline after(double seconds, std::optional<double> grace = {});

    [[nodiscard]] bool is_never() const { return at_ == Clock::time_point::max(); }
    [[nodiscard]] Clock::time_point at() const { return at_; }
    /// The end of work that has no result yet.
    [[nodiscard]] Clock::time_point latest() const { return latest_; }
    /// Infinite without a deadline.
    [[nodiscard]] double seconds_left(Clock::time_point now = Clock::now()) const;
    [[nodiscard]] bool is_over() const { return Clock::now() >= at_; }
    /// The deadline of work that may take a fraction of the remaining time, and for its first few
    /// paths all of it. A fraction of never is never.
    [[nodiscard]] Deadline share(double part) const;

  private:
    Deadline(Clock::time_point at, Clock::time_point latest) : at_(at), latest_(latest) {}

    Clock::time_point at_ = Clock::time_point::max();
    Clock::time_point latest_ = Clock::time_point::max();
};

/// A piece of work whose progress is reported. Pieces form a tree: the points of a sweep, their
/// times (with weight 0 at night), their rounds, and their tasks.
class Work {
  public:
    Work() = default;
    /// A complete piece of work, which begins now.
    explicit Work(std::vector<RunListener*> listeners);

    /// A part of this work, as fractions of it.
    [[nodiscard]] Work part(double begin, double share) const;
    /// Reports the completed fraction of this work.
    /// @param at_target  Progress::fraction_at_target
    void report(double fraction, double at_target = 0) const;
    /// Whether this is not part of any work.
    [[nodiscard]] bool is_empty() const { return whole_ == nullptr; }

  private:
    struct Whole;
    std::shared_ptr<Whole> whole_;
    double begin_ = 0, share_ = 1;
};

/// The origin of sums of runs that are not completely traced here.
struct SumsOrigin {
    SumsSource* given = nullptr;     ///< sums of time steps; used only by run_series()
    StoredStates* states = nullptr;  ///< states from which runs go on
    RunTeam* team = nullptr;         ///< processes that trace with this one
    std::size_t point = 0;           ///< point of the sweep, which identifies the runs in the team
};

/// Listeners of a run or a series, and means to stop it.
struct RunControl {
    /// A stop that is requested here ends the run within a fraction of a second. Its result is that
    /// of the completed rounds (Result::stop).
    std::stop_token stop = {};
    /// The end of the run; by default RunSpec::max_seconds from its beginning.
    Deadline deadline = {};
    std::vector<RunListener*> listeners = {};
    SumsOrigin origin = {};
    /// The work of which progress is reported; by default the run alone.
    Work work = {};
};

/// Thrown by a run that was stopped before there was a result, even from a few paths.
class Stopped : public std::runtime_error {
  public:
    Stopped(StopReason why, const std::string& words) : std::runtime_error(words), why_(why) {}
    /// time_limit or interrupted.
    [[nodiscard]] StopReason why() const { return why_; }

  private:
    StopReason why_;
};

/// The result without light: 0 everywhere, without an error.
[[nodiscard]] Result zero_result(const Scene& scene, const RunSpec& spec);

/// Computes the light on every organ.
///
/// The same binary, scene, sources and specification give the same bits on any number of threads
/// (except the times in the result, and unless max_seconds ends the run).
/// @throws InputError  for a specification that can't be run: every fault at once
/// @throws Stopped  if it is stopped, or max_seconds are over, before there is a result
[[nodiscard]] Result run(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec = {},
    const RunControl& control = {});

/// The result of sums, as run() would have computed it, except data of the run itself
/// (Result::chosen, audit, stop, times).
/// @param sums  from Simulator::sums() for this scene
/// @param sources  sources of the run; without them intervals of direct light have no upper bound,
///        and Result::canopy is empty unless the scene is periodic along both axes
[[nodiscard]] Result evaluate_run(
    const Sums& sums, const Scene& scene, const RunSpec& spec, const Sources& sources = {});

/// Adds the faults of a specification (unknown sampler, paths that are no power of two, unknown
/// bands in ratios, ...).
void check_run(const Scene& scene, const Sources& sources, const RunSpec& spec, Faults& faults);

/// Runs that follow each other, such as growth steps or the hours of a day. It reuses the
/// acceleration structure if triangles, cell and accelerator are unchanged (for any optics, sources
/// and specification), and always the samplers' tables. A result is bit for bit that of
/// quasimc::run.
class Simulator {
  public:
    Simulator();
    ~Simulator();
    Simulator(Simulator&& other) noexcept;
    Simulator& operator=(Simulator&& other) noexcept;

    /// Does the same as quasimc::run. Not for several threads at a time. After a stop it can be
    /// used as before.
    /// @throws InputError  for a specification that can't be run: every fault at once
    /// @throws Stopped  if it is stopped, or max_seconds are over, before there is a result
    [[nodiscard]] Result run(
        const Scene& scene,
        const Sources& sources,
        const RunSpec& spec,
        const RunControl& control = {}) &;
    /// The last run: `std::move(simulator).run(...)`. It frees the acceleration structure before
    /// the result is made, which needs as much memory. If the simulator is used again, the
    /// structure is rebuilt.
    [[nodiscard]] Result run(
        const Scene& scene,
        const Sources& sources,
        const RunSpec& spec,
        const RunControl& control = {}) &&;

    /// The sums of one round of RunSpec::paths, or of a share of it, as a value: they can be saved
    /// (save_sums), added to those of other rounds of the same run, and evaluated (evaluate_run).
    /// Their digest is set. Targets and limits of time or paths are ignored.
    /// @param first  the round's first path: a multiple of the paths; for point sets with rounds of
    ///        powers of two 0, or the number of paths
    /// @throws InputError  as run() does. @throws Stopped  if it was stopped
    [[nodiscard]] Sums sums(
        const Scene& scene,
        const Sources& sources,
        const RunSpec& spec,
        std::uint64_t first = 0,
        const Share& share = {},
        const RunControl& control = {});

    /// Number of acceleration structures built.
    [[nodiscard]] std::size_t builds() const;

  private:
    friend struct SimulatorAccess;
    class State;
    std::unique_ptr<State> state_;
};

/// The successive scenes of a growing canopy, and their light. A step's result is bit for bit that
/// of quasimc::run for a scene of the same organs in the same order.
///
/// Data that steps share: the organs, so that a step contains only changes; the scene, if no organ
/// changed; the acceleration structure, if no triangle, period or accelerator changed (for any
/// optics, sources and options); the tables of samplers. If some triangle changed, the scene and
/// the acceleration structure are rebuilt, both in time proportional to all triangles. The slowest
/// part of the former, the search for coplanar overlaps, only tests changed triangles and their
/// neighbours (docs/develop/decisions/growth-steps.md).
class GrowthSession {
  public:
    /// @param frame  bands, materials, ground, cell and all constant parts; its organs, if any,
    ///        come first and can't be changed. Its errors are reported when the scene is built
    explicit GrowthSession(SceneBuilder frame);
    ~GrowthSession();
    GrowthSession(GrowthSession&& other) noexcept;
    GrowthSession& operator=(GrowthSession&& other) noexcept;

    /// Replaces all except the organs of the session: other optics, another ground.
    /// @throws InputError  if one of its organs has the id of an organ of the session; nothing is
    ///         replaced then
    void set_frame(SceneBuilder frame);

    /// Adds organs after the others, all or, if one is rejected, none. The id of an organ without
    /// one is one more than the largest that the session and its frame ever had.
    /// @returns their ids. @throws InputError  if the session or its frame has an organ of such an
    ///          id, or two of these have the same, or SceneBuilder::check_organs() refuses one;
    ///          with all faults at once
    std::vector<std::int64_t> add(std::vector<OrganSpec> organs);
    std::int64_t add(OrganSpec organ);
    /// Replaces the organs of the same ids, all or none. @throws InputError  if the session has not
    /// all of them, one is given twice, or SceneBuilder::check_organs() refuses one
    void change(std::vector<OrganSpec> organs);
    void change(OrganSpec organ);
    /// Removes organs, all or none. @throws InputError  if the session has not all of them, or one
    /// is given twice
    void remove(std::span<const std::int64_t> ids);
    void remove(std::int64_t id);
    /// Whether the session has an organ of this id. Those of the frame do not count.
    [[nodiscard]] bool has(std::int64_t id) const;
    /// Organs of the session: those that were added and not removed, without those of the frame.
    [[nodiscard]] std::size_t size() const;

    /// The scene of this step. @throws InputError  as SceneBuilder::build; the session may be
    ///         mended and used on
    [[nodiscard]] std::shared_ptr<const Scene> scene();
    /// The warnings of lint() for the scene of this step. They are computed at the first call after
    /// a change, in time proportional to all triangles; run() does not need them.
    /// @throws InputError  as scene()
    [[nodiscard]] const std::vector<Warning>& warnings();
    /// The light of this step, as by Simulator::run.
    [[nodiscard]] Result run(
        const Sources& sources, const RunSpec& spec, const RunControl& control = {});

    /// Indices of organs in the scene and in its results, in the order of `ids`.
    /// @throws InputError  if there is no organ with one of the ids
    [[nodiscard]] std::vector<std::size_t> indices_of(std::span<const std::int64_t> ids);

    /// Numbers of scenes and of acceleration structures built.
    [[nodiscard]] std::size_t scene_builds() const;
    [[nodiscard]] std::size_t tree_builds() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace quasimc

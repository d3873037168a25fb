#pragma once

// Computing the light on every organ of a scene, and of the scenes of a growing canopy; what a run
// reports while it is computed.

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
struct SeriesSummary;  // quasimc/series.h
struct RunSnapshot;    // src/run/run_state.h

/// How far a run is.
struct Progress {
    double fraction = 0;            ///< of the current plan, 0..1
    double seconds = 0;             ///< so far
    double expected_seconds = 0;    ///< in all; grows when a target needs more rounds
    double fraction_at_target = 0;  ///< of the organs, after the last round; 0 without a target
};

/// The result of one time of a series.
struct TimeStepResult {
    std::size_t time_step = 0;
    const Result& result;
    /// The time step whose computation this result was scaled from; itself if it was computed.
    std::size_t computed = 0;
};

/// A run that rests between two of its tasks, or between two of its rounds.
class RunSoFar {
  public:
    virtual ~RunSoFar() = default;
    RunSoFar(const RunSoFar&) = delete;
    RunSoFar& operator=(const RunSoFar&) = delete;

    /// Index of the run in its series; 0 for a single run.
    [[nodiscard]] virtual std::size_t time_step() const = 0;
    /// Replicates that result() is made of. Within the first round these are the replicates that
    /// are complete, within later rounds none.
    [[nodiscard]] virtual std::size_t replicates() const = 0;
    /// The result of these replicates, of which there must be two at least. Bit for bit that of a
    /// run of so many replicates and paths.
    [[nodiscard]] virtual Result result() const = 0;
    /// The state of the run, for a checkpoint.
    [[nodiscard]] virtual RunSnapshot snapshot() const = 0;

  protected:
    RunSoFar() = default;
};

/// What a series computes for its listeners beside the runs themselves.
enum class SeriesPart {
    time_steps,  ///< the result of every time, where it isn't that of a run
    days,        ///< the sums over days
    total,       ///< SeriesSummary::total
};

/// Receives the events of runs. All functions are called from the thread that called run(), in the
/// order of the list of listeners; each does nothing unless it is overridden. No listener changes
/// a number. A single run reports progress, pauses and rounds; a series reports its times, its days
/// and its end as well.
class RunListener {
  public:
    virtual ~RunListener() = default;

    virtual void on_progress(const Progress& /*progress*/) {}
    /// Whether a pause of the run is wanted now. It is asked after every task, and must cost next
    /// to nothing.
    [[nodiscard]] virtual bool wants_pause() { return false; }
    /// The pause that wants_pause() asked for.
    virtual void on_pause(const RunSoFar& /*run*/) {}
    /// A round of a run is complete, and another follows.
    virtual void on_round(const RunSoFar& /*run*/) {}
    /// All rounds of a run are complete, or its time is up.
    virtual void on_last_round(const RunSoFar& /*run*/) {}
    virtual void on_time_step(const TimeStepResult& /*step*/) {}
    virtual void on_day(std::size_t /*day*/, const SeriesSum& /*sum*/) {}
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
    /// time_limit or interrupted.
    [[nodiscard]] StopReason why() const { return why_; }

  private:
    StopReason why_;
};

/// The result of no_light_policy: nothing anywhere, without an error.
[[nodiscard]] Result zero_result(const Scene& scene, const RunSpec& spec);

/// Computes the light on every organ.
///
/// The same binary, scene, sources and specification give the same bits on any number of threads
/// (but for the times in the result, and unless max_seconds ends the run).
/// @throws InputError  for a specification that can't be run: every fault at once
/// @throws Stopped  if it is stopped, or max_seconds are over, before there is a result
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
/// use again. The acceleration structure serves as long as triangles, cell and accelerator stay the
/// same (whatever happens to optics, sources or the specification), the samplers' tables always. A
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

/// The scenes of a growing canopy, one after the other, and their light. A step's result is bit for
/// bit that of quasimc::run for a scene of the same organs in the same order.
///
/// What is kept from step to step: the organs, so that a step states what changes alone; the scene,
/// if no organ changed; the acceleration structure, if no triangle, period or accelerator changed,
/// whatever happens to optics, sources and options; the tables of samplers. When some triangle
/// changed, the scene is put together and the acceleration structure is built anew, both in time in
/// proportion to all triangles; what takes longest in the former, the search for triangles that lie
/// on each other, looks at those that changed and what is near them
/// (docs/develop/decisions/growth-steps.md).
class GrowthSession {
  public:
    /// @param frame  bands, materials, ground, cell and all that stays; its organs, if any, come
    ///        first and can't be changed. Its faults are told when the scene is built
    explicit GrowthSession(SceneBuilder frame);
    ~GrowthSession();
    GrowthSession(GrowthSession&& other) noexcept;
    GrowthSession& operator=(GrowthSession&& other) noexcept;

    /// Replaces what is not an organ of the session: other optics, another ground.
    /// @throws InputError  if one of its organs has the id of an organ of the session; nothing is
    ///         replaced then
    void set_frame(SceneBuilder frame);

    /// Adds organs behind the others, all or, if one is refused, none. Without an id an organ gets
    /// one more than the largest that the session and its frame ever had.
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
    /// is stated twice
    void remove(std::span<const std::int64_t> ids);
    void remove(std::int64_t id);
    /// Whether the session has an organ of this id. Those of the frame do not count.
    [[nodiscard]] bool has(std::int64_t id) const;
    /// Organs of the session: those that were added and not removed, without those of the frame.
    [[nodiscard]] std::size_t size() const;

    /// The scene of this step. @throws InputError  as SceneBuilder::build; the session may be
    ///         mended and used on
    [[nodiscard]] std::shared_ptr<const Scene> scene();
    /// What lint() says of the scene of this step. Looked for when it is first asked for after a
    /// change, in time in proportion to all triangles; run() does not ask.
    /// @throws InputError  as scene()
    [[nodiscard]] const std::vector<Warning>& warnings();
    /// The light of this step; as Simulator::run.
    [[nodiscard]] Result run(
        const Sources& sources, const RunSpec& spec, const RunControl& control = {});

    /// Where organs stand in the scene and in its results, in the order asked.
    /// @throws InputError  if one is not there
    [[nodiscard]] std::vector<std::size_t> indices_of(std::span<const std::int64_t> ids);

    /// How often a scene, and how often an acceleration structure, had to be made.
    [[nodiscard]] std::size_t scene_builds() const;
    [[nodiscard]] std::size_t tree_builds() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace quasimc

#pragma once

// Computing the light of many moments, and its sums over days.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "quasimc/run.h"

namespace quasimc {

/// One of the times of a series: an instant, or an hour for which it stands.
struct TimeStep {
    std::string name;  ///< for messages
    Sources sources;   ///< none: it is dark
    /// Tells the shapes of the sources: moments with equal texts have the same sources in the same
    /// order, but for their spectra.
    std::string shapes;
    double seconds = 0;   ///< that it stands for; 0: an instant, which counts for no sum
    std::size_t day = 0;  ///< that it belongs to; not before that of the moment before
};

/// Light summed over the moments of a day, or of all days: irradiance unit x s, and flux x s.
struct SeriesSum {
    std::size_t bands = 0;
    double seconds = 0;  ///< of the moments summed
    /// As in Result. The errors of moments are independent, but for those that share one trace.
    std::vector<Estimate> values;
    /// The same of groups of organs, without what is sunlit and without ratios.
    GroupResults groups = {};

    [[nodiscard]] Estimate at(std::size_t organ, Quantity q, std::size_t band) const {
        return values[(organ * kQuantities + static_cast<std::size_t>(q)) * bands + band];
    }
};

/// Sums of the paths of a run, traced elsewhere.
struct GivenSums {
    Sums sums;
    double seconds = 0, cpu_seconds = 0;  ///< that tracing them has taken; 0: unknown
};

/// Gives sums of runs that are not traced here.
class SumsSource {
  public:
    virtual ~SumsSource() = default;
    /// The sums of a time step of a series, or nothing: it is traced here. It is asked in the order
    /// of time steps.
    /// @param spec, control  of the run
    [[nodiscard]] virtual std::optional<GivenSums> sums_of(
        std::size_t time_step, const RunSpec& spec, const RunControl& control) = 0;

  protected:
    SumsSource() = default;
};

/// What is known of a series at its end.
struct SeriesSummary {
    SeriesSum total;           ///< over all days, if it was wanted
    std::size_t computed = 0;  ///< moments that were traced; the others are dark or scaled
    /// By which methods, and how many moments by each.
    std::map<Method, std::size_t> methods;
    /// Of those, moments at which no light reaches the scene although some source shines.
    std::size_t unlit = 0;
    std::size_t at_target = 0;  ///< of those, moments that reached the target error, if one was set
    std::size_t completed =
        0;  ///< moments that were told of; fewer than there are if it was stopped
    std::size_t with_fewer_paths =
        0;  ///< of those traced: with fewer paths than asked for, for want of time
    /// finished; or why not all moments and paths were done: time_limit or interrupted.
    StopReason stop = StopReason::finished;
    std::size_t audited = 0;  ///< of those, how many were audited
    /// Of the most unlikely audit, times their number (Audit::p_value); at most 1.
    double audit_p_value = 1;
    std::uint64_t rays = 0;
    double seconds = 0;              ///< wall
    double preparation_seconds = 0;  ///< of these: scenes and lights were prepared
    double solve_seconds = 0;        ///< of these: light was traced
    double solve_cpu_seconds = 0;    ///< all threads
};

/// Which moment's trace serves a moment, and the factor on its light.
struct TimeStepPlan {
    std::size_t traced = 0;
    double factor = 1;  ///< 0: dark
    // Of a moment that is traced:
    double path_factor = 1;  ///< on RunSpec::paths: a power of two
    double target = 1;       ///< on RunSpec::target_error
};
/// Finds the moments whose sources have equal shapes and proportional spectra: of those only the
/// first is traced.
[[nodiscard]] std::vector<TimeStepPlan> plan_series(const std::vector<TimeStep>& time_steps);

/// Shares out the paths of a series by days (PathAllocation::proportional): the paths of a trace
/// are in proportion to the light that its moments bring to the sum of a day, where they bring
/// most, and as many in all as if each trace had `paths`, to a factor of sqrt(2). The targets are
/// such that the sum of a day has the target error. What brings next to nothing has a 64th of the
/// paths.
void allocate_paths(
    const Scene& scene, const std::vector<TimeStep>& time_steps, std::vector<TimeStepPlan>& plans);

/// The same light times a factor.
[[nodiscard]] Result scaled(const Result& result, double factor);

/// Computes the light of every moment, in their order, and its sums over days. Each trace has a
/// seed of its own, made from that of the specification; the first has that seed itself.
///
/// The deadline is for all of them together: each trace may take its equal share of what is
/// left, and does with fewer paths if it must. A series that is stopped, or whose time is up, ends
/// after the last moment that is complete; one that is stopped within the first round of its first
/// moment may take a second more to trace a few paths of it. A day of which moments are missing is
/// not told of; the total is of the moments that are there.
/// @throws InputError  as run() does
/// @throws Stopped  if there is no moment at all
SeriesSummary run_series(
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const RunSpec& spec,
    const RunControl& control = {});
/// The same on what a simulator keeps from one series to the next.
SeriesSummary run_series(
    Simulator& simulator,
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const RunSpec& spec,
    const RunControl& control = {});
/// The last series of a simulator: as its last run.
SeriesSummary run_series(
    Simulator&& simulator,
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const RunSpec& spec,
    const RunControl& control = {});

/// Adds the faults of a specification whose times are to be computed together
/// (TimeMethod::daylight_coefficients): of sources, detectors and options that this can't do. None
/// of other specifications.
void check_together(
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const RunSpec& spec,
    Faults& faults);

/// Traces a share of every moment of a series that run_series would trace.
/// @param on_sums  is told of the sums of each, in the order of moments
/// @throws InputError  as run_series(), and for a specification whose end a share can't know: with
///         a target, or limits of time or paths
/// @throws Stopped  if it was stopped
void trace_share(
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const RunSpec& spec,
    const Share& share,
    const std::function<void(std::size_t time_step, const Sums& sums)>& on_sums,
    const RunControl& control = {});

}  // namespace quasimc

#pragma once

// Computing the light of many time steps, and its sums over days.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "quasimc/run.h"

namespace quasimc {

/// One of the times of a series: an instant, or an hour that it represents.
struct TimeStep {
    std::string name;  ///< for messages
    Sources sources;   ///< none: night
    /// Key of the directional distributions of the sources: time steps with equal keys have the
    /// same sources in the same order, except for their spectra.
    std::string directional_key;
    double seconds = 0;   ///< duration; 0: an instant, which is in no sum
    std::size_t day = 0;  ///< index of its day; not less than that of the previous time step
};

struct OriginSum;

/// Light summed over the time steps of a day, or of all days: irradiance unit x s, and flux x s.
struct SeriesSum {
    std::size_t bands = 0;
    double seconds = 0;  ///< total duration of the time steps
    /// Estimates, as in Result. The errors of time steps are independent, except those scaled from
    /// the same computation.
    std::vector<Estimate> values;
    /// Sums of groups of organs, without ratios. With RunSpec::sun_shade: sunlit fractions x hours,
    /// and sunlit areas x hours.
    GroupResults groups = {};
    /// With RunSpec::sun_shade: sunlit fractions of organs or sensors x hours; and the light of
    /// parts of organs. There, direct light is summed, fractions are multiplied by hours, and light
    /// per sunlit or shaded area is its mean over area and time.
    std::vector<Estimate> sunlit_hours = {};
    SunShadeLight sun_shade = {};
    /// As Result::canopy: flux x s on the horizontal, and fractions that are quotients of sums.
    std::vector<CanopyFractions> canopy = {};
    std::vector<OriginSum> origins;  ///< each origin alone, as Result::origins
    /// The light on sensors, as Result::sensors; null without sensors.
    std::shared_ptr<const SeriesSum> sensors = {};
    /// Whether the light is in the units of files: mol m-2, J m-2.
    bool has_file_units = false;

    [[nodiscard]] Estimate at(std::size_t organ, Quantity q, std::size_t band) const {
        return values[(organ * kQuantities + static_cast<std::size_t>(q)) * bands + band];
    }
};

/// The part of a sum that came from an origin.
struct OriginSum {
    std::string name;
    SeriesSum light;  ///< without origins
};

/// Sums of a computation of a series, whose light is a part of that of all time steps. Time steps
/// without light have none. Computations have different random numbers; so have replicates.
struct SeriesSums {
    /// Number of `origin` for the light of all origins.
    static constexpr auto kAllLight = static_cast<std::size_t>(-1);

    const Sums& sums;                ///< sums of all light, or of one origin
    const Scene& scene;              ///< their scene; of sensors: its last organs are the sensors
    const EvaluationSpec& spec;      ///< how they are evaluated
    double seconds = 0;              ///< factor on their light in SeriesSummary::total
    std::size_t origin = kAllLight;  ///< index in RunSpec::origins
    bool of_sensors = false;
    /// Duration of the time steps with this light; 0 with TimeMethod::daylight_coefficients.
    double duration = 0;
};

/// Sums of the paths of a run, traced elsewhere.
struct GivenSums {
    Sums sums;
    double seconds = 0, cpu_seconds = 0;  ///< time of their computation; 0: unknown
};

/// A source of sums of runs that are computed elsewhere.
class SumsSource {
  public:
    virtual ~SumsSource() = default;
    /// The sums of a time step of a series; none: it is computed here. It is called in the order of
    /// time steps.
    /// @param spec, control  those of the run
    [[nodiscard]] virtual std::optional<GivenSums> sums_of(
        std::size_t time_step, const RunSpec& spec, const RunControl& control) = 0;

  protected:
    SumsSource() = default;
};

/// The summary of a series.
struct SeriesSummary {
    SeriesSum total;           ///< over all days, if requested
    std::size_t computed = 0;  ///< number of time steps computed; the others are night or scaled
    /// Number of these time steps by method.
    std::map<Method, std::size_t> methods;
    /// Number of them in which no light reaches the scene although some source shines.
    std::size_t unlit = 0;
    std::size_t at_target = 0;  ///< number of them that reached the target error, if one was set
    std::size_t completed =
        0;  ///< number of time steps reported; fewer than all if the series was stopped
    std::size_t with_fewer_paths =
        0;  ///< number of computed time steps with fewer paths than requested, for lack of time
    std::size_t without_sensors = 0;  ///< number of them that were stopped before their sensors
    /// finished; or the reason for missing time steps or paths: time_limit or interrupted.
    StopReason stop = StopReason::finished;
    std::size_t audited = 0;  ///< number of computed time steps that were audited
    /// Smallest p-value of an audit times their number (Audit::p_value); at most 1.
    double audit_p_value = 1;
    std::uint64_t rays = 0;
    double seconds = 0;              ///< wall
    double preparation_seconds = 0;  ///< part of it: preparation of scenes and lights
    double solve_seconds = 0;        ///< part of it: computation of light
    double solve_cpu_seconds = 0;    ///< all threads
};

/// The time step from whose computation another one is scaled, and the factor on its light.
struct TimeStepPlan {
    std::size_t traced = 0;
    double factor = 1;  ///< 0: night
    // For a time step that is computed:
    double path_factor = 1;  ///< factor on RunSpec::paths: a power of two
    double target = 1;       ///< factor on RunSpec::target_error
};
/// Finds time steps with equal directional keys and proportional spectra: only the first of them is
/// computed.
[[nodiscard]] std::vector<TimeStepPlan> plan_series(const std::vector<TimeStep>& time_steps);

/// Allocates the paths of a series by days (PathAllocation::proportional). The paths of a
/// computation are proportional to the largest contribution of its time steps to the sum of a day.
/// Their total is that of `paths` for each computation, to a factor of sqrt(2). The targets are
/// such that the sum of a day has the target error. Time steps with negligible contributions have a
/// 64th of the paths.
void allocate_paths(
    const Scene& scene, const std::vector<TimeStep>& time_steps, std::vector<TimeStepPlan>& plans);

/// The light of a result times a factor.
[[nodiscard]] Result scaled(const Result& result, double factor);

/// Computes the light of every time step, in their order, and its sums over days. Each computation
/// has a seed of its own, derived from that of the specification; the first has that seed itself.
///
/// The deadline is for all of them together: each computation may take an equal share of the
/// remaining time, if necessary with fewer paths. A series that is stopped, or reaches its time
/// limit, ends after the last complete time step. One that is stopped within the first round of its
/// first time step may take a second more to trace a few paths of it. A day with missing time steps
/// is not reported; the total covers the complete time steps.
/// @throws InputError  as run() does
/// @throws Stopped  if no time step is complete
SeriesSummary run_series(
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const RunSpec& spec,
    const RunControl& control = {});
/// Computes a series with data that a simulator keeps from previous ones.
SeriesSummary run_series(
    Simulator& simulator,
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const RunSpec& spec,
    const RunControl& control = {});
/// Computes the last series of a simulator, as its last run.
SeriesSummary run_series(
    Simulator&& simulator,
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const RunSpec& spec,
    const RunControl& control = {});

/// Adds the faults of a specification with TimeMethod::daylight_coefficients: sources, detectors
/// and options that it does not support. Adds none for other specifications.
void check_together(
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const RunSpec& spec,
    Faults& faults);

/// Computes a share of every time step of a series that run_series would compute.
/// @param on_sums  receives the sums of each, in the order of time steps
/// @throws InputError  as run_series(), and for a specification with a target, or limits of time or
///         paths, which a share can't evaluate
/// @throws Stopped  if it was stopped
void trace_share(
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const RunSpec& spec,
    const Share& share,
    const std::function<void(std::size_t time_step, const Sums& sums)>& on_sums,
    const RunControl& control = {});

}  // namespace quasimc

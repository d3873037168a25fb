// A series: the light of many time steps on one scene.
//
// Time steps whose light differs by a factor share a trace. A result is released when no later time
// step needs it and its sums are complete, so that a season takes no more memory than a day.

#include "quasimc/series.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/process_time.h"
#include "light/source_origins.h"
#include "results/evaluate.h"
#include "results/flows.h"
#include "results/groups.h"
#include "run/run_control.h"
#include "run/simulator.h"
#include "scene/sensors.h"
#include "series/basis/season.h"
#include "series/series_sum.h"
#include "series/trace_spec.h"
#include "sums/origin_sums.h"
#include "sums/sum_data.h"

namespace quasimc {
namespace {

/// @throws InputError  if time steps are not in the order of their days
void check_order(const std::vector<TimeStep>& time_steps) {
    Faults faults;
    for (std::size_t i = 1; i < time_steps.size(); ++i) {
        const TimeStep& before = time_steps[i - 1];
        const TimeStep& own = time_steps[i];
        if (own.day < before.day) {
            faults.add(
                {own.name.empty() ? fmt::format("time {}", i + 1) : own.name,
                 fmt::format("it belongs to day {}, but follows day {}", own.day, before.day),
                 "a daily sum is formed after its last time step", "sort the time steps by day"});
        }
    }
    faults.throw_if_any();
}

void require_origins(const SeriesInput& input) {
    Faults faults;
    if (!input.spec.origins.empty()) {
        check_origins(sources_of(input.time_steps), input.spec.origins, faults);
    }
    faults.throw_if_any();
}

/// Computes a series, one time step after the other.
class SeriesRun final : public SeriesSteps {
  public:
    explicit SeriesRun(const SeriesInput& input)
        : in_(input), plans_(plan_traces(in_.scene, in_.time_steps, in_.spec)) {
        groups_.groups = make_groups(in_.scene, group_spec(in_.spec));
        groups_.bands = in_.scene.bands().size();
        groups_.values.resize(groups_.groups.size() * kQuantities * groups_.bands);
        for (std::size_t i = 0; i < in_.time_steps.size(); ++i) {
            if (plans_[i].factor > 0 && plans_[i].traced == i) {
                path_factors_left_ += plans_[i].path_factor;
                ++traces_left_;
            }
            if (plans_[i].factor > 0) {
                last_traced_ = std::max(last_traced_, plans_[i].traced);
                last_use_[plans_[i].traced] = i;
                seconds_[plans_[i].traced] += plans_[i].factor * in_.time_steps[i].seconds;
                durations_[plans_[i].traced] += in_.time_steps[i].seconds;
            }
        }
        path_factors_ = path_factors_left_;
        day_ = total_ = no_light();
    }

    SeriesSummary run() {
        walk_series(in_, *this, summary_);
        if (summary_.completed < in_.time_steps.size()) {
            add_to_total(in_.time_steps.size());
        }
        if (wants_total_) {
            summary_.total = sum_of(total_);
        }
        summary_.seconds = watch_.seconds();
        const auto audits = static_cast<double>(std::max<std::size_t>(summary_.audited, 1));
        summary_.audit_p_value = std::min(1.0, least_chance_ * audits);
        return std::move(summary_);
    }

  private:
    /// A trace that is still needed, and its weights in sums.
    struct CachedTrace {
        Result result;
        double day_weight = 0, total_weight = 0;
        double day_seconds = 0, total_seconds = 0;
    };

    void compute(std::size_t i) override {
        const bool needs_trace = plans_[i].factor > 0 && plans_[i].traced == i;
        const bool is_stopped = in_.control.stop.stop_requested();
        if (i > 0 && (is_stopped || (needs_trace && deadline_.is_over()))) {
            throw Stopped(is_stopped ? StopReason::interrupted : StopReason::time_limit, "");
        }
        trace(i);
    }

    void trace(std::size_t i) {
        const TimeStepPlan& plan = plans_[i];
        if (plan.traced == i && plan.factor > 0) {
            cached_[i].result = trace_one(i);
        }
        const TimeStep& time_step = in_.time_steps[i];
        day_.add_seconds(time_step.seconds);
        total_.add_seconds(time_step.seconds);
        if (plan.factor == 0) {
            if (!dark_) {
                dark_ = zero_result(in_.scene, in_.spec);
            }
            report_time_step(in_.control, {i, *dark_, i});
            return;
        }
        CachedTrace& cached = cached_[plan.traced];
        cached.day_weight += plan.factor * time_step.seconds;
        cached.total_weight += plan.factor * time_step.seconds;
        cached.day_seconds += time_step.seconds;
        cached.total_seconds += time_step.seconds;
        if (plan.traced == i) {
            report_time_step(in_.control, {i, cached.result, i});
        } else if (is_requested(SeriesPart::time_steps, in_.control)) {
            report_time_step(in_.control, {i, scaled(cached.result, plan.factor), plan.traced});
        }
    }

    /// A trace takes time for its paths, in proportion to its path factor, and for its preparation,
    /// like every other. Time steps without light take none. The first paths of a trace may take
    /// all of the remaining time.
    [[nodiscard]] RunControl control_of(const TimeStepPlan& plan) const {
        const bool is_only = in_.time_steps.size() == 1;
        return {
            .stop = in_.control.stop,
            .deadline = is_only
                            ? deadline_
                            : deadline_.share(
                                  (plan.path_factor + 1) /
                                  (std::max(plan.path_factor, path_factors_left_) + traces_left_)),
            .listeners = in_.control.listeners,
            .origin = in_.control.origin,
            .work = work_.part(
                (path_factors_ - path_factors_left_) / path_factors_,
                plan.path_factor / path_factors_)};
    }

    Result trace_one(std::size_t i) {
        const RunSpec spec = trace_spec(in_.spec, plans_[i], summary_.computed);
        Result result = run_one(i, spec, control_of(plans_[i]));
        path_factors_left_ -= plans_[i].path_factor;
        --traces_left_;
        ++summary_.computed;
        if (result.stop == StopReason::time_limit || result.stop == StopReason::interrupted) {
            ++summary_.with_fewer_paths;
            end_series(result.stop, summary_);
        }
        summary_.without_sensors += !in_.scene.sensors().empty() && !result.sensors ? 1 : 0;
        ++summary_.methods[result.chosen.method];
        const bool is_unlit = result.stop == StopReason::no_light;
        summary_.unlit += is_unlit ? 1 : 0;
        summary_.at_target += is_unlit || result.stop == StopReason::target_reached ? 1 : 0;
        summary_.rays += result.rays;
        summary_.preparation_seconds += result.preparation_seconds;
        summary_.solve_seconds += result.solve_seconds;
        summary_.solve_cpu_seconds += result.solve_cpu_seconds;
        if (result.audit) {
            ++summary_.audited;
            least_chance_ = std::min(least_chance_, result.audit->p_value);
        }
        return result;
    }

    [[nodiscard]] std::function<void(const RunSums&)> sums_listener(std::size_t i) const {
        return !is_requested(SeriesPart::sums, in_.control)
                   ? nullptr
                   : std::function([this, i](const RunSums& run) { report(i, run); });
    }

    /// Reports the sums of a computation, those of each origin apart.
    void report(std::size_t i, const RunSums& run) const {
        const auto send = [&](const Sums& sums, const EvaluationSpec& spec, std::size_t origin) {
            report_sums(
                in_.control,
                {sums, run.scene, spec, seconds_.at(i), origin, run.of_sensors, durations_.at(i)});
        };
        const std::size_t origins = run.sums->origins.size();
        if (origins == 0) {
            send(run.sums, run.spec, SeriesSums::kAllLight);
            return;
        }
        send(of_all_origins(run.sums), run.spec, SeriesSums::kAllLight);
        for (std::size_t origin = 0; origin < origins; ++origin) {
            send(of_origin(run.sums, origin), evaluation_of_origin(run.spec, origin), origin);
        }
    }

    /// The run of a time step. One that is stopped before it has a result has taken time as well.
    Result run_one(std::size_t i, const RunSpec& spec, RunControl control) {
        const Stopwatch watch;
        try {
            // Without any time there would be no result.
            constexpr double kForFirst = 1;
            std::optional<GivenSums> given;
            if (control.origin.given != nullptr) {
                given = control.origin.given->sums_of(i, spec, control);
            }
            if (given) {
                control.origin.team = nullptr;
            }
            Result result = SimulatorAccess::state(in_.simulator)
                                .run(
                                    in_.scene, in_.time_steps[i].sources, spec, control,
                                    {.time_step = i,
                                     .seconds_after_stop = i == 0 ? kForFirst : 0,
                                     .given = given ? &given->sums : nullptr,
                                     .is_last = in_.is_last && i == last_traced_,
                                     .on_sums = sums_listener(i)});
            if (given) {
                result.solve_seconds += given->seconds;
                result.solve_cpu_seconds += given->cpu_seconds;
            }
            return result;
        } catch (const Stopped&) {
            summary_.solve_seconds += watch.seconds();
            summary_.solve_cpu_seconds += watch.cpu_seconds();
            throw;
        }
    }

    [[nodiscard]] SeriesAdder no_light() const {
        SeriesAdder adder(in_.spec.origins);
        if (in_.spec.sun_shade == SunShade::apart) {
            adder.add_parts(
                in_.scene.organs().size(), groups_.groups.size(), sensor_rows(in_.scene),
                groups_.bands);
        }
        return adder;
    }

    [[nodiscard]] SeriesSum sum_of(const SeriesAdder& adder) const {
        const std::size_t bands = in_.scene.bands().size();
        return adder.sum(
            bands, in_.scene.organs().size() * kQuantities * bands, groups_,
            sensor_rows(in_.scene) * kQuantities * bands);
    }

    void finish_day(std::size_t last) override {
        for (auto& [i, cached] : cached_) {
            if (wants_days_ && cached.day_weight > 0) {
                day_.add(cached.result, cached.day_weight, cached.day_seconds);
                cached.day_weight = cached.day_seconds = 0;
            }
        }
        add_to_total(last);
        if (wants_days_) {
            report_day(in_.control, in_.time_steps[last].day, sum_of(day_));
        }
        day_ = no_light();
    }

    /// Releases the traces that no time step after `last` needs, once they are in the total.
    void add_to_total(std::size_t last) {
        for (auto it = cached_.begin(); it != cached_.end();) {
            const CachedTrace& cached = it->second;
            const bool is_needed = last_use_[it->first] > last;
            if (wants_total_ && !is_needed && cached.total_weight > 0) {
                total_.add(cached.result, cached.total_weight, cached.total_seconds);
            }
            it = is_needed ? std::next(it) : cached_.erase(it);
        }
    }

    const SeriesInput& in_;
    Stopwatch watch_;
    Deadline deadline_ = deadline_of(in_.control, in_.spec);
    Work work_ = work_of(in_.control);
    bool wants_days_ = is_requested(SeriesPart::days, in_.control);
    bool wants_total_ = is_requested(SeriesPart::total, in_.control);
    std::vector<TimeStepPlan> plans_;
    std::size_t last_traced_ = 0;
    std::map<std::size_t, std::size_t> last_use_;  // of a trace, by the computed time step
    std::map<std::size_t, double> seconds_;        // of the light of a trace in the total
    std::map<std::size_t, double> durations_;      // of its time steps
    std::map<std::size_t, CachedTrace> cached_;
    GroupResults groups_;  // for NoLightPolicy
    SeriesAdder day_, total_;
    std::optional<Result> dark_;    // made when it is first needed
    double least_chance_ = 1;       // over all audits
    double path_factors_ = 0;       // sum over all traces
    double path_factors_left_ = 0;  // sum over the remaining traces
    double traces_left_ = 0;
    SeriesSummary summary_;
};

SeriesSummary run_any(const SeriesInput& given) {
    check_order(given.time_steps);
    require_origins(given);
    const RunSpec spec = with_origins_of_all(given.spec, given.time_steps);
    const SeriesInput input{given.simulator, given.scene,  given.time_steps, spec,
                            given.control,   given.is_last};
    SeriesSummary summary = input.spec.time_method == TimeMethod::daylight_coefficients
                                ? run_season(input)
                                : SeriesRun(input).run();
    for (RunListener* listener : input.control.listeners) {
        listener->on_end(summary);
    }
    return summary;
}

}  // namespace

SeriesSummary run_series(
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const RunSpec& spec,
    const RunControl& control) {
    return run_series(Simulator(), scene, time_steps, spec, control);
}

SeriesSummary run_series(
    Simulator& simulator,
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const RunSpec& spec,
    const RunControl& control) {
    return run_any({simulator, scene, time_steps, spec, control});
}

SeriesSummary run_series(
    Simulator&& simulator,
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const RunSpec& spec,
    const RunControl& control) {
    return run_any({simulator, scene, time_steps, spec, control, true});
}

}  // namespace quasimc

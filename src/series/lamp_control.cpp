// Lamps under control: the light at their sensors, and the factors that follow from it.

#include "quasimc/lamp_control.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>

#include "light/source_origins.h"
#include "quasimc/series.h"
#include "run/simulator.h"
#include "samplers/hash.h"
#include "scene/sensors.h"
#include "series/control_rules.h"
#include "series/time_sums.h"
#include "series/trace_spec.h"

namespace quasimc {
namespace {

constexpr double kHour = 3600;

/// The parts of light: daylight, lamps without a control, and the lamps of each control.
constexpr std::size_t kDaylight = 0, kOtherLamps = 1, kControlled = 2;

std::size_t part_of(const Source& source, const std::vector<LampControl>& controls_of_all) {
    if (!source.is_lamp()) {
        return kDaylight;
    }
    const auto found = std::ranges::find_if(
        controls_of_all, [&](const LampControl& control) { return controls(control, source); });
    return found == controls_of_all.end()
               ? kOtherLamps
               : kControlled + static_cast<std::size_t>(found - controls_of_all.begin());
}

double sum_of(std::span<const double> spectrum) {
    return std::accumulate(spectrum.begin(), spectrum.end(), 0.0);
}

/// The time steps with the sources of one part of light.
std::vector<TimeStep> steps_of_part(
    const std::vector<TimeStep>& steps,
    const std::vector<LampControl>& controls_of_all,
    std::size_t part) {
    std::vector<TimeStep> own = steps;
    for (TimeStep& step : own) {
        std::erase_if(step.sources, [&](const auto& source) {
            return part_of(*source, controls_of_all) != part;
        });
        if (part != kDaylight) {
            step.directional_key.clear();  // lamps are the same at all times
        }
    }
    return own;
}

/// The scene whose sensors are the mean of those of each control.
Scene scene_of_controls(const ControlInput& input) {
    std::vector<SensorSet> sets;
    for (const LampControl& control : input.controls) {
        const auto& all = input.scene.sensors();
        SensorSet set = *std::ranges::find(all, control.sensors, &SensorSet::name);
        set.is_averaged = true;
        sets.push_back(std::move(set));
    }
    return scene_with_other_sensors(input.scene, std::move(sets));
}

/// The specification of a part: random numbers of its own, so that errors are independent.
RunSpec spec_of_part(const RunSpec& spec, std::size_t part) {
    RunSpec own = spec;
    own.seed = mix64(spec.seed ^ (0x3c6ef372fe94f82bU + part));
    own.target_error = own.max_seconds = own.audit = 0;
    own.max_paths = 0;
    own.ratios.clear();
    own.origins.clear();
    own.direct_light = DirectLight::included;
    return own;
}

/// The light of a part at the sensors of all controls. Times whose light differs by a factor share
/// a computation.
class PartLight {
  public:
    /// @param scene  scene_of_controls()
    PartLight(
        const Scene& scene,
        const std::vector<TimeStep>& steps,
        const RunSpec& spec,
        Simulator& simulator)
        : plans_(plan_series(steps)) {
        for (std::size_t i = 0; i < steps.size(); ++i) {
            if (plans_[i].traced == i && plans_[i].factor > 0) {
                const RunSpec own = trace_spec(spec, plans_[i], results_.size());
                results_.emplace(
                    i, SimulatorAccess::state(simulator).light_on_sensors(
                           scene, steps[i].sources, own));
            }
        }
    }

    [[nodiscard]] const TimeStepPlan& plan(std::size_t step) const { return plans_[step]; }
    /// The light of the computation that a time step is scaled from.
    [[nodiscard]] Estimate traced(std::size_t traced, std::size_t control, std::size_t band) const {
        return results_.at(traced).at(control, Quantity::incident_upper, band);
    }
    [[nodiscard]] double freedom(std::size_t traced) const {
        return std::max(1.0, static_cast<double>(results_.at(traced).replicates) - 1);
    }
    [[nodiscard]] Estimate at(std::size_t step, std::size_t control, std::size_t band) const {
        const TimeStepPlan& plan = plans_[step];
        return plan.factor > 0 ? scaled(traced(plan.traced, control, band), plan.factor)
                               : Estimate{};
    }

  private:
    std::vector<TimeStepPlan> plans_;
    std::map<std::size_t, Result> results_;  // by time step
};

/// A sum of light of parts over times: results of one computation are added once.
class WeightedLight {
  public:
    WeightedLight(const std::vector<PartLight>& parts, std::size_t control, std::size_t band)
        : parts_(parts), control_(control), band_(band) {}

    void add(std::size_t part, std::size_t step, double weight) {
        const TimeStepPlan& plan = parts_[part].plan(step);
        if (plan.factor * weight > 0) {
            weights_[{part, plan.traced}] += plan.factor * weight;
        }
    }
    [[nodiscard]] Estimate estimate() const {
        TimeSum sum;
        for (const auto& [key, weight] : weights_) {
            const auto [part, traced] = key;
            sum.add(
                parts_[part].traced(traced, control_, band_), weight, parts_[part].freedom(traced));
        }
        return sum.estimate();
    }

  private:
    const std::vector<PartLight>& parts_;
    std::size_t control_, band_;
    std::map<std::pair<std::size_t, std::size_t>, double> weights_;  // by part and computation
};

/// Decides the factors, time by time.
class ControlWalk {
  public:
    ControlWalk(
        const ControlInput& input,
        const std::vector<PartLight>& parts,
        const std::vector<TimeStep>& steps)
        : in_(input),
          parts_(parts),
          steps_(steps),
          lamps_(input.controls.size()),
          outcomes_(input.controls.size()) {
        for (ControlOutcome& outcome : outcomes_) {
            outcome.steps.resize(steps.size());
            outcome.days.resize(steps.empty() ? 0 : steps.back().day + 1);
        }
        for (std::size_t s = 0; s < input.sources.size(); ++s) {
            const std::size_t part = part_of(*input.sources[s], input.controls);
            if (part >= kControlled) {
                lamps_[part - kControlled].push_back(s);
                ++outcomes_[part - kControlled].lamps;
            }
        }
    }

    [[nodiscard]] std::vector<ControlOutcome> run() {
        std::vector<DaySoFar> days(in_.controls.size());
        for (std::size_t i = 0; i < steps_.size(); ++i) {
            if (i > 0 && steps_[i].day != steps_[i - 1].day) {
                days.assign(days.size(), {});
            }
            for (std::size_t k = 0; k < in_.controls.size(); ++k) {
                decide(i, k, days[k]);
            }
            for (std::size_t k = 0; k < in_.controls.size(); ++k) {
                report(i, k);
                days[k].light += outcomes_[k].steps[i].light.mean * steps_[i].seconds;
            }
        }
        for (std::size_t k = 0; k < in_.controls.size(); ++k) {
            add_days(k);
        }
        return std::move(outcomes_);
    }

  private:
    [[nodiscard]] Estimate light(std::size_t part, std::size_t i, std::size_t k) const {
        return parts_[part].at(i, k, in_.controls[k].band);
    }

    void decide(std::size_t i, std::size_t k, DaySoFar& day) {
        ControlledLight at{
            light(kDaylight, i, k).mean, light(kOtherLamps, i, k).mean,
            light(kControlled + k, i, k).mean};
        for (std::size_t before = 0; before < k; ++before) {
            at.other_lamps +=
                outcomes_[before].steps[i].factor * light(kControlled + before, i, k).mean;
        }
        const LampFactor decided = lamp_factor(in_.controls[k], at, steps_[i].seconds, day);
        day.is_reached = day.is_reached || decided.reaches_target;
        outcomes_[k].steps[i].factor = decided.factor;
        outcomes_[k].steps[i].on = decided.on;
    }

    /// Adds the light of all lamps, and of daylight, at a time.
    void add_all(std::size_t i, double weight, WeightedLight& sum) const {
        sum.add(kDaylight, i, weight);
        sum.add(kOtherLamps, i, weight);
        for (std::size_t other = 0; other < in_.controls.size(); ++other) {
            sum.add(kControlled + other, i, weight * outcomes_[other].steps[i].factor);
        }
    }

    void report(std::size_t i, std::size_t k) {
        const LampControl& control = in_.controls[k];
        ControlStep& step = outcomes_[k].steps[i];
        double lamps_on = 0, largest = 0;
        for (const std::size_t lamp : lamps_[k]) {
            const double full = sum_of(in_.sources[lamp]->spectrum());
            const double part = full > 0 ? sum_of(steps_[i].sources[lamp]->spectrum()) / full : 0;
            lamps_on += part;
            largest = std::max(largest, part);
        }
        step.on *= largest;
        step.kwh =
            control.electrical_power_w / 1000 * lamps_on * step.factor * steps_[i].seconds / kHour;
        step.daylight = light(kDaylight, i, k);
        step.lamps = scaled(light(kControlled + k, i, k), step.factor);
        WeightedLight all(parts_, k, control.band);
        add_all(i, 1, all);
        step.light = all.estimate();
        step.is_near_threshold =
            control.on_below && largest > 0 &&
            std::abs(step.daylight.mean - *control.on_below) <= 2 * step.daylight.standard_error;
    }

    void add_days(std::size_t k) {
        ControlOutcome& outcome = outcomes_[k];
        for (std::size_t i = 0; i < steps_.size();) {
            const std::size_t day = steps_[i].day;
            WeightedLight lamps(parts_, k, in_.controls[k].band), all = lamps;
            ControlDay& sum = outcome.days[day];
            for (; i < steps_.size() && steps_[i].day == day; ++i) {
                const ControlStep& step = outcome.steps[i];
                const double seconds = steps_[i].seconds;
                sum.hours_on += step.on * seconds / kHour;
                sum.kwh += step.kwh;
                sum.hours_near_threshold += step.is_near_threshold ? seconds / kHour : 0;
                lamps.add(kControlled + k, i, seconds * step.factor);
                add_all(i, seconds, all);
            }
            sum.lamps = lamps.estimate();
            sum.light = all.estimate();
        }
    }

    const ControlInput& in_;
    const std::vector<PartLight>& parts_;
    const std::vector<TimeStep>& steps_;
    std::vector<std::vector<std::size_t>> lamps_;  // by control, among the sources
    std::vector<ControlOutcome> outcomes_;
};

}  // namespace

bool controls(const LampControl& control, const Source& source) {
    return source.is_lamp() && fits_pattern(source.name(), control.sources);
}

std::vector<ControlOutcome> control_lamps(
    const ControlInput& input, Simulator& simulator, std::vector<TimeStep>& time_steps) {
    if (input.controls.empty()) {
        return {};
    }
    const Scene scene = scene_of_controls(input);
    std::vector<PartLight> parts;
    for (std::size_t part = 0; part < kControlled + input.controls.size(); ++part) {
        parts.emplace_back(
            scene, steps_of_part(time_steps, input.controls, part), spec_of_part(input.spec, part),
            simulator);
    }
    std::vector<ControlOutcome> outcomes = ControlWalk(input, parts, time_steps).run();
    for (std::size_t i = 0; i < time_steps.size(); ++i) {
        for (auto& source : time_steps[i].sources) {
            const std::size_t part = part_of(*source, input.controls);
            if (part >= kControlled) {
                source =
                    make_dimmed(std::move(source), outcomes[part - kControlled].steps[i].factor);
            }
        }
    }
    return outcomes;
}

}  // namespace quasimc

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "resultio/describe_series.h"
#include "resultio/json_parts.h"
#include "results/units.h"

namespace quasimc {
namespace {

Json json_steps(const RunFile& run, const ControlOutcome& outcome) {
    Json steps = Json::array();
    for (std::size_t i = 0; i < outcome.steps.size(); ++i) {
        const ControlStep& step = outcome.steps[i];
        steps.push_back(
            {{"time", run.series->notes[i].time},
             {"factor", step.factor},
             {"on", step.on},
             {"kwh", step.kwh},
             {"daylight", json_estimate(step.daylight)},
             {"lamps", json_estimate(step.lamps)},
             {"light", json_estimate(step.light)},
             {"is_near_threshold", step.is_near_threshold}});
    }
    return steps;
}

Json json_days(const RunFile& run, const ControlOutcome& outcome) {
    Json days = Json::array();
    for (std::size_t i = 0; i < outcome.days.size(); ++i) {
        const ControlDay& day = outcome.days[i];
        days.push_back(
            {{"date", run.series->days[i]},
             {"hours_on", day.hours_on},
             {"kwh", day.kwh},
             {"lamps", json_estimate(day.lamps)},
             {"light", json_estimate(day.light)},
             {"hours_near_threshold", day.hours_near_threshold}});
    }
    return days;
}

}  // namespace

Json json_controls(const RunFile& run) {
    Json all = Json::array();
    const std::vector<ControlOutcome> outcomes = in_summed_units(run, run.series->outcomes);
    for (std::size_t k = 0; k < outcomes.size(); ++k) {
        const LampControl& control = run.series->controls[k];
        const ControlOutcome& outcome = outcomes[k];
        const std::string unit = summed_unit(run.scene.bands()[control.band].unit).name;
        all.push_back(
            {{"sources", control.sources},
             {"sensors", control.sensors},
             {"band", run.scene.bands()[control.band].name},
             {"lamps", outcome.lamps},
             {"sum_unit", unit},
             {"time_steps", json_steps(run, outcome)},
             {"days", json_days(run, outcome)}});
    }
    return all;
}

}  // namespace quasimc

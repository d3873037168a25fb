#include "control.h"

#include <pybind11/stl.h>

#include "results/units.h"

namespace quasimc::python {
namespace {

/// Mean, standard error and ends of the interval, times a factor.
py::list numbers_of(const Estimate& estimate, double factor = 1) {
    const Estimate e = reported(scaled(estimate, factor));
    py::list numbers;
    for (const double x : {e.mean, e.standard_error, e.ci95_low, e.ci95_high}) {
        numbers.append(x);
    }
    return numbers;
}

py::dict day_under_control(const ControlDay& day, double factor) {
    py::dict own;
    own["hours_on"] = day.hours_on;
    own["kwh"] = day.kwh;
    own["hours_near_threshold"] = day.hours_near_threshold;
    own["lamps"] = numbers_of(day.lamps, factor);
    own["light"] = numbers_of(day.light, factor);
    return own;
}

py::dict control_of(
    const LampControl& control,
    const ControlOutcome& outcome,
    const TimeSeries& series,
    const Band& band) {
    const SummedUnit unit = summed_unit(band.unit);
    py::list factor, on, kwh, is_near_threshold, daylight, lamps, light;
    for (const ControlStep& step : outcome.steps) {
        factor.append(step.factor);
        on.append(step.on);
        kwh.append(step.kwh);
        is_near_threshold.append(step.is_near_threshold);
        daylight.append(numbers_of(step.daylight));
        lamps.append(numbers_of(step.lamps));
        light.append(numbers_of(step.light));
    }
    py::dict days;
    for (std::size_t i = 0; i < outcome.days.size(); ++i) {
        days[py::str(series.days[i])] = day_under_control(outcome.days[i], unit.factor);
    }
    py::dict own;
    own["sources"] = control.sources;
    own["sensors"] = control.sensors;
    own["band"] = band.name;
    own["unit"] = band.unit;
    own["sum_unit"] = unit.name;
    own["lamp_count"] = outcome.lamps;
    own["factor"] = factor;
    own["on"] = on;
    own["kwh"] = kwh;
    own["is_near_threshold"] = is_near_threshold;
    own["daylight"] = daylight;
    own["lamps"] = lamps;
    own["light"] = light;
    own["days"] = days;
    return own;
}

}  // namespace

py::list controls_of(const TimeSeries& series, const Scene& scene) {
    py::list all;
    for (std::size_t k = 0; k < series.outcomes.size(); ++k) {
        const LampControl& control = series.controls[k];
        all.append(control_of(control, series.outcomes[k], series, scene.bands()[control.band]));
    }
    return all;
}

}  // namespace quasimc::python

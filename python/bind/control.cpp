#include "control.h"

#include <pybind11/stl.h>

#include "results/units.h"

namespace quasimc::python {
namespace {

/// Mean, standard error and ends of the interval.
py::list numbers_of(const Estimate& estimate) {
    const Estimate e = reported(estimate);
    py::list numbers;
    for (const double x : {e.mean, e.standard_error, e.ci95_low, e.ci95_high}) {
        numbers.append(x);
    }
    return numbers;
}

py::dict day_under_control(const ControlDay& day) {
    py::dict own;
    own["hours_on"] = day.hours_on;
    own["kwh"] = day.kwh;
    own["hours_near_threshold"] = day.hours_near_threshold;
    own["lamps"] = numbers_of(day.lamps);
    own["light"] = numbers_of(day.light);
    return own;
}

py::dict control_of(
    const LampControl& control,
    const ControlOutcome& outcome,
    const TimeSeries& series,
    const Band& band) {
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
        days[py::str(series.days[i])] = day_under_control(outcome.days[i]);
    }
    py::dict own;
    own["sources"] = control.sources;
    own["sensors"] = control.sensors;
    own["band"] = band.name;
    own["unit"] = band.unit;
    own["sum_unit"] = summed_unit(band.unit).name;
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

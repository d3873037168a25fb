#include "netcdf/netcdf_controls.h"

#include <algorithm>

#include "results/units.h"

namespace quasimc {

NetcdfControls::NetcdfControls(const RunFile& run, NetcdfAxes& axes) : axes_(axes) {
    if (!run.series || run.series->controls.empty()) {
        return;
    }
    controls_ = run.series->controls;
    std::vector<std::string> names, sensors, bands;
    for (const LampControl& control : controls_) {
        names.push_back(control.sources);
        sensors.push_back(control.sensors);
        bands.push_back(run.scene.bands()[control.band].name);
    }
    axis_ = axes.add_names("control", "pattern of the names of its lamps", names);
    const std::string of_sensors = axes.free_name("control_sensors"),
                      of_band = axes.free_name("control_band");
    axes.add_texts(of_sensors, "sensors of a control", {*axis_.first}, sensors);
    axes.add_texts(of_band, "band in which a control takes the light", {*axis_.first}, bands);
    coordinates_ = of_sensors + " " + of_band;
    define_numbers();
    define_light(run);
}

void NetcdfControls::define_numbers() {
    const auto add = [&](const std::string& name, const std::string& unit,
                         const std::string& summary, const NetcdfAxes::Axis& first) {
        return axes_.add_reals({name, unit, summary, coordinates_}, {first, axis_});
    };
    const NetcdfAxes::Axis &time = axes_.time(), &day = axes_.day();
    step_numbers_ = {
        {add("control_factor", "1", "factor on the light of the lamps, mean over the time", time),
         [](const ControlStep& step) { return step.factor; }},
        {add("control_on", "1", "part of the time in which the lamps are on, dimmed or not", time),
         [](const ControlStep& step) { return step.on; }},
        {add("control_kwh", "kW h", "electrical energy of the lamps", time),
         [](const ControlStep& step) { return step.kwh; }},
        {add("control_is_near_threshold", "1",
             "1 if daylight is within two standard errors of on_below, else 0", time),
         [](const ControlStep& step) { return step.is_near_threshold ? 1.0 : 0.0; }}};
    day_numbers_ = {
        {add("control_hours_on", "h", "time in which the lamps are on, dimmed or not", day),
         &ControlDay::hours_on},
        {add("control_kwh_day_sum", "kW h", "electrical energy of the lamps, summed", day),
         &ControlDay::kwh},
        {add("control_hours_near_threshold", "h",
             "time in which daylight is within two standard errors of on_below", day),
         &ControlDay::hours_near_threshold}};
}

/// Defines the light for all controls if their bands have one unit, else for each band.
void NetcdfControls::define_light(const RunFile& run) {
    const std::vector<Band>& bands = run.scene.bands();
    const std::string& first = bands[controls_.front().band].unit;
    const auto has_unit = [&](const LampControl& control) {
        return bands[control.band].unit == first;
    };
    if (std::ranges::all_of(controls_, has_unit)) {
        add_light("", first, std::vector<bool>(controls_.size(), true));
        return;
    }
    for (std::size_t b = 0; b < bands.size(); ++b) {
        std::vector<bool> has;
        for (const LampControl& control : controls_) {
            has.push_back(control.band == b);
        }
        if (std::ranges::find(has, true) != has.end()) {
            add_light("_" + bands[b].name, bands[b].unit, std::move(has));
        }
    }
}

void NetcdfControls::add_light(
    const std::string& suffix, const std::string& unit, std::vector<bool> has) {
    const auto add = [&](const std::string& name, const std::string& summary, bool is_daily) {
        return axes_.add_estimates(
            {"control_" + name + suffix + (is_daily ? "_day_sum" : ""),
             is_daily ? summed_unit(unit).name : unit, summary + (is_daily ? ", summed" : ""),
             coordinates_},
            {is_daily ? axes_.day() : axes_.time(), axis_});
    };
    const std::string lamps = "light of the lamps of a control at its sensors",
                      light = "all light at the sensors of a control";
    light_.push_back(
        {std::move(has), add("daylight", "daylight at the sensors of a control", false),
         add("lamps", lamps, false), add("light", light, false), add("lamps", lamps, true),
         add("light", light, true)});
}

bool NetcdfControls::fits(const RunFile& run) const {
    return std::ranges::equal(
        controls_, run.series ? run.series->controls : std::vector<LampControl>(),
        [](const LampControl& a, const LampControl& b) {
            return a.sources == b.sources && a.sensors == b.sensors && a.band == b.band;
        });
}

template <typename Part>
void NetcdfControls::put_light(
    const NetcdfEstimates& to,
    const std::vector<std::size_t>& start,
    const std::vector<bool>& has,
    const std::vector<const Part*>& parts,
    Estimate Part::*member) {
    axes_.put(to, start, {parts.size()}, [&](std::size_t k) {
        return has[k] ? parts[k]->*member : kUnknownEstimate;
    });
}

void NetcdfControls::put_step(
    const std::vector<std::size_t>& start, const std::vector<const ControlStep*>& steps) {
    for (const auto& [variable, number_of] : step_numbers_) {
        std::vector<double> numbers(steps.size());
        std::ranges::transform(steps, numbers.begin(), [of = number_of](const ControlStep* step) {
            return of(*step);
        });
        axes_.put(variable, start, {numbers.size()}, numbers);
    }
    for (const Light& light : light_) {
        put_light(light.daylight, start, light.has, steps, &ControlStep::daylight);
        put_light(light.lamps, start, light.has, steps, &ControlStep::lamps);
        put_light(light.light, start, light.has, steps, &ControlStep::light);
    }
}

void NetcdfControls::put_day(
    const std::vector<std::size_t>& start, const std::vector<const ControlDay*>& days) {
    for (const auto& [variable, member] : day_numbers_) {
        std::vector<double> numbers(days.size());
        std::ranges::transform(
            days, numbers.begin(), [of = member](const ControlDay* day) { return day->*of; });
        axes_.put(variable, start, {numbers.size()}, numbers);
    }
    for (const Light& light : light_) {
        put_light(light.lamps_of_day, start, light.has, days, &ControlDay::lamps);
        put_light(light.light_of_day, start, light.has, days, &ControlDay::light);
    }
}

void NetcdfControls::put(const RunFile& run, const std::vector<ControlOutcome>& outcomes) {
    if (outcomes.empty()) {
        return;
    }
    const auto start_at = [&](std::size_t row) {
        std::vector<std::size_t> start = axes_.indices_of(run);
        start.push_back(row);
        return start;
    };
    for (std::size_t i = 0; i < outcomes.front().steps.size(); ++i) {
        std::vector<const ControlStep*> steps(outcomes.size());
        std::ranges::transform(outcomes, steps.begin(), [i](const ControlOutcome& outcome) {
            return &outcome.steps[i];
        });
        if (const auto row = axes_.row_of(i)) {
            put_step(start_at(*row), steps);
        }
    }
    for (std::size_t i = 0; i < outcomes.front().days.size(); ++i) {
        std::vector<const ControlDay*> days(outcomes.size());
        std::ranges::transform(outcomes, days.begin(), [i](const ControlOutcome& outcome) {
            return &outcome.days[i];
        });
        put_day(start_at(i), days);
    }
}

}  // namespace quasimc

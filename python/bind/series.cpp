#include "quasimc/series.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include "bind.h"
#include "control.h"
#include "options/options.h"
#include "record.h"
#include "result.h"
#include "resultio/describe_series.h"
#include "resultio/json_parts.h"
#include "results/units.h"
#include "run.h"
#include "scene.h"
#include "series/time_sums.h"
#include "summable_light.h"
#include "watch.h"

namespace quasimc::python {
namespace {

/// Records a series that is computed.
class SeriesRecorder final : public RunListener {
  public:
    /// @param keeps_times  whether the results of time steps are kept, or sums alone
    /// @param max_bytes    larger sums of replicates are not kept
    SeriesRecorder(RunRecord& record, bool keeps_times, double max_bytes)
        : record_(record), keeps_times_(keeps_times), keeper_(max_bytes) {}

    void on_last_round(const RunSoFar& run) override { keeper_.on_last_round(run); }
    void on_time_step(const TimeStepResult& step) override {
        record_.add(step);
        // The sums of a time that is another one's, scaled, are not its own.
        if (step.computed == step.time_step) {
            record_.replicates.back() = keeper_.take(
                record_.scene, record_.series->time_steps[step.time_step].sources, record_.spec);
        }
    }
    [[nodiscard]] bool wants(SeriesPart part) const override {
        return part != SeriesPart::sums && (keeps_times_ || part != SeriesPart::time_steps);
    }
    void on_day(std::size_t day, const SeriesSum& sum) override { record_.add(day, sum); }

  private:
    RunRecord& record_;
    bool keeps_times_;
    SumsKeeper keeper_;
};

std::shared_ptr<RunRecord> run_times(
    const SceneHandle& scene,
    const LightHandle& light,
    bool keeps_times,
    double max_bytes,
    const py::object& on_progress) {
    auto all = std::make_shared<RunRecord>();
    all->scene = scene.scene;
    all->spec = light.light.spec;
    all->series = light.light.series.value();
    SeriesRecorder recorder(*all, keeps_times, max_bytes);
    WatchedWork(on_progress).run([&](const RunControl& control) {
        Simulator simulator;
        TimeSeries& series = *all->series;
        series.outcomes = in_summed_units(
            scene.scene->bands(), series.controls,
            control_lamps(
                {*scene.scene, light.light.sources, light.light.spec, series.controls}, simulator,
                series.time_steps));
        RunControl own = control;
        own.listeners.push_back(&recorder);
        all->end(run_series(
            std::move(simulator), *scene.scene, series.time_steps, light.light.spec, own));
    });
    return all;
}

py::object view_of_sum(const SeriesSum& sum, std::size_t organs, py::handle owner) {
    return estimates_view(
        sum.values,
        {static_cast<py::ssize_t>(organs), static_cast<py::ssize_t>(kQuantities),
         static_cast<py::ssize_t>(sum.bands)},
        owner);
}

std::size_t organs_of(const SeriesSum& sum) {
    return sum.bands == 0 ? 0 : sum.values.size() / (kQuantities * sum.bands);
}

py::dict notes_of(const TimeStepNotes& notes) {
    py::dict time_step;
    time_step["time"] = notes.time;
    time_step["seconds"] = notes.seconds;
    time_step["sun_azimuth_deg"] = notes.sun.azimuth_deg;
    time_step["sun_elevation_deg"] = notes.sun.elevation_deg;
    time_step["direct"] = notes.daylight.direct;
    time_step["diffuse"] = notes.daylight.diffuse;
    return time_step;
}

/// The time steps with a result; in a record of sums alone, all that are complete.
py::list times_of(const RunRecord& all) {
    py::list times;
    for (const std::size_t i : all.time_steps) {
        times.append(notes_of(all.series->notes[i]));
    }
    for (std::size_t i = 0; all.results.empty() && i < all.summary.completed; ++i) {
        times.append(notes_of(all.series->notes[i]));
    }
    return times;
}

/// For each result the index of that from which it is scaled, or its own, and the factor on its
/// light; none without replicates.
std::vector<std::pair<std::size_t, double>> scaled_from(const RunRecord& all) {
    const bool has_replicates =
        std::ranges::any_of(all.replicates, [](const auto& kept) { return kept != nullptr; });
    const std::vector<TimeStepPlan> plans =
        has_replicates ? plan_series(all.series->time_steps) : std::vector<TimeStepPlan>{};
    std::vector<std::pair<std::size_t, double>> from;
    for (std::size_t i = 0; has_replicates && i < all.results.size(); ++i) {
        from.emplace_back(plans[i].traced, plans[i].factor);
    }
    return from;
}

/// The results that are summed over a day (or over all days), and their weights: indices of those
/// that were computed, and (results, bands) seconds in the units of sums. None without replicates.
py::tuple weights_of(const RunRecord& all, std::optional<std::size_t> day) {
    const std::vector<TimeStep>& steps = all.series->time_steps;
    const auto from = scaled_from(all);
    std::map<std::size_t, double> seconds;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const auto [traced, factor] = from[i];
        if (steps[i].day == day.value_or(steps[i].day) && factor * steps[i].seconds > 0) {
            seconds[traced] += factor * steps[i].seconds;
        }
    }
    const std::vector<Band>& bands = all.scene->bands();
    std::vector<std::size_t> results;
    std::vector<double> weights;
    for (const auto& [step, own] : seconds) {
        results.push_back(step);
        for (const Band& band : bands) {
            weights.push_back(own * summed_unit(band.unit).factor);
        }
    }
    const std::vector<py::ssize_t> shape{
        static_cast<py::ssize_t>(results.size()), static_cast<py::ssize_t>(bands.size())};
    return py::make_tuple(results, Numbers(shape, weights.data()));
}

/// Weighted sums of estimates with independent errors, as those of days.
/// @param values  (times, n, 4). @param weights  (times, n)
/// @param freedom  degrees of freedom of each error
Numbers sum_of_times(const Numbers& values, const Numbers& weights, double freedom) {
    const auto count = static_cast<std::size_t>(weights.shape(1));
    std::vector<TimeSum> sums(count);
    const double* own = values.data();
    for (std::size_t i = 0; i < static_cast<std::size_t>(weights.size()); ++i, own += 4) {
        sums[i % count].add({own[0], own[1], own[2], own[3]}, weights.data()[i], freedom);
    }
    std::vector<Estimate> estimates;
    estimates.reserve(count);
    for (const TimeSum& sum : sums) {
        estimates.push_back(sum.estimate());
    }
    return array_of(estimates, {static_cast<py::ssize_t>(count)});
}

py::list days_of(const py::object& self) {
    const auto& all = self.cast<const RunRecord&>();
    py::list days;
    for (std::size_t i = 0; i < all.sums.size(); ++i) {
        py::dict day;
        day["date"] = all.series->days[all.days[i]];
        day["seconds"] = all.sums[i].seconds;
        day["weights"] = weights_of(all, all.days[i]);
        day["values"] = view_of_sum(all.sums[i], organs_of(all.sums[i]), self);
        day["groups"] = groups_dict(all.sums[i].groups, self, CsvTimes::days);
        day["sun_shade"] = parts_dict(all.sums[i].sun_shade, &all.sums[i].sunlit_hours, self);
        day["origins"] = origins_dict(all.sums[i].origins, self);
        day["sensors"] = sensors_dict(all.sums[i], self);
        days.append(day);
    }
    return days;
}

py::dict facts_of_series(const RunRecord& all) {
    const SeriesSummary& summary = all.summary;
    py::dict facts;
    facts["computed"] = summary.computed;
    facts["completed"] = summary.completed;
    facts["time_steps"] = all.series->time_steps.size();
    facts["stop"] = std::string(stop_name(summary.stop));
    facts["audit_p_value"] = summary.audit_p_value;
    facts["rays"] = summary.rays;
    facts["seconds"] = summary.seconds;
    facts["total_seconds"] = summary.total.seconds;
    py::dict methods;
    for (const auto& [method, count] : summary.methods) {
        methods[py::str(method_name(method))] = count;
    }
    facts["methods"] = methods;
    return facts;
}

}  // namespace

void bind_series(py::module_& module) {
    py::class_<RunRecord, std::shared_ptr<RunRecord>>(module, "Series")
        .def_property_readonly("results", [](const RunRecord& all) { return all.results; })
        .def_property_readonly("replicates", [](const RunRecord& all) { return all.replicates; })
        .def_property_readonly("scaled_from", &scaled_from)
        .def_property_readonly("times", &times_of)
        .def_property_readonly("days", &days_of)
        .def_property_readonly(
            "total",
            [](const py::object& self) {
                const auto& total = self.cast<const RunRecord&>().summary.total;
                return view_of_sum(total, organs_of(total), self);
            })
        .def_property_readonly(
            "total_weights", [](const RunRecord& all) { return weights_of(all, std::nullopt); })
        .def_property_readonly(
            "total_origins",
            [](const py::object& self) {
                return origins_dict(self.cast<const RunRecord&>().summary.total.origins, self);
            })
        .def_property_readonly(
            "total_sensors",
            [](const py::object& self) {
                return sensors_dict(self.cast<const RunRecord&>().summary.total, self);
            })
        .def_property_readonly(
            "total_groups",
            [](const py::object& self) {
                const auto& total = self.cast<const RunRecord&>().summary.total;
                return groups_dict(total.groups, self, CsvTimes::days);
            })
        .def_property_readonly(
            "total_sun_shade",
            [](const py::object& self) {
                const auto& total = self.cast<const RunRecord&>().summary.total;
                return parts_dict(total.sun_shade, &total.sunlit_hours, self);
            })
        .def_property_readonly(
            "step_times",
            [](const RunRecord& all) {
                py::list times;
                for (const TimeStepNotes& notes : all.series->notes) {
                    times.append(notes.time);
                }
                return times;
            })
        .def_property_readonly(
            "control", [](const RunRecord& all) { return controls_of(*all.series, *all.scene); })
        .def_property_readonly("facts", &facts_of_series);
    module.def(
        "sum_of_times", &sum_of_times, py::arg("values"), py::arg("weights"), py::arg("freedom"));
    module.def(
        "run_series", &run_times, py::arg("scene"), py::arg("light"), py::arg("keeps_times"),
        py::arg("max_bytes"), py::arg("on_progress") = py::none());
}

}  // namespace quasimc::python

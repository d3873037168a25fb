#include "quasimc/series.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include "bind.h"
#include "control.h"
#include "options/options.h"
#include "replicates.h"
#include "result.h"
#include "resultio/json_parts.h"
#include "run.h"
#include "scene.h"
#include "watch.h"

namespace quasimc::python {
namespace {

/// The results of a series.
class SeriesHandle final : public RunListener {
  public:
    SeriesHandle(TimeSeries of, bool keeps, double max_bytes)
        : series(std::move(of)), keeps_times(keeps), keeper_(max_bytes) {}

    void on_last_round(const RunSoFar& run) override { keeper_.on_last_round(run); }
    void on_time_step(const TimeStepResult& step) override {
        results.push_back(reported_result(step.result));
        // The sums of a time that is another one's, scaled, are not its own.
        const bool has_own = step.computed == step.time_step;
        replicates.push_back(
            has_own ? keeper_.take(scene, series.time_steps[step.time_step].sources, spec)
                    : nullptr);
    }
    [[nodiscard]] bool wants(SeriesPart part) const override {
        return part != SeriesPart::sums && (keeps_times || part != SeriesPart::time_steps);
    }
    void on_day(std::size_t day, const SeriesSum& sum) override {
        days.push_back(day);
        sums.push_back(reported_sum(sum));
    }

    TimeSeries series;
    bool keeps_times;
    std::shared_ptr<const Scene> scene;
    RunSpec spec;
    std::vector<std::shared_ptr<Result>> results;  ///< per time step; empty if they are not kept
    std::vector<std::shared_ptr<ReplicateSums>> replicates;  ///< per result; null: not kept
    std::vector<std::size_t> days;                           ///< numbers of the days in `sums`
    std::vector<SeriesSum> sums;
    SeriesSummary summary;

  private:
    SumsKeeper keeper_;
};

std::shared_ptr<SeriesHandle> run_times(
    const SceneHandle& scene,
    const LightHandle& light,
    bool keeps_times,
    double max_bytes,
    const py::object& on_progress) {
    auto all = std::make_shared<SeriesHandle>(light.light.series.value(), keeps_times, max_bytes);
    all->scene = scene.scene;
    all->spec = light.light.spec;
    WatchedWork(on_progress).run([&](const RunControl& control) {
        Simulator simulator;
        all->series.outcomes = control_lamps(
            {*scene.scene, light.light.sources, light.light.spec, all->series.controls}, simulator,
            all->series.time_steps);
        RunControl own = control;
        own.listeners.push_back(all.get());
        all->summary = run_series(
            std::move(simulator), *scene.scene, all->series.time_steps, light.light.spec, own);
    });
    all->summary.total = reported_sum(std::move(all->summary.total));
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

py::list times_of(const SeriesHandle& all) {
    py::list times;
    for (std::size_t i = 0; i < all.summary.completed; ++i) {
        times.append(notes_of(all.series.notes[i]));
    }
    return times;
}

py::list days_of(const py::object& self) {
    const auto& all = self.cast<const SeriesHandle&>();
    py::list days;
    for (std::size_t i = 0; i < all.sums.size(); ++i) {
        py::dict day;
        day["date"] = all.series.days[all.days[i]];
        day["seconds"] = all.sums[i].seconds;
        day["values"] = view_of_sum(all.sums[i], organs_of(all.sums[i]), self);
        day["groups"] = groups_dict(all.sums[i].groups, self, CsvTimes::days);
        day["sun_shade"] = parts_dict(all.sums[i].sun_shade, &all.sums[i].sunlit_hours, self);
        day["origins"] = origins_dict(all.sums[i].origins, self);
        day["sensors"] = sensors_dict(all.sums[i].sensors.get(), self);
        days.append(day);
    }
    return days;
}

py::dict facts_of_series(const SeriesHandle& all) {
    const SeriesSummary& summary = all.summary;
    py::dict facts;
    facts["computed"] = summary.computed;
    facts["completed"] = summary.completed;
    facts["time_steps"] = all.series.time_steps.size();
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
    py::class_<SeriesHandle, std::shared_ptr<SeriesHandle>>(module, "Series")
        .def_property_readonly("results", [](const SeriesHandle& all) { return all.results; })
        .def_property_readonly("replicates", [](const SeriesHandle& all) { return all.replicates; })
        .def_property_readonly("times", &times_of)
        .def_property_readonly("days", &days_of)
        .def_property_readonly(
            "total",
            [](const py::object& self) {
                const auto& total = self.cast<const SeriesHandle&>().summary.total;
                return view_of_sum(total, organs_of(total), self);
            })
        .def_property_readonly(
            "total_origins",
            [](const py::object& self) {
                return origins_dict(self.cast<const SeriesHandle&>().summary.total.origins, self);
            })
        .def_property_readonly(
            "total_sensors",
            [](const py::object& self) {
                const auto& total = self.cast<const SeriesHandle&>().summary.total;
                return sensors_dict(total.sensors.get(), self);
            })
        .def_property_readonly(
            "total_groups",
            [](const py::object& self) {
                const auto& total = self.cast<const SeriesHandle&>().summary.total;
                return groups_dict(total.groups, self, CsvTimes::days);
            })
        .def_property_readonly(
            "total_sun_shade",
            [](const py::object& self) {
                const auto& total = self.cast<const SeriesHandle&>().summary.total;
                return parts_dict(total.sun_shade, &total.sunlit_hours, self);
            })
        .def_property_readonly(
            "step_times",
            [](const SeriesHandle& all) {
                py::list times;
                for (const TimeStepNotes& notes : all.series.notes) {
                    times.append(notes.time);
                }
                return times;
            })
        .def_property_readonly(
            "control", [](const SeriesHandle& all) { return controls_of(all.series, *all.scene); })
        .def_property_readonly("facts", &facts_of_series);
    module.def(
        "run_series", &run_times, py::arg("scene"), py::arg("light"), py::arg("keeps_times"),
        py::arg("max_bytes"), py::arg("on_progress") = py::none());
}

}  // namespace quasimc::python

#include "result.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "options/options.h"
#include "resultio/json_parts.h"

namespace quasimc::python {
namespace {

static_assert(sizeof(Estimate) == 4 * sizeof(double));

py::object tuple_of(const Estimate& estimate) {
    const Estimate e = reported(estimate);
    return py::make_tuple(e.mean, e.standard_error, e.ci95_low, e.ci95_high);
}

py::list budget_of(const Result& result) {
    py::list bands;
    for (const BandBudget& budget : result.budget) {
        py::dict band;
        band["emitted"] = tuple_of(budget.emitted);
        band["absorbed_by_organs"] = tuple_of(budget.absorbed_by_organs);
        band["absorbed_by_ground"] = tuple_of(budget.absorbed_by_ground);
        band["escaped"] = tuple_of(budget.escaped);
        band["cut_off"] = tuple_of(budget.cut_off);
        band["imbalance"] = tuple_of(budget.imbalance);
        band["closure_error"] = budget.closure_error;
        bands.append(band);
    }
    return bands;
}

py::list canopy_of(const Result& result) {
    py::list bands;
    for (const CanopyFractions& fractions : result.canopy) {
        py::dict band;
        band["incident"] = fractions.incident;
        band["reflectance"] = tuple_of(fractions.reflectance);
        band["transmittance"] = tuple_of(fractions.transmittance);
        band["absorptance"] = tuple_of(fractions.absorptance);
        band["ground_absorptance"] = tuple_of(fractions.ground_absorptance);
        bands.append(band);
    }
    return bands;
}

py::list detectors_of(const py::object& self) {
    const auto& result = self.cast<const Result&>();
    py::list all;
    for (const DetectorResult& reading : result.detectors) {
        py::dict detector;
        detector["name"] = reading.name;
        detector["type"] = reading.type;
        detector["quantity"] = reading.quantity;
        detector["bins"] = reading.bins;
        const auto bins = static_cast<py::ssize_t>(reading.bins.size());
        detector["values"] =
            estimates_view(reading.values, {bins, static_cast<py::ssize_t>(result.bands)}, self);
        all.append(detector);
    }
    return all;
}

py::object audit_of(const Result& result) {
    if (!result.audit) {
        return py::none();
    }
    py::dict audit;
    audit["paths"] = result.audit->paths;
    audit["replicates"] = result.audit->replicates;
    audit["p_value"] = result.audit->p_value;
    audit["agrees"] = result.audit->agrees();
    return audit;
}

/// The rounds, with keys as in the JSON file.
py::list rounds_of(const Result& result) {
    py::list rounds;
    for (const RoundErrors& known : result.rounds) {
        py::dict round;
        round["paths"] = known.paths;
        round["seconds"] = known.seconds;
        round["median_error"] = known.median;
        round["worst_error"] = known.worst;
        round["fraction_at_target"] = known.fraction_at_target;
        rounds.append(round);
    }
    return rounds;
}

py::dict facts_of(const Result& result) {
    py::dict facts;
    facts["method"] = method_name(result.chosen.method);
    facts["reason"] = result.chosen.reason;
    facts["paths"] = result.paths;
    facts["replicates"] = result.replicates;
    facts["rays"] = result.rays;
    facts["stop"] = std::string(stop_name(result.stop));
    facts["fraction_at_target"] = result.fraction_at_target;
    facts["preparation_seconds"] = result.preparation_seconds;
    facts["solve_seconds"] = result.solve_seconds;
    facts["solve_cpu_seconds"] = result.solve_cpu_seconds;
    facts["escaped_by_difference"] = result.escaped_by_difference;
    facts["rounds"] = rounds_of(result);
    return facts;
}

py::ssize_t signed_size(std::size_t size) {
    return static_cast<py::ssize_t>(size);
}

void report_all(std::vector<Estimate>& estimates) {
    std::transform(estimates.begin(), estimates.end(), estimates.begin(), reported);
}

}  // namespace

void report_groups(GroupResults& groups) {
    for (std::vector<Estimate>* estimates :
         {&groups.values, &groups.sunlit_fraction, &groups.sunlit_area, &groups.ratio_values,
          &groups.shares, &groups.sun_shade.values}) {
        report_all(*estimates);
    }
}

SeriesSum reported_sum(SeriesSum sum) {
    for (std::vector<Estimate>* estimates :
         {&sum.values, &sum.sunlit_hours, &sum.sun_shade.values}) {
        report_all(*estimates);
    }
    report_groups(sum.groups);
    for (OriginSum& origin : sum.origins) {
        origin.light = reported_sum(std::move(origin.light));
    }
    if (sum.sensors) {
        sum.sensors = std::make_shared<const SeriesSum>(reported_sum(*sum.sensors));
    }
    return sum;
}

std::shared_ptr<Result> reported_result(Result result) {
    for (std::vector<Estimate>* estimates :
         {&result.values, &result.sunlit_fraction, &result.ratio_values,
          &result.sun_shade.values}) {
        report_all(*estimates);
    }
    report_groups(result.groups);
    for (OriginLight& origin : result.origins) {
        report_all(origin.light.values);
        report_groups(origin.light.groups);
    }
    for (DetectorResult& detector : result.detectors) {
        report_all(detector.values);
    }
    if (result.sensors) {
        result.sensors = reported_result(*result.sensors);
    }
    return std::make_shared<Result>(std::move(result));
}

py::object estimates_view(
    const std::vector<Estimate>& values, std::vector<py::ssize_t> shape, py::handle owner) {
    shape.push_back(4);
    const double* data = values.empty() ? nullptr : &values.front().mean;
    py::array_t<double> view(std::move(shape), data, owner);
    view.attr("flags").attr("writeable") = false;
    return view;
}

py::object parts_dict(
    const SunShadeLight& light, const std::vector<Estimate>* hours, py::handle owner) {
    if (light.empty()) {
        return py::none();
    }
    const std::size_t rows = light.values.size() / light.values_per_row();
    py::dict parts;
    parts["values"] = estimates_view(
        light.values,
        {signed_size(rows), signed_size(kSunShadeQuantities), signed_size(light.bands)}, owner);
    if (hours != nullptr) {
        parts["hours"] = estimates_view(*hours, {signed_size(rows)}, owner);
    }
    return parts;
}

py::object groups_dict(const GroupResults& results, py::handle owner, CsvTimes times) {
    py::list groups;
    for (const OrganGroup& group : results.groups) {
        py::dict row;
        row["by"] = group.by;
        row["value"] = group.value;
        py::dict labels;
        for (const auto& [key, value] : group.labels) {
            labels[py::str(key)] = py::str(value);
        }
        row["labels"] = labels;
        row["organs"] =
            py::array_t<std::uint32_t>(signed_size(group.organs.size()), group.organs.data());
        row["area"] = group.area;
        row["height_min"] = group.height_min;
        row["height_max"] = group.height_max;
        row["plant_area_index"] = group.plant_area_index;
        row["cumulative_plant_area_index"] = group.cumulative_plant_area_index;
        groups.append(row);
    }
    const py::ssize_t count = signed_size(results.groups.size());
    py::dict all;
    all["groups"] = groups;
    all["values"] = estimates_view(
        results.values, {count, signed_size(kQuantities), signed_size(results.bands)}, owner);
    all["sunlit_fraction"] = estimates_view(
        results.sunlit_fraction, {signed_size(results.sunlit_fraction.size())}, owner);
    all["sunlit_area"] =
        estimates_view(results.sunlit_area, {signed_size(results.sunlit_area.size())}, owner);
    all["ratios"] =
        estimates_view(results.ratio_values, {count, signed_size(results.ratios)}, owner);
    all["sun_shade"] = parts_dict(
        results.sun_shade, times == CsvTimes::days ? &results.sunlit_fraction : nullptr, owner);
    if (!results.shares.empty()) {
        all["shares"] = estimates_view(
            results.shares, {count, signed_size(kGroupShares), signed_size(results.bands)}, owner);
    }
    return all;
}

void bind_result(py::module_& module) {
    py::class_<Result, std::shared_ptr<Result>>(module, "Result")
        .def_property_readonly(
            "values",
            [](const py::object& self) {
                const auto& r = self.cast<const Result&>();
                return estimates_view(
                    r.values,
                    {signed_size(r.organs()), signed_size(kQuantities), signed_size(r.bands)},
                    self);
            })
        .def_property_readonly(
            "sunlit_fraction",
            [](const py::object& self) {
                const auto& sunlit = self.cast<const Result&>().sunlit_fraction;
                return estimates_view(sunlit, {signed_size(sunlit.size())}, self);
            })
        .def_property_readonly(
            "ratios",
            [](const py::object& self) {
                const auto& r = self.cast<const Result&>();
                return estimates_view(
                    r.ratio_values, {signed_size(r.organs()), signed_size(r.ratios)}, self);
            })
        .def_property_readonly(
            "groups",
            [](const py::object& self) {
                return groups_dict(self.cast<const Result&>().groups, self);
            })
        .def_property_readonly(
            "origins",
            [](const py::object& self) {
                return origins_dict(self.cast<const Result&>().origins, self);
            })
        .def_property_readonly(
            "sensors",
            [](const py::object& self) { return sensors_dict(self.cast<const Result&>(), self); })
        .def_property_readonly(
            "sun_shade",
            [](const py::object& self) {
                return parts_dict(self.cast<const Result&>().sun_shade, nullptr, self);
            })
        .def_property_readonly("detectors", &detectors_of)
        .def_property_readonly("budget", &budget_of)
        .def_property_readonly("canopy", &canopy_of)
        .def_property_readonly("audit", &audit_of)
        .def_property_readonly("facts", &facts_of);
}

}  // namespace quasimc::python

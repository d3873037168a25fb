#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "bind.h"
#include "quasimc/result.h"
#include "quasimc/run_file.h"
#include "quasimc/series.h"

namespace quasimc::python {

/// A result with all estimates as they are reported.
[[nodiscard]] std::shared_ptr<Result> reported_result(Result result);
/// A sum over times with all estimates as they are reported.
[[nodiscard]] SeriesSum reported_sum(SeriesSum sum);

/// Makes all estimates of groups those that are reported.
void report_groups(GroupResults& groups);

/// A view of estimates owned by `owner`: the given shape and (mean, standard error, low,
/// high).
[[nodiscard]] py::object estimates_view(
    const std::vector<Estimate>& values, std::vector<py::ssize_t> shape, py::handle owner);

/// The light of sunlit and shaded parts, owned by `owner`; None without it.
/// @param hours  of sums over time: sunlit hours; null: not of sums
[[nodiscard]] py::object parts_dict(
    const SunShadeLight& light, const std::vector<Estimate>* hours, py::handle owner);

/// The light of groups, owned by `owner`.
[[nodiscard]] py::object groups_dict(
    const GroupResults& groups, py::handle owner, CsvTimes times = CsvTimes::time_steps);

/// The light by quantity and band of each origin, and that of its groups, owned by `owner`: a dict
/// by name.
/// @param origins  of a Result or a SeriesSum
template <typename Origins>
[[nodiscard]] py::dict origins_dict(const Origins& origins, py::handle owner) {
    py::dict all;
    for (const auto& origin : origins) {
        const std::size_t row = kQuantities * std::max<std::size_t>(origin.light.bands, 1);
        py::dict light;
        light["values"] = estimates_view(
            origin.light.values,
            {static_cast<py::ssize_t>(origin.light.values.size() / row),
             static_cast<py::ssize_t>(kQuantities), static_cast<py::ssize_t>(origin.light.bands)},
            owner);
        light["groups"] = groups_dict(origin.light.groups, owner);
        all[py::str(origin.name)] = light;
    }
    return all;
}

/// The light on sensors, owned by `owner`: values, sunlit_fraction, ratios and origins, and the
/// flux on the horizontal by band, if it is known; None without sensors.
/// @param all  a Result or a SeriesSum
template <typename Light>
[[nodiscard]] py::object sensors_dict(const Light& all, py::handle owner) {
    const auto& sensors = all.sensors;
    if (sensors == nullptr || sensors->bands == 0) {
        return py::none();
    }
    const std::size_t rows = sensors->values.size() / (kQuantities * sensors->bands);
    const auto count = static_cast<py::ssize_t>(rows);
    py::dict light;
    light["values"] = estimates_view(
        sensors->values,
        {count, static_cast<py::ssize_t>(kQuantities), static_cast<py::ssize_t>(sensors->bands)},
        owner);
    light["origins"] = origins_dict(sensors->origins, owner);
    py::list incident;
    for (const CanopyFractions& of_band : all.canopy) {
        incident.append(of_band.incident);
    }
    light["incident"] = incident;
    const auto put = [&](const char* name, const std::vector<Estimate>& values) {
        light[name] = estimates_view(values, {static_cast<py::ssize_t>(values.size())}, owner);
    };
    if constexpr (requires { sensors->sunlit_fraction; }) {
        put("sunlit_fraction", sensors->sunlit_fraction);
    } else {
        put("sunlit_hours", sensors->sunlit_hours);
    }
    return light;
}

}  // namespace quasimc::python

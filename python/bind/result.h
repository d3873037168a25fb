#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "bind.h"
#include "quasimc/result.h"
#include "quasimc/series.h"

namespace quasimc::python {

/// A result with all estimates as they are reported.
[[nodiscard]] std::shared_ptr<Result> reported_result(Result result);
/// A sum over times with all estimates as they are reported.
[[nodiscard]] SeriesSum reported_sum(SeriesSum sum);

/// A view of estimates owned by `owner`: the given shape and (mean, standard error, low,
/// high).
[[nodiscard]] py::object estimates_view(
    const std::vector<Estimate>& values, std::vector<py::ssize_t> shape, py::handle owner);

/// The light of groups, owned by `owner`.
[[nodiscard]] py::object groups_dict(const GroupResults& groups, py::handle owner);

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

}  // namespace quasimc::python

#pragma once

#include <memory>

#include "bind.h"
#include "quasimc/result.h"
#include "quasimc/series.h"

namespace quasimc::python {

/// A result all of whose estimates are as they are reported.
[[nodiscard]] std::shared_ptr<Result> reported_result(Result result);
/// The same of a sum over times.
[[nodiscard]] SeriesSum reported_sum(SeriesSum sum);

/// Estimates that live in `owner`, without a copy: the given shape and (mean, standard error, low,
/// high).
[[nodiscard]] py::object estimates_view(
    const std::vector<Estimate>& values, std::vector<py::ssize_t> shape, py::handle owner);

/// The light of groups, owned by `owner`.
[[nodiscard]] py::object groups_dict(const GroupResults& groups, py::handle owner);

}  // namespace quasimc::python

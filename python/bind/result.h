#pragma once

#include <memory>

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

}  // namespace quasimc::python

#pragma once

#include <vector>

#include <pybind11/numpy.h>

#include "bind.h"
#include "quasimc/result.h"
#include "sums/statistics.h"

namespace quasimc::python {

using Numbers = py::array_t<double, py::array::c_style>;

/// @param shape  of the estimates, to which an axis of (mean, standard error, low, high) is added
Numbers array_of(const std::vector<Estimate>& estimates, std::vector<py::ssize_t> shape);
/// Sizes of a contribution: one more, and one less. @param shape  (..., 2)
Numbers sizes_of(const std::vector<ContributionSize>& sizes, std::vector<py::ssize_t> shape);

/// The result of a computation, meanwhile without the lock of the interpreter.
template <typename Compute>
auto unlocked(const Compute& compute) {
    const py::gil_scoped_release release;
    return compute();
}

}  // namespace quasimc::python

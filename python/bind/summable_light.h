#pragma once

#include <vector>

#include <pybind11/numpy.h>

#include "bind.h"
#include "quasimc/result.h"
#include "sums/statistics.h"

namespace quasimc::python {

using Numbers = py::array_t<double, py::array::c_style>;

/// Sizes of a contribution: one more, and one less. @param shape  (..., 2)
Numbers sizes_of(const std::vector<ContributionSize>& sizes, std::vector<py::ssize_t> shape);

/// The result of a computation, meanwhile without the lock of the interpreter.
template <typename Compute>
auto unlocked(const Compute& compute) {
    const py::gil_scoped_release release;
    return compute();
}

}  // namespace quasimc::python

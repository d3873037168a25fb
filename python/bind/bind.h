#pragma once

// The Python module quasimc._core: one file for each part of the library, without logic of its own.
// The rest of the interface is in python/quasimc.

#include <pybind11/pybind11.h>

namespace quasimc::python {

namespace py = pybind11;

void bind_errors(py::module_& module);
void bind_scene(py::module_& module);
void bind_catalogues(py::module_& module);
void bind_sun(py::module_& module);
void bind_gap_fraction(py::module_& module);
void bind_result(py::module_& module);
void bind_summable_light(py::module_& module);
void bind_replicates(py::module_& module);
void bind_run(py::module_& module);
void bind_store(py::module_& module);
void bind_series(py::module_& module);
void bind_grow(py::module_& module);

}  // namespace quasimc::python

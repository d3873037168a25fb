#pragma once

#include "bind.h"
#include "quasimc/run_file.h"

namespace quasimc::python {

/// The lamps under control of a series: a dict for each [[control]].
[[nodiscard]] py::list controls_of(const TimeSeries& series, const Scene& scene);

}  // namespace quasimc::python

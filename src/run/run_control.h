#pragma once

#include "quasimc/run.h"

namespace quasimc {

/// The deadline of a run or a series: that of its caller, or RunSpec::max_seconds from now.
[[nodiscard]] Deadline deadline_of(const RunControl& control, const RunSpec& spec);

/// The piece of work that a run or a series is: that of its caller, or all of what begins now.
[[nodiscard]] Work work_of(const RunControl& control);

}  // namespace quasimc

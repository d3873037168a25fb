#pragma once

#include "quasimc/run.h"

namespace quasimc {

/// The deadline of a run or a series: the caller's, or RunSpec::max_seconds from now.
[[nodiscard]] Deadline deadline_of(const RunControl& control, const RunSpec& spec);

/// The progress of a run or a series: the caller's part of a larger one, or a new one.
[[nodiscard]] Work work_of(const RunControl& control);

}  // namespace quasimc

#pragma once

// Texts on lamps under control, for summaries.

#include <string>
#include <vector>

#include "runfile/run_file.h"

namespace quasimc {

/// "hps: on 04:00-11:00, 13:00-19:38, 13.6 h, 170 kWh, 12.0 mol m-2" for each control of a run;
/// several days as means. Empty without [[control]].
[[nodiscard]] std::vector<std::string> describe_controls(const RunFile& run);

}  // namespace quasimc

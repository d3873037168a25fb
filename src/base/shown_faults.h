#pragma once

#include <string>
#include <vector>

#include "quasimc/error.h"

namespace quasimc {

/// The texts of the first 50 faults, and then "... and 3 more" if there are others.
[[nodiscard]] std::vector<std::string> shown_faults(const std::vector<Fault>& faults);

}  // namespace quasimc

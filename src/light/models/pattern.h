#pragma once

#include <vector>

#include "quasimc/source.h"

namespace quasimc {

/// `borders` with each interval cut into pieces no longer than `longest`, at least `least` of them.
[[nodiscard]] std::vector<double> refined(
    const std::vector<double>& borders, double longest, int least);

}  // namespace quasimc

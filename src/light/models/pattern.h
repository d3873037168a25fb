#pragma once

#include <vector>

#include "quasimc/source.h"

namespace quasimc {

/// `borders` with each interval divided into at least `least` pieces of at most `longest`.
[[nodiscard]] std::vector<double> refined(
    const std::vector<double>& borders, double longest, int least);

}  // namespace quasimc

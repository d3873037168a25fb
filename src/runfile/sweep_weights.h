#pragma once

#include <vector>

#include "runfile/sweep.h"
#include "text/document.h"
#include "text/table_reader.h"

namespace quasimc {

/// Reads `weights` of [sweep]: a number for each point, or for each value of some keys, whose
/// product is the weight of a point.
/// @param sweep  the table
/// @param plan  with its points
/// @returns by point; empty without weights, and after a fault
[[nodiscard]] std::vector<double> read_weights(
    const Node& sweep, const SweepPlan& plan, Reporter& reporter);

}  // namespace quasimc

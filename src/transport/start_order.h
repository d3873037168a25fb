#pragma once

#include <cstdint>
#include <span>

#include "solvers/estimator.h"

namespace quasimc {

/// The place of a tile on a Morton curve (Morton 1966). @param column, row  less than 256
[[nodiscard]] std::uint32_t interleaved(std::uint32_t column, std::uint32_t row);

/// Sets workspace.order to the order in which to trace the starts (workspace.u0[i], u1[i]) so that
/// neighbours in time are neighbours in space: by group, then along a Morton curve (Morton 1966).
/// Stable and the same on every machine.
/// @param groups  light of each start, < group_count
void order_starts(
    std::span<const std::uint32_t> groups, std::uint32_t group_count, Workspace& workspace);

}  // namespace quasimc

#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace quasimc {

/// The index of a tile on a Morton curve (Morton 1966). @param column, row  less than 256
[[nodiscard]] std::uint32_t interleaved(std::uint32_t column, std::uint32_t row);

/// The starts of a block of paths, and the order in which to trace them. Each worker reuses them,
/// so that tracing allocates nothing.
struct PathStarts {
    std::vector<double> u0, u1;                   ///< position of each in the unit square
    std::vector<std::uint32_t> order;             ///< set by order_starts()
    std::vector<std::uint32_t> keys, key_counts;  // scratch
};

/// Sets starts.order so that neighbours in time are neighbours in space: by group, then along a
/// Morton curve (Morton 1966). Stable and the same on every machine.
/// @param groups  the source of each start, < group_count; empty: all of one
void order_starts(
    std::span<const std::uint32_t> groups, std::uint32_t group_count, PathStarts& starts);

}  // namespace quasimc

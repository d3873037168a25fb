#include "transport/start_order.h"

#include <algorithm>
#include <bit>

namespace quasimc {
namespace {

/// The low 8 bits of x moved to the even bits.
std::uint32_t spread(std::uint32_t x) {
    x = (x | (x << 4U)) & 0x0F0FU;
    x = (x | (x << 2U)) & 0x3333U;
    return (x | (x << 1U)) & 0x5555U;
}

}  // namespace

std::uint32_t interleaved(std::uint32_t column, std::uint32_t row) {
    return spread(column) | (spread(row) << 1U);
}

void order_starts(
    std::span<const std::uint32_t> groups, std::uint32_t group_count, PathStarts& starts) {
    const auto n = static_cast<std::uint32_t>(starts.u0.size());
    // About one start a tile, and at most 256 tiles a side.
    const auto bits =
        std::min(8U, static_cast<unsigned>(std::bit_width(n / group_count + 1U) - 1) / 2);
    const std::uint32_t tiles = 1U << (2 * bits);
    const auto side = static_cast<double>(1U << bits);
    starts.keys.resize(n);
    starts.order.resize(n);
    starts.key_counts.assign(std::size_t{group_count} * tiles + 1, 0);
    for (std::uint32_t i = 0; i < n; ++i) {
        const auto column = static_cast<std::uint32_t>(starts.u0[i] * side);
        const auto row = static_cast<std::uint32_t>(starts.u1[i] * side);
        const std::uint32_t group = groups.empty() ? 0 : groups[i];
        starts.keys[i] = group * tiles + interleaved(column, row);
        ++starts.key_counts[starts.keys[i] + 1];
    }
    for (std::size_t key = 1; key < starts.key_counts.size(); ++key) {
        starts.key_counts[key] += starts.key_counts[key - 1];
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        starts.order[starts.key_counts[starts.keys[i]]++] = i;
    }
}

}  // namespace quasimc

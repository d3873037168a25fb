// Monte Carlo: independent random numbers.
//
// Method   The number of a point and a dimension is 53 bits of the keyed bijection Philox2x64-10 of
//          the counter (point / 2, replicate and dimension), under a key made of seed and sequence.
//          Counter-based: no state, no order, no skipping.
// Paper    Salmon, Moraes, Dror and Shaw (2011), "Parallel random numbers: as easy as 1, 2, 3",
//          SC'11.
// Points   Any number, up to 2^64. Rounds of any size continue the same set.
// Variance V / n, the yardstick of the other samplers.
// Cost     Consecutive points some 4 ns a number, random access some 12 ns (bench/samplers).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "samplers/sampler.h"

namespace quasimc {

/// The two random words of a counter under a key: Philox2x64-10.
[[nodiscard]] std::array<std::uint64_t, 2> philox2x64(
    std::array<std::uint64_t, 2> counter, std::uint64_t key);

/// A number in [0, 1) that is independent of all those of other points, dimensions, replicates,
/// sequences and seeds. All samplers use it beyond their own dimensions or points.
[[nodiscard]] double random_number(
    const Stream& stream, std::uint64_t point, std::uint32_t dimension);

/// random_number of the points point, point + 1, ..., one for each element of `out`.
void random_numbers(
    const Stream& stream, std::uint64_t point, std::uint32_t dimension, std::span<double> out);

/// The sampler `monte_carlo` of the catalogue.
[[nodiscard]] std::unique_ptr<Sampler> make_monte_carlo();

}  // namespace quasimc

#pragma once

#include <cstddef>
#include <cstdint>

#include "samplers/hash.h"

namespace quasimc {

/// A key of owen_scramble, cut in two.
struct ScrambleKey {
    std::uint32_t odd_factor, summand;
    explicit constexpr ScrambleKey(std::uint64_t key)
        : odd_factor(static_cast<std::uint32_t>(key >> 32) | 1U),
          summand(static_cast<std::uint32_t>(key)) {}
};

/// See owen_scramble.
[[nodiscard]] constexpr std::uint32_t scrambled(std::uint32_t digits, ScrambleKey key) {
    digits ^= digits * 0x3d20adeaU;
    digits = digits * key.odd_factor + key.summand;
    digits ^= digits * 0x05526c56U;
    digits ^= digits * 0x53a22864U;
    return digits;
}

/// 32 more bits, of which a number uses 21: a function of its first 32 bits and the key.
[[nodiscard]] constexpr std::uint32_t more_bits(std::uint32_t first, ScrambleKey key) {
    return (first ^ (first >> 15)) * 0x2c1b3c6dU + key.odd_factor * 0x9e3779b9U;
}

/// Consecutive points of a Sobol sequence computed together: they differ in the lowest nibble.
inline constexpr int kSobolBlock = 16;

/// The loops over many points, compiled for a vector unit.
struct VectorLoops {
    /// The numbers of a block of points: `base` ^ `lowest[i]` are the digits of the i-th before
    /// they are scrambled.
    void (*scramble_block)(
        std::uint32_t base, const std::uint32_t* lowest, ScrambleKey key, double* out);
    /// The numbers `position` + i * `step`, in units of 2^-64, for i < `count`.
    void (*fill_lattice)(
        std::uint64_t position, std::uint64_t step, double* out, std::size_t count);
};

/// The loops for the vector unit of this machine. All variants compute the same bits.
[[nodiscard]] VectorLoops best_vector_loops();

}  // namespace quasimc

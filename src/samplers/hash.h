#pragma once

#include <bit>
#include <cstdint>

#include "samplers/sampler.h"

namespace quasimc {

/// Every bit of the result depends on every bit of `word`; a bijection of the 64-bit words.
/// The finalizer of SplitMix64: Steele, Lea and Flood (2014), "Fast splittable pseudorandom number
/// generators", with the constants of Stafford's variant 13.
[[nodiscard]] constexpr std::uint64_t mix64(std::uint64_t word) {
    word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9U;
    word = (word ^ (word >> 27)) * 0x94d049bb133111ebU;
    return word ^ (word >> 31);
}

/// The upper 64 bits of the product.
[[nodiscard]] constexpr std::uint64_t multiply_high(std::uint64_t a, std::uint64_t b) {
    __extension__ using Wide = unsigned __int128;
    return static_cast<std::uint64_t>((static_cast<Wide>(a) * b) >> 64);
}

/// Both halves of the 128-bit product in one word: a cheap hash of a pair.
[[nodiscard]] constexpr std::uint64_t fold(std::uint64_t a, std::uint64_t b) {
    return multiply_high(a, b) ^ (a * b);
}

/// 64 random bits for one dimension of one replicate of one point set; `part` is the round of a
/// lattice or the period of a sequence. Two independent products and one finalizer.
[[nodiscard]] constexpr std::uint64_t stream_key(
    const Stream& stream, std::uint64_t part, std::uint32_t dimension) {
    // The fractional parts of the square roots of 2, 3, 5, 7.
    const std::uint64_t run =
        fold(stream.seed ^ 0x6a09e667f3bcc909U, stream.sequence ^ 0xbb67ae8584caa73bU);
    const std::uint64_t coordinate = std::uint64_t{stream.replicate} << 32 | dimension;
    return mix64(run ^ fold(part ^ 0x3c6ef372fe94f82bU, coordinate ^ 0xa54ff53a5f1d36f1U));
}

/// high * 2^-32 + low * 2^-53, exactly, for low < 2^21: 53 random bits as a number in [0, 1).
/// Two halves because vector units convert 32-bit integers only.
[[nodiscard]] constexpr double unit_number(std::uint32_t high, std::uint32_t low) {
    return static_cast<double>(high) * 0x1p-32 +
           static_cast<double>(static_cast<std::int32_t>(low)) * 0x1p-53;
}

/// The upper 53 bits as a number in [0, 1).
[[nodiscard]] constexpr double unit_number(std::uint64_t bits) {
    return static_cast<double>(static_cast<std::int64_t>(bits >> 11)) * 0x1p-53;
}

/// The bits in opposite order.
[[nodiscard]] constexpr std::uint32_t reverse_bits(std::uint32_t word) {
    word = (word >> 16) | (word << 16);
    word = ((word >> 8) & 0x00ff00ffU) | ((word & 0x00ff00ffU) << 8);
    word = ((word >> 4) & 0x0f0f0f0fU) | ((word & 0x0f0f0f0fU) << 4);
    word = ((word >> 2) & 0x33333333U) | ((word & 0x33333333U) << 2);
    return ((word >> 1) & 0x55555555U) | ((word & 0x55555555U) << 1);
}

}  // namespace quasimc

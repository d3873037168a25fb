// Sobol's sequence under Owen's scrambling.
//
// Method   Digital sequence in base 2 with the direction numbers of Joe and Kuo; every dimension of
//          every replicate is scrambled on its own. A number is computed from the bits of its point
//          directly, without the point before.
// Scramble Let x be the 32 digits of a coordinate, read with the first digit as bit 0. Two
//          coordinates that agree in their first r digits then differ by 2^r times an odd number.
//          The scramble is x -> f(K g(x) + B) mod 2^32, K random and odd, B random, f and g fixed
//          maps whose bit k depends on bits 0 ... k of the argument only. Two points then have
//          exactly the joint distribution of Owen's nested uniform scrambling: equal in r digits,
//          different in the next, independent and uniform in the rest. So estimates are unbiased
//          and have Owen's variance (docs/theory/point-sets.md). Maps f and g have the form of the
//          hash of Laine and Karras. 21 more random digits fill the double.
// Papers   Joe and Kuo (2008), SIAM J. Sci. Comput. 30, 2635-2654. Owen (1995), "Randomly permuted
//          (t,m,s)-nets and (t,s)-sequences". Owen (2003), "Variance with alternative scramblings
//          of digital nets", ACM TOMACS 13, 363-378. Laine and Karras (2011), "Stratified sampling
//          for stochastic transparency", EGSR. Burley (2020), "Practical hash-based Owen
//          scrambling", JCGT 9(4).
// Points   Extensible: rounds continue the sequence under the same scramble; best at powers of two.
//          After every 2^32 points the sequence starts again under a new scramble: still unbiased,
//          but the parts are independent of each other.
// Dims     0 ... 31 are Sobol's. Beyond, each block of 32 dimensions repeats them with its points
//          in an order of its own (an Owen scramble of the index, which keeps pairs of neighbours):
//          every block is a scrambled net. More dimensions of the sequence itself would do harm to
//          few points: from dimension 47 on some pairs share their first digit throughout the first
//          128 points.
// Cost     Consecutive points some 1 ns a number, random access some 11 ns (bench/samplers).
#pragma once

#include <cstdint>
#include <memory>

#include "samplers/sampler.h"

namespace quasimc {

/// Dimensions with direction numbers of their own.
inline constexpr std::uint32_t kSobolDimensions = 32;

/// The first 32 digits of the unscrambled sequence, first digit in bit 0; dimension <
/// kSobolDimensions.
[[nodiscard]] std::uint32_t sobol_digits(std::uint32_t index, std::uint32_t dimension);

/// The scramble under a random key, on digits with the first one in bit 0. Bit k of the result
/// depends on bits 0 ... k of `digits` only, and is a bijection of them.
[[nodiscard]] std::uint32_t owen_scramble(std::uint32_t digits, std::uint64_t key);

/// The sampler `sobol` of the catalogue.
[[nodiscard]] std::unique_ptr<Sampler> make_sobol();

}  // namespace quasimc

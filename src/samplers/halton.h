// Halton's sequence under Owen's scrambling.
//
// Method   Dimension j is the radical inverse of the point's index in the j-th prime base,
//          scrambled on its own in every replicate (digit_scramble.h).
// Papers   Halton (1960), Numerische Mathematik 2, 84-90. Owen (2017), "A randomized Halton
//          algorithm in R", arXiv:1706.02808. Faure and Lemieux (2009), "Generalized Halton
//          sequences in 2008", ACM TOMACS 19, 15.
// Points   Extensible, any number: rounds continue the sequence under the same scramble. Each
//          dimension starts again under a new scramble after p^M points, a number between 2^24 and
//          2^32 that depends on its base p.
// Dims     0 ... 63 have the primes 2 ... 311; beyond, the numbers are those of monte_carlo. Fewer
//          points than the product of two bases fill the square of these dimensions no better than
//          random points: Sobol' and Korobov treat late dimensions more evenly.
// Cost     Consecutive points some 10 ns a number, random access some 27 ns (bench/samplers).
#pragma once

#include <cstdint>
#include <memory>

#include "samplers/sampler.h"

namespace quasimc {

/// Dimensions with a base of their own.
inline constexpr std::uint32_t kHaltonDimensions = 64;

/// The base of a dimension: the primes in order; dimension < kHaltonDimensions.
[[nodiscard]] std::uint32_t halton_base(std::uint32_t dimension);

/// The sampler `halton` of the catalogue.
[[nodiscard]] std::unique_ptr<Sampler> make_halton();

}  // namespace quasimc

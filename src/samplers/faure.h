// Faure's sequence under Owen's scrambling.
//
// Method   Digital sequence in base p = 11 whose generator matrix of dimension j is the j-th power
//          of Pascal's matrix mod p. A (0, 11)-sequence: every elementary box of volume p^-m holds
//          exactly one of p^m consecutive aligned points. Each dimension is scrambled on its own
//          (digit_scramble.h).
// Papers   Faure (1982), "Discrepance de suites associees a un systeme de numeration (en dimension
//          s)", Acta Arithmetica 41, 337-351. Owen (1995), "Randomly permuted (t,m,s)-nets and
//          (t,s)-sequences".
// Points   Extensible, any number, best at powers of 11: rounds continue the sequence under the
//          same scramble. It starts again under a new scramble after 11^9 points (kFaurePeriod).
// Dims     Blocks of 10 dimensions: the start and the first directions of a path. From the second
//          block on, each block takes the points in an order of its own, a scramble of the index:
//          every block is a scrambled net.
// Cost     Consecutive points some 28 ns a number, random access some 50 ns, twice that in later
//          blocks (bench/samplers).
#pragma once

#include <cstdint>
#include <memory>

#include "samplers/sampler.h"

namespace quasimc {

/// The base p.
inline constexpr std::uint32_t kFaureBase = 11;

/// Dimensions that are used jointly: an even number, so that no pair of them is cut.
inline constexpr std::uint32_t kFaureDimensions = 10;

/// p^M: the number of points of one scramble.
inline constexpr std::uint32_t kFaurePeriod = 2357947691;

/// The sampler `faure` of the catalogue.
[[nodiscard]] std::unique_ptr<Sampler> make_faure();

}  // namespace quasimc

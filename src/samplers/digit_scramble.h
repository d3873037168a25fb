#pragma once

#include <cstdint>
#include <vector>

#include "samplers/hash.h"

namespace quasimc {

/// Owen's scrambling of numbers in a prime base p, for Halton's and Faure's sequences.
///
/// The M digits of a coordinate are read as an integer, first digit least significant: two
/// coordinates whose first r digits agree differ by p^r times a unit mod p. The scramble is x ->
/// f(K x + B) mod p^M with K a random unit, B random, and f a fixed map that permutes digit k in a
/// way that depends on digits 0 ... k - 1 only. Any two points then have exactly the joint
/// distribution of Owen's nested uniform scrambling, so estimates are unbiased with Owen's
/// variance: see docs/theory/point-sets.md. Map f breaks up the straight lines that K x + B alone
/// would leave between two dimensions of large bases.
class DigitScramble {
  public:
    explicit DigitScramble(std::uint32_t base);

    /// p^M, the largest power of the base within 32 bits: the number of distinct points.
    [[nodiscard]] std::uint32_t period() const { return period_; }

    /// M.
    [[nodiscard]] int digits() const { return digits_; }

    /// K and B and the source of the digits beyond M.
    struct Key {
        std::uint64_t factor, summand, filling;
    };
    [[nodiscard]] Key key(std::uint64_t random_bits) const;

    /// The scrambled number in [0, 1) of the digits of x < period(), first digit least significant.
    /// Digits after digit M are random.
    [[nodiscard]] double coordinate(std::uint32_t x, const Key& key) const;

  private:
    std::uint32_t base_;
    std::uint32_t period_ = 0;
    std::uint32_t group_size_ = 0;  ///< digits are treated in groups: p^(digits of a group)
    std::uint64_t reciprocal_ = 0;  ///< for division by group_size_
    int groups_ = 0;
    int digits_ = 0;
    double scale_ = 0;
    std::vector<std::uint16_t> permuted_;  ///< for a group: f, then its digits in opposite order
};

}  // namespace quasimc

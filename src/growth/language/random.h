#pragma once

#include <cmath>
#include <cstdint>

namespace quasimc {

/// The generator of POSIX drand48: 48 bits of state.
class Posix48 {
  public:
    constexpr explicit Posix48(std::uint64_t state) : state_(state & kMask) {}

    /// The next number, from 0 to below 1.
    constexpr double next() {
        state_ = (state_ * kFactor + kIncrement) & kMask;
        return static_cast<double>(state_) * kUnit;
    }
    [[nodiscard]] constexpr std::uint64_t state() const { return state_; }

  private:
    static constexpr std::uint64_t kMask = (std::uint64_t{1} << 48U) - 1;
    static constexpr std::uint64_t kFactor = 0x5DEECE66D, kIncrement = 0xB;
    static constexpr double kUnit = 1.0 / static_cast<double>(kMask + 1);

    std::uint64_t state_;
};

/// The random functions of models: ran, nran, bran, biran, srand.
struct PlantRandom {
    Posix48 generator{0x330E};
    /// Second result of the last nran, with mean 0 and standard deviation 1. A new generator has
    /// one, as that of cpfg: its first nran is the mean.
    double second_normal = 0;
    bool has_second_normal = true;

    /// A uniform number between 0 and x.
    double ran(double x) { return x * generator.next(); }
    /// Restarts the generator. @param n  truncated, and taken modulo 2^32
    void srand(double n);
    /// A normal number (polar method, Marsaglia and Bray 1964).
    double nran(double mean, double deviation) {
        if (has_second_normal) {
            has_second_normal = false;
            return second_normal * deviation + mean;
        }
        return first_normal() * deviation + mean;
    }
    /// A beta number (Cheng 1978, algorithm BA). 0 if a is 0; not a number if the parameters allow
    /// none.
    double bran(double a, double b);
    /// How many of n uniform numbers are at most p. Not a number if n is above 10^9.
    double biran(double n, double p);

  private:
    double first_normal();
    double nonzero();
};

/// The generator that chooses among stochastic productions.
struct StochasticRandom {
    Posix48 generator{0};

    /// As cpfg seeds it in its window.
    static StochasticRandom seeded(std::uint16_t seed) {
        return {Posix48((std::uint64_t{155} << 32U) | seed)};
    }

    /// The next number, from 0 to below 1.
    double next() { return generator.next(); }
};

}  // namespace quasimc

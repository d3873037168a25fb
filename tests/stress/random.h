#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "quasimc/mesh.h"
#include "samplers/hash.h"

namespace quasimc::stress {

/// Random numbers that are the same on every machine: words of SplitMix64 in their order. Two calls
/// must not be arguments of one function, whose order of evaluation is unspecified, but may be
/// items of a list in braces.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(mix64(seed ^ 0x517cc1b727220a95U)) {}

    [[nodiscard]] std::uint64_t word() { return mix64(state_ += 0x9e3779b97f4a7c15U); }
    /// In [0, 1).
    [[nodiscard]] double unit() { return unit_number(word()); }
    [[nodiscard]] double between(double low, double high) { return low + (high - low) * unit(); }
    /// 10 to a power that is uniform between the two.
    [[nodiscard]] double power_of_ten(double low, double high) {
        return std::pow(10.0, between(low, high));
    }
    [[nodiscard]] bool chance(double probability) { return unit() < probability; }
    /// 0 to count - 1.
    [[nodiscard]] std::size_t below(std::size_t count) {
        return static_cast<std::size_t>(unit() * static_cast<double>(count));
    }
    template <typename T>
    [[nodiscard]] const T& pick(const std::vector<T>& choices) {
        return choices[below(choices.size())];
    }
    /// Uniform over the sphere.
    [[nodiscard]] Vec3 direction() {
        const double z = between(-1, 1);
        const double phi = between(0, 2 * std::numbers::pi);
        const double r = std::sqrt(1 - z * z);
        return {r * std::cos(phi), r * std::sin(phi), z};
    }
    /// Uniform in the cube [low, high]^3.
    [[nodiscard]] Vec3 in_cube(double low, double high) {
        return Vec3{between(low, high), between(low, high), between(low, high)};
    }

  private:
    std::uint64_t state_;
};

}  // namespace quasimc::stress

#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "samplers/hash.h"

namespace quasimc {

/// Numbers with a mean of 0, in random order, whose mean as an estimate has the standard error 1.
/// A single one is 0.
[[nodiscard]] inline std::vector<double> balanced_numbers(std::size_t count, std::uint64_t key) {
    const std::size_t pairs = count / 2;
    const auto n = static_cast<double>(count);
    const double size = std::sqrt(n * (n - 1) / (2 * static_cast<double>(pairs)));
    std::vector<double> numbers(count);
    for (std::size_t i = 0; i < 2 * pairs; ++i) {
        numbers[i] = i < pairs ? size : -size;
    }
    for (std::size_t i = count; i > 1; --i) {
        std::swap(numbers[i - 1], numbers[mix64(key + i) % i]);
    }
    return numbers;
}

}  // namespace quasimc

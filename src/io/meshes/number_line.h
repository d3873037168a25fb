#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec3.h"
#include "io/line_scanner.h"
#include "io/numbers.h"
#include "io/runfile/table_reader.h"

namespace quasimc {

/// The numbers on a line, all finite; nothing after a fault, which tells the `rule`.
[[nodiscard]] inline std::optional<std::vector<double>> numbers_of_line(
    std::string_view line, std::uint32_t line_number, const std::string& rule, Reporter& reporter) {
    std::vector<double> numbers;
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
        const std::optional<double> number = parse_real(word);
        if (!number || !std::isfinite(*number)) {
            reporter.fault(line_number, shown(word) + " is not a finite number", rule);
            return std::nullopt;
        }
        numbers.push_back(*number);
    }
    return numbers;
}

/// The point that starts at a number.
[[nodiscard]] inline Vec3 point_at(const std::vector<double>& numbers, std::size_t first) {
    return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

}  // namespace quasimc

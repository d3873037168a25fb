#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/vec3.h"
#include "text/line_scanner.h"
#include "text/numbers.h"
#include "text/table_reader.h"

namespace quasimc {

/// The numbers on a line, all finite; empty after a fault, which quotes the `rule`.
[[nodiscard]] inline std::optional<std::vector<double>> numbers_of_line(
    std::string_view line, std::uint32_t line_number, const std::string& rule, Reporter& reporter) {
    constexpr std::size_t kUsual = 16;
    std::vector<double> numbers;
    numbers.reserve(kUsual);
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

/// Calls take(numbers, line) for each line with numbers; '#' begins a comment. Reports faulty
/// lines, with the `rule`, and lines with another count of numbers.
template <typename Take>
void take_number_lines(
    std::string_view bytes,
    std::size_t count,
    const std::string& rule,
    Reporter& reporter,
    const Take& take) {
    LineScanner scanner(bytes);
    while (scanner.next() && !reporter.is_full()) {
        const std::string_view line = scanner.line().substr(0, scanner.line().find('#'));
        const auto numbers = numbers_of_line(line, scanner.number(), rule, reporter);
        if (numbers && numbers->size() == count) {
            take(*numbers, scanner.number());
        } else if (numbers && !numbers->empty()) {
            reporter.fault(scanner.number(), fmt::format("{} numbers", numbers->size()), rule);
        }
    }
}

/// The point whose coordinates start at an index.
[[nodiscard]] inline Vec3 point_at(const std::vector<double>& numbers, std::size_t first) {
    return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

}  // namespace quasimc

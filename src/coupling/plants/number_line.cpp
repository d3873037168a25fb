#include "coupling/plants/number_line.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/text.h"
#include "growth/language/format_values.h"

namespace quasimc {
namespace {

using NumberBuffer = std::array<char, 32>;

/// Writes a number as "%g" does. @returns the end of its text
char* write_six_digits(NumberBuffer& buffer, double value) {
    constexpr int kDigits = 6;
    return std::to_chars(
               buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general,
               kDigits)
        .ptr;
}

/// Whether a part of a format is a conversion that prints a turtle's number.
bool prints_number(const FormatPart& part) {
    constexpr int kMaxWidth = 100, kMaxPrecision = 30;  // far above their use
    return std::string_view("fFeEgG").find(part.kind) != std::string_view::npos &&
           part.flags.find_first_not_of("-+ 0") == std::string_view::npos &&
           part.width <= kMaxWidth && part.precision <= kMaxPrecision &&
           part.text.find_first_of("hLqjzt") == std::string_view::npos &&
           part.text.find("ll") == std::string_view::npos;
}

/// The number of conversions of a format; empty if one is no %f, %e or %g.
std::optional<std::size_t> count_conversions(std::string_view format) {
    std::size_t count = 0;
    while (!format.empty()) {
        const FormatPart part = take_format_part(format);
        if (part.kind == 0 || part.text == "%%") {
            continue;
        }
        if (!prints_number(part)) {
            return std::nullopt;
        }
        ++count;
    }
    return count;
}

}  // namespace

void append_six_digits(std::string& text, double value) {
    NumberBuffer buffer{};
    text.append(buffer.data(), write_six_digits(buffer, value));
}

double six_digits(double value) {
    if (!std::isfinite(value)) {
        return value;
    }
    NumberBuffer buffer{};
    double rounded = 0;
    std::from_chars(buffer.data(), write_six_digits(buffer, value), rounded);
    return rounded;
}

NumberLine::NumberLine(const TurtleLine& line, std::size_t max_numbers, Faults& faults) {
    if (!line.is_sent) {
        return;
    }
    const std::optional<std::size_t> count = count_conversions(line.format);
    if (count && *count <= max_numbers) {
        format_ = line.format;
        count_ = *count;
        return;
    }
    faults.add(
        {line.where, fmt::format("the format {} is invalid", shown(line.format)),
         fmt::format(
             "there {} {}, to be written by %f, %e or %g", max_numbers == 1 ? "is" : "are",
             counted(max_numbers, "number")),
         fmt::format("write '{}'", max_numbers == 1 ? "%g" : "%g %g %g")});
}

void NumberLine::append(std::string& text, std::span<const double> values) const {
    text += format_values(format_, values.first(count_)).text;
    text += '\n';
}

}  // namespace quasimc

#include "coupling/plants/number_line.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/text.h"

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

/// Limits of a format, far above its use.
constexpr std::size_t kMaxWidth = 100, kMaxPrecision = 30;

bool is_upper_case(char c) {
    return c >= 'A' && c <= 'Z';
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

/// Divides a format into conversions and the text about them.
class NumberLine::Parser {
  public:
    explicit Parser(std::string_view format) : rest_(format) {}

    /// The next conversion; empty at the end, or if is_invalid().
    std::optional<Number> next() {
        Number number;
        while (!rest_.empty()) {
            if (!take('%')) {
                number.text_before += rest_.front();
                rest_.remove_prefix(1);
            } else if (take('%')) {
                number.text_before += '%';
            } else {
                return conversion(std::move(number));
            }
        }
        text_after_ = std::move(number.text_before);
        return std::nullopt;
    }
    [[nodiscard]] bool is_invalid() const { return is_invalid_; }
    [[nodiscard]] const std::string& text_after() const { return text_after_; }

  private:
    std::optional<Number> conversion(Number number) {
        while (!rest_.empty() && std::string_view("-+ 0").find(rest_.front()) != rest_.npos) {
            set_flag(number, rest_.front());
            rest_.remove_prefix(1);
        }
        number.width = count(kMaxWidth);
        if (take('.')) {
            number.precision = static_cast<int>(count(kMaxPrecision));
        }
        take('l');
        constexpr std::string_view kConversions = "fFeEgG";
        if (rest_.empty() || kConversions.find(rest_.front()) == std::string_view::npos) {
            is_invalid_ = true;
        }
        if (is_invalid_) {
            return std::nullopt;
        }
        number.conversion = rest_.front();
        rest_.remove_prefix(1);
        return number;
    }

    static void set_flag(Number& number, char flag) {
        if (flag == '-') {
            number.is_left = true;
        } else if (flag == '0') {
            number.has_zeros = true;
        } else if (number.plus != "+") {
            number.plus = flag;
        }
    }

    bool take(char c) {
        const bool is_there = rest_.starts_with(c);
        rest_.remove_prefix(is_there ? 1 : 0);
        return is_there;
    }

    /// Digits, 0 if there are none.
    std::size_t count(std::size_t most) {
        std::size_t value = 0;
        const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
        is_invalid_ = is_invalid_ || value > most || error == std::errc::result_out_of_range;
        rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
        return value;
    }

    std::string_view rest_;
    std::string text_after_;
    bool is_invalid_ = false;
};

NumberLine::NumberLine(const TurtleLine& line, std::size_t max_numbers, Faults& faults) {
    if (!line.is_sent) {
        return;
    }
    Parser parser(line.format);
    while (auto number = parser.next()) {
        numbers_.push_back(std::move(*number));
    }
    text_after_ = parser.text_after();
    if (parser.is_invalid() || numbers_.size() > max_numbers) {
        numbers_.clear();
        faults.add(
            {line.where, fmt::format("the format {} is invalid", shown(line.format)),
             fmt::format(
                 "there {} {}, to be written by %f, %e or %g", max_numbers == 1 ? "is" : "are",
                 counted(max_numbers, "number")),
             fmt::format("write '{}'", max_numbers == 1 ? "%g" : "%g %g %g")});
    }
}

void NumberLine::append(std::string& text, std::span<const double> values) const {
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
        text += numbers_[i].text_before;
        append_number(text, numbers_[i], values[i]);
    }
    text += text_after_;
    text += '\n';
}

void NumberLine::append_number(std::string& text, const Number& number, double value) {
    const char lower = is_upper_case(number.conversion)
                           ? static_cast<char>(number.conversion - 'A' + 'a')
                           : number.conversion;
    const auto format = lower == 'f'   ? std::chars_format::fixed
                        : lower == 'e' ? std::chars_format::scientific
                                       : std::chars_format::general;
    std::array<char, 400> buffer{};  // for all numbers with kMaxPrecision decimals
    const auto [end, error] = std::to_chars(
        buffer.data(), buffer.data() + buffer.size(), std::abs(value), format, number.precision);
    std::string digits(buffer.data(), end);
    if (lower != number.conversion) {
        std::transform(digits.begin(), digits.end(), digits.begin(), [](char c) {
            return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
        });
    }
    const std::string sign = std::signbit(value) ? "-" : number.plus;
    const std::size_t size = sign.size() + digits.size();
    const std::string padding(number.width - std::min(number.width, size), ' ');
    const bool has_zeros = number.has_zeros && !number.is_left && std::isfinite(value);
    if (number.is_left) {
        text += sign + digits + padding;
    } else if (has_zeros) {
        text += sign + std::string(padding.size(), '0') + digits;
    } else {
        text += padding + sign + digits;
    }
}

}  // namespace quasimc

#include "base/number_text.h"

#include <fmt/format.h>

namespace quasimc {

std::string counted(std::uint64_t count, std::string_view noun, std::string_view plural) {
    if (count == 1 || plural.empty()) {
        return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
    }
    return fmt::format("{} {}", count, plural);
}

std::string two_digits(double error) {
    constexpr double kFrom = 99.5, kTo = 1e6;  // where {:.2g} has an exponent that is not needed
    std::string text = fmt::format("{:.2g}", error);
    return error >= kFrom && error < kTo ? fmt::format("{:.0f}", std::stod(text)) : text;
}

std::string with_decimals(double value, int decimals) {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
    return is_zero && text.front() == '-' ? text.substr(1) : text;
}

}  // namespace quasimc

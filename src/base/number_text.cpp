#include "base/number_text.h"

#include <cmath>

#include <fmt/format.h>

namespace quasimc {

std::string counted(std::uint64_t count, std::string_view noun, std::string_view plural) {
    if (count == 1 || plural.empty()) {
        return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
    }
    return fmt::format("{} {}", count, plural);
}

std::string error_text(double error) {
    constexpr double kFrom = 9.5, kTo = 1e6;  // where {:.1g} has an exponent that is not needed
    constexpr double kTwoDigits = 2.95;       // rounds to 3, of which one digit is enough
    const double front = error / std::pow(10, std::floor(std::log10(error)));
    std::string text = fmt::format("{:.{}g}", error, front < kTwoDigits ? 2 : 1);
    return error >= kFrom && error < kTo ? fmt::format("{:.0f}", std::stod(text)) : text;
}

std::string with_decimals(double value, int decimals) {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
    return is_zero && text.front() == '-' ? text.substr(1) : text;
}

}  // namespace quasimc

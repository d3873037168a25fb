#include "results/units.h"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "base/length_units.h"
#include "base/text.h"

namespace quasimc {
namespace {

/// Square metres of a square unit of length; nothing for an unknown unit.
std::optional<double> square_metres_per(std::string_view length_unit) {
    const std::optional<double> metres = metres_per(length_unit);
    return metres ? std::optional(*metres * *metres) : std::nullopt;
}

/// A unit without one of its words.
std::string without_word(std::string_view unit, std::size_t begin, std::size_t size) {
    const std::string rest =
        std::string(unit.substr(0, begin)) + std::string(unit.substr(begin + size));
    const std::string_view plain = trimmed(rest);
    return plain.empty() ? "1" : std::string(plain);
}

/// "1e-4" for a power of ten, otherwise all digits.
std::string factor_text(double factor) {
    const double power = std::round(std::log10(factor));
    const bool is_power = std::abs(factor / std::pow(10, power) - 1) < 1e-12;
    return is_power ? fmt::format("1e{:.0f}", power) : fmt::format("{:.10g}", factor);
}

}  // namespace

FluxUnit named_flux_unit(const std::string& irradiance_unit, const std::string& length_unit) {
    if (length_unit.empty()) {
        return {1, ""};  // the plant's lengths have no unit
    }
    constexpr std::string_view kPer = "-2";
    const std::string unit = irradiance_unit == "lx" ? "lm m-2" : irradiance_unit;
    const std::optional<double> square = square_metres_per(length_unit);
    for (std::size_t begin = 0; begin < unit.size();) {
        const std::size_t end = std::min(unit.find(' ', begin), unit.size());
        std::string_view word = std::string_view(unit).substr(begin, end - begin);
        if (word.ends_with(kPer)) {
            word.remove_suffix(kPer.size());
            const std::optional<double> per = square_metres_per(word);
            if (word == length_unit || (square && per)) {
                const double factor = word == length_unit ? 1 : *square / *per;
                // Includes the space before it.
                const std::size_t first = begin == 0 ? 0 : begin - 1;
                return {factor, without_word(unit, first, end - first)};
            }
        }
        begin = end + 1;
    }
    return {1, irradiance_unit + " " + length_unit + "2"};
}

std::string flux_unit(const std::string& irradiance_unit, const std::string& length_unit) {
    const FluxUnit unit = named_flux_unit(irradiance_unit, length_unit);
    return unit.factor == 1 ? unit.name : factor_text(unit.factor) + " " + unit.name;
}

SummedUnit summed_unit(const std::string& unit) {
    constexpr double kMicro = 1e-6;
    if (!unit.empty() && unit.front() >= '0' && unit.front() <= '9') {  // "1e-4 W"
        const std::size_t end = std::min(unit.find(' '), unit.size() - 1) + 1;
        SummedUnit summed = summed_unit(unit.substr(end));
        summed.name = unit.substr(0, end) + summed.name;
        return summed;
    }
    if (unit.starts_with("W ") || unit == "W") {
        return {"J" + unit.substr(1), 1};
    }
    constexpr std::string_view kPerSecond = " s-1";
    const std::size_t per_second = unit.find(kPerSecond);
    if (unit.starts_with("umol ") && per_second != std::string::npos) {
        return {
            unit.substr(1, per_second - 1) + unit.substr(per_second + kPerSecond.size()), kMicro};
    }
    return {unit + " s", 1};
}

std::string unit_of(
    const QuantityEntry& quantity, const Band& band, const std::string& length_unit) {
    return quantity.is_flux ? flux_unit(band.unit, length_unit) : band.unit;
}

}  // namespace quasimc

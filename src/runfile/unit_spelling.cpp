#include "runfile/unit_spelling.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <optional>
#include <utility>
#include <vector>

#include "base/text.h"

namespace quasimc {
namespace {

/// A symbol and its power: m and -2.
struct UnitFactor {
    std::string symbol;
    int power = 1;

    bool operator<(const UnitFactor& other) const { return symbol < other.symbol; }
    bool operator==(const UnitFactor& other) const {
        return symbol == other.symbol && power == other.power;
    }
};
using UnitFactors = std::vector<UnitFactor>;

/// Characters with their plain spelling, in the order in which they are replaced.
constexpr std::array<std::pair<std::string_view, std::string_view>, 19> kPlain{
    {{"µ", "u"},
     {"μ", "u"},
     {"⁻", "-"},
     {"−", "-"},
     {"⁰", "0"},
     {"¹", "1"},
     {"²", "2"},
     {"³", "3"},
     {"⁴", "4"},
     {"⁵", "5"},
     {"⁶", "6"},
     {"⁷", "7"},
     {"⁸", "8"},
     {"⁹", "9"},
     {"·", "*"},
     {"⋅", "*"},
     {"**", "^"},
     {".", "*"},
     {"lux", "lx"}}};

/// The units that daylight and lamps are converted to.
constexpr std::array<std::string_view, 3> kKnown{"umol m-2 s-1", "W m-2", "lx"};

std::string plain(std::string_view given) {
    std::string text(given);
    for (const auto& [from, to] : kPlain) {
        for (std::size_t at = text.find(from); at != std::string::npos;
             at = text.find(from, at + to.size())) {
            text.replace(at, from.size(), to);
        }
    }
    return text;
}

bool is_letter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

/// Removes a symbol with its power, "m-2" or "m^-2", from the front of a text; empty if none is
/// there.
std::optional<UnitFactor> take_factor(std::string_view& text) {
    const auto end = std::find_if_not(text.begin(), text.end(), is_letter);
    UnitFactor factor{std::string(text.begin(), end)};
    text.remove_prefix(factor.symbol.size());
    const bool has_sign = text.starts_with('^');
    text.remove_prefix(has_sign ? 1 : 0);
    const auto [rest, error] =
        std::from_chars(text.data(), text.data() + text.size(), factor.power);
    const bool has_power = rest != text.data();
    if (factor.symbol.empty() || error == std::errc::result_out_of_range ||
        (has_sign && !has_power)) {
        return std::nullopt;
    }
    text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
    return factor;
}

/// Removes the sign between two factors, " ", "*" or "/", from the front of a text; 0 for others.
char take_operator(std::string_view& text) {
    const std::string_view rest = trimmed(text);
    const bool has_sign = rest.starts_with('*') || rest.starts_with('/');
    const char sign = has_sign ? rest.front() : rest.size() < text.size() ? ' ' : '\0';
    text = has_sign ? trimmed(rest.substr(1)) : rest;
    return sign;
}

/// The factors of a text of plain characters; empty if it has another form.
UnitFactors factors_of(std::string_view text) {
    UnitFactors factors;
    bool is_quotient = false;
    for (char sign = ' '; !text.empty(); sign = take_operator(text)) {
        std::optional<UnitFactor> factor = take_factor(text);
        if (!factor || sign == '\0' || (is_quotient && sign != '/')) {
            return {};
        }
        is_quotient = sign == '/';
        factor->power *= is_quotient ? -1 : 1;
        factors.push_back(std::move(*factor));
    }
    return factors;
}

/// The ASCII letters of a text, in lower case.
std::string letters_of(std::string_view text) {
    std::string letters = lower_case(text);
    std::erase_if(letters, [](char c) { return !is_letter(c); });
    return letters;
}

UnitFactors sorted(UnitFactors factors) {
    std::sort(factors.begin(), factors.end());
    return factors;
}

}  // namespace

std::string standard_unit(std::string_view given) {
    const UnitFactors factors = factors_of(plain(trimmed(given)));
    if (factors.empty()) {
        return std::string(given);
    }
    for (const std::string_view known : kKnown) {
        if (sorted(factors_of(known)) == sorted(factors)) {
            return std::string(known);
        }
    }
    std::string unit;
    for (const UnitFactor& factor : factors) {
        unit += (unit.empty() ? "" : " ") + factor.symbol;
        unit += factor.power == 1 ? "" : std::to_string(factor.power);
    }
    return unit;
}

std::string_view unit_of_same_letters(std::string_view unit) {
    const std::string letters = letters_of(unit);
    const auto same = std::find_if(kKnown.begin(), kKnown.end(), [&](std::string_view known) {
        return letters_of(known) == letters;
    });
    return same == kKnown.end() ? "" : *same;
}

}  // namespace quasimc

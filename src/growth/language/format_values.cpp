#include "growth/language/format_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>

#include <fmt/format.h>

namespace quasimc {
namespace {

constexpr int kMaxFieldWidth = 1000;

/// Removes the characters of a set from the start of a text.
std::string_view take_characters(std::string_view& text, std::string_view set) {
    const std::string_view taken = text.substr(0, text.find_first_not_of(set));
    text.remove_prefix(taken.size());
    return taken;
}

int take_field_width(std::string_view& text) {
    int width = 0;
    for (const char digit : take_characters(text, "0123456789")) {
        width = std::min(width * 10 + (digit - '0'), kMaxFieldWidth);
    }
    return width;
}

/// A number in its field. The format of snprintf is made from checked parts only.
std::string format_field(double value, const FormatPart& part) {
    constexpr double kTwoTo63 = 9223372036854775808.0;
    std::array<char, kMaxFieldWidth + 400> buffer{};
    const std::string width = part.width > 0 ? std::to_string(part.width) : "";
    const std::string precision = part.precision < 0 ? "" : fmt::format(".{}", part.precision);
    std::string format = fmt::format("%{}{}{}", part.flags, width, precision);
    if (part.is_real()) {
        format += part.kind;
        std::snprintf(buffer.data(), buffer.size(), format.c_str(), value);
    } else if (std::abs(value) < kTwoTo63) {
        const bool is_decimal = std::string_view("diuc").find(part.kind) != std::string_view::npos;
        format += std::string("ll") + (is_decimal ? 'd' : part.kind);
        std::snprintf(buffer.data(), buffer.size(), format.c_str(), static_cast<long long>(value));
    } else {
        std::snprintf(buffer.data(), buffer.size(), "%.0f", value);
    }
    return buffer.data();
}

}  // namespace

bool FormatPart::is_real() const {
    return kind != 0 && std::string_view("eEfFgGaA").find(kind) != std::string_view::npos;
}

bool FormatPart::is_number() const {
    return is_real() || (kind != 0 && std::string_view("diucoxX").find(kind) != text.npos);
}

FormatPart take_format_part(std::string_view& format) {
    const std::string_view start = format;
    FormatPart part;
    if (format[0] != '%') {
        format.remove_prefix(std::min(format.find('%'), format.size()));
    } else {
        format.remove_prefix(1);
        part.flags = take_characters(format, "-+ #0'*");
        part.width = take_field_width(format);
        if (format.starts_with('.')) {
            format.remove_prefix(1);
            part.precision = take_field_width(format);
        }
        take_characters(format, "hlLqjzt");
        part.kind = format.empty() ? '?' : format[0];
        format.remove_prefix(format.empty() ? 0 : 1);
    }
    part.text = start.substr(0, start.size() - format.size());
    return part;
}

FormattedText format_values(std::string_view format, std::span<const double> values) {
    constexpr std::size_t kMaxText = std::size_t{1} << 20U;
    FormattedText result;
    std::size_t used = 0;
    while (!format.empty() && result.text.size() <= kMaxText) {
        const FormatPart part = take_format_part(format);
        const bool is_refused = part.kind == 's' || part.kind == 'p' || part.kind == 'n';
        const bool is_starred = part.flags.find('*') != part.flags.npos;
        if (is_starred || !(part.is_number() || is_refused)) {
            result.text += part.kind == '%' ? "%" : part.text;
            continue;
        }
        if (used == values.size()) {
            result.problems.emplace_back("the format has more conversions than arguments");
        }
        const double value = used < values.size() ? values[used] : 0;
        ++used;
        if (is_refused) {
            result.problems.push_back(fmt::format("%{} can't print a number, use %g", part.kind));
        } else {
            result.text += format_field(value, part);
        }
    }
    if (result.text.size() > kMaxText) {
        result.text.resize(kMaxText);
        result.problems.emplace_back("the text is cut after 1 MiB");
    }
    return result;
}

}  // namespace quasimc

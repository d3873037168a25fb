#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace quasimc {

/// A text with numbers in it.
struct FormattedText {
    std::string text;
    std::vector<std::string> problems;  ///< errors of the format, to be sent as warnings
};

/// Formats numbers as C's printf does. Integer conversions print the truncated number. A missing
/// value is 0; %s, %p and %n print nothing. Each of these is a problem. Widths and precisions are
/// at most 1000, and the text has at most 1 MiB.
[[nodiscard]] FormattedText format_values(std::string_view format, std::span<const double> values);

/// A part of a format of printf or scanf: plain text, or %[flags][width][.precision][size]kind.
struct FormatPart {
    std::string_view text;   ///< as written
    std::string_view flags;  ///< also scanf's *
    int width = 0;           ///< 0: none
    int precision = -1;      ///< -1: none
    char kind = 0;           ///< 0 for plain text

    [[nodiscard]] bool is_real() const;    ///< one of e f g a
    [[nodiscard]] bool is_number() const;  ///< is_real, or one of d i u c o x
};

/// Removes a part from the start of a format that is not empty.
[[nodiscard]] FormatPart take_format_part(std::string_view& format);

}  // namespace quasimc

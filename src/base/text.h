#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace quasimc {

/// The candidate nearest to `word` (edit distance with transpositions, ignoring case), or "" if
/// none is near enough.
[[nodiscard]] std::string_view nearest_word(
    std::string_view word, std::span<const std::string_view> candidates);

/// "did you mean 'x'?" for an unknown word, or "" when no candidate is near.
[[nodiscard]] std::string near_word_text(
    std::string_view word, std::span<const std::string_view> candidates);

/// The same, or "use one of a, b, c" when none is near.
[[nodiscard]] std::string did_you_mean(
    std::string_view word, std::span<const std::string_view> candidates);

/// The shortest text that reads back as the same double ("0.1", "1e-05").
[[nodiscard]] std::string shortest(double value);

/// A text with its ASCII letters in lower case.
[[nodiscard]] std::string lower_case(std::string_view text);

[[nodiscard]] std::string_view trimmed(std::string_view text);

/// Whether the bytes are UTF-8.
[[nodiscard]] bool is_utf8(std::string_view text);

/// A text for a terminal: control characters except newlines become blanks, bytes that are not
/// UTF-8 become '?'.
[[nodiscard]] std::string printable(std::string_view text);

/// A text on one line: control characters become blanks. Bytes that are not UTF-8 stay.
[[nodiscard]] std::string one_line(std::string_view text);

/// A word for a message: quoted, shortened, ASCII only.
[[nodiscard]] std::string shown(std::string_view word);

/// The items joined by `separator`.
[[nodiscard]] std::string joined(
    std::span<const std::string_view> items, std::string_view separator);

}  // namespace quasimc

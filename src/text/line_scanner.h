#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/text.h"

namespace quasimc {

/// The text without a byte-order mark.
[[nodiscard]] inline std::string_view without_bom(std::string_view text) {
    return text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text;
}

/// The lines of a text, with or without carriage returns, counted from 1.
class LineScanner {
  public:
    explicit LineScanner(std::string_view text) : rest_(without_bom(text)) {}

    /// Goes to the next line; false at the end.
    bool next() {
        if (rest_.empty()) {
            return false;
        }
        const std::size_t end = rest_.find('\n');
        line_ = rest_.substr(0, end);
        rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
        if (line_.ends_with('\r')) {
            line_.remove_suffix(1);
        }
        ++number_;
        return true;
    }
    [[nodiscard]] std::string_view line() const { return line_; }
    [[nodiscard]] std::uint32_t number() const { return number_; }
    [[nodiscard]] std::string_view rest() const { return rest_; }

  private:
    std::string_view rest_, line_;
    std::uint32_t number_ = 0;
};

/// Blanks within a line.
inline constexpr std::string_view kBlanks = " \t\r\v\f";

/// A set of characters, with a fast test.
class Separators {
  public:
    constexpr Separators(std::string_view characters) {  // NOLINT(*-explicit-*)
        for (const char c : characters) {
            words_[index(c) / 64] |= std::uint64_t{1} << index(c) % 64;
        }
    }
    constexpr Separators(const char* characters)  // NOLINT(*-explicit-*)
        : Separators(std::string_view{characters}) {}
    [[nodiscard]] constexpr bool has(char c) const {
        return (words_[index(c) / 64] >> index(c) % 64 & 1) != 0;
    }

  private:
    static constexpr std::size_t index(char c) { return static_cast<unsigned char>(c); }
    std::array<std::uint64_t, 4> words_{};
};

inline constexpr Separators kBetweenWords = kBlanks;

/// Removes the next word between `separators` from a line; "" at its end.
[[nodiscard]] inline std::string_view take_word(
    std::string_view& line, const Separators& separators = kBetweenWords) {
    const auto is_separator = [&](char c) { return separators.has(c); };
    const auto begin = std::find_if_not(line.begin(), line.end(), is_separator);
    const auto end = std::find_if(begin, line.end(), is_separator);
    line.remove_prefix(static_cast<std::size_t>(end - line.begin()));
    return {begin, end};
}

/// The words of a line, separated by one blank.
[[nodiscard]] std::string rest_of_line(std::string_view line);

}  // namespace quasimc

#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace quasimc {

/// The text without the byte-order mark that some editors put in front.
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

/// Takes the next word off a line, between `separators`; "" at its end.
[[nodiscard]] inline std::string_view take_word(
    std::string_view& line, std::string_view separators = kBlanks) {
    const std::size_t begin = line.find_first_not_of(separators);
    if (begin == std::string_view::npos) {
        line = {};
        return {};
    }
    line.remove_prefix(begin);
    const std::string_view word = line.substr(0, line.find_first_of(separators));
    line.remove_prefix(word.size());
    return word;
}

/// A word as a message shows it: not too long, nothing unprintable.
[[nodiscard]] std::string shown(std::string_view word);

/// A text on one line: control characters become blanks.
[[nodiscard]] std::string one_line(std::string text);

/// Whether the bytes are UTF-8.
[[nodiscard]] bool is_utf8(std::string_view text);

}  // namespace quasimc

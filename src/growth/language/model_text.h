#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "growth/language/preprocessor.h"
#include "quasimc/error.h"

namespace quasimc {

/// An error in the text of a model. It ends the reading of a production or block.
struct SyntaxError {
    std::size_t position = 0;
    std::string problem, why, suggestion;
};

/// The text of a model and the position of its reader.
class ModelText {
  public:
    /// @param text  outlives the object
    explicit ModelText(const PreprocessedText& text) : source_(text), text_(text.text) {}

    /// The next character; 0 at the end.
    [[nodiscard]] char peek(std::size_t ahead = 0) const {
        return position_ + ahead < text_.size() ? text_[position_ + ahead] : '\0';
    }
    [[nodiscard]] bool at_end() const { return position_ >= text_.size(); }
    /// Whether a newline that ends a line comes next; one before a tab does not.
    [[nodiscard]] bool at_line_end() const {
        return at_end() || (peek() == '\n' && peek(1) != '\t');
    }
    void advance(std::size_t count = 1) { position_ += count; }

    /// Skips blanks, and newlines before a tab.
    void skip_blanks();
    /// Skips blanks and all newlines.
    void skip_space();
    /// Goes to the start of the next line that is no continuation.
    void skip_line();

    [[nodiscard]] bool starts_with(std::string_view word) const {
        return text_.substr(std::min(position_, text_.size())).starts_with(word);
    }
    /// Skips a word if it comes next.
    bool take(std::string_view word);
    /// Skips words separated by blanks, each with a first letter of any case, if they come next.
    bool take_keyword(std::string_view words);
    /// Reads a name of letters, digits and underscores; "" if none comes next.
    std::string_view take_name();

    [[nodiscard]] std::size_t position() const { return position_; }
    void set_position(std::size_t position) { position_ = position; }
    /// The line of a position, from 0.
    [[nodiscard]] std::uint32_t line_of(std::size_t position) const;
    /// "file:line:column" of a position.
    [[nodiscard]] std::string where(std::size_t position) const;
    [[nodiscard]] std::string_view text() const { return text_; }
    /// The next characters, for messages.
    [[nodiscard]] std::string shown_next() const;

    /// @throws SyntaxError  at the current position
    [[noreturn]] void fail(
        std::string problem, std::string why = "", std::string suggestion = "") const;

  private:
    const PreprocessedText& source_;
    std::string_view text_;
    std::size_t position_ = 0;
    mutable std::size_t counted_to_ = 0;  // newlines before it are counted
    mutable std::uint32_t newlines_ = 0;
};

}  // namespace quasimc

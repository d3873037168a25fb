#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace quasimc {

/// Reads a JSON text (RFC 8259) from its beginning to its end and keeps nothing of it: for long
/// texts of which little is wanted. What is passed over is checked as well, but not whether strings
/// are UTF-8. Every function throws InputError, "byte 12: not JSON", at what it can't read.
class JsonScanner {
  public:
    enum class Kind { object, list, string, number, word };

    /// @param text  must outlive the scanner
    /// @param path  of it, for messages
    JsonScanner(std::string_view text, std::string_view path) : text_(text), path_(path) {}

    /// Of the value that comes next.
    [[nodiscard]] Kind kind();

    /// Reads an object. @param member  is called with each key, which it may use until it reads on;
    /// must read the value or skip it
    template <typename Member>
    void object(const Member& member) {
        if (begins('{', '}')) {
            do {
                member(key());
            } while (goes_on('}'));
        }
    }

    /// Reads a list. @param item  is called with the number of each value, from 0; must read the
    /// value or skip it
    template <typename Item>
    void list(const Item& item) {
        if (begins('[', ']')) {
            std::size_t index = 0;
            do {
                item(index++);
            } while (goes_on(']'));
        }
    }

    [[nodiscard]] double number();
    [[nodiscard]] std::string text();

    /// Passes over a value of any kind. @returns its text
    std::string_view skip();

    /// Where in the text the next value begins.
    [[nodiscard]] std::size_t place() {
        pass_blanks();
        return at_;
    }

    /// Nothing may follow.
    void end();

  private:
    [[noreturn]] void refuse() const;
    void pass_blanks() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n' ||
                                      text_[at_] == '\t' || text_[at_] == '\r')) {
            ++at_;
        }
    }
    /// The next character that is no blank.
    [[nodiscard]] char peek() {
        pass_blanks();
        return at_ < text_.size() ? text_[at_] : '\0';
    }
    void pass(char expected) {
        if (peek() != expected) {
            refuse();
        }
        ++at_;
    }
    [[nodiscard]] bool is_digit() const {
        return at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9';
    }

    /// Passes over a bracket. @returns whether there is anything before the one that closes it
    bool begins(char open, char close);
    /// After a value of an object or a list: passes over a comma or the bracket that closes it.
    /// @returns whether another value follows
    bool goes_on(char close);
    [[nodiscard]] std::string_view key();
    /// Passes over a string. @returns it with its quotes
    std::string_view pass_string();
    void pass_escape();
    void pass_digits();
    void pass_number();
    void pass_word();
    /// Passes over a value that is no object and no list.
    void pass_single();

    std::string_view text_, path_;
    std::size_t at_ = 0;
    std::string key_;   // the last one, if it has escapes
    std::string open_;  // brackets of what is passed over
};

}  // namespace quasimc

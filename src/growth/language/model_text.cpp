#include "growth/language/model_text.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "base/text.h"

namespace quasimc {
namespace {

bool is_name_character(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

bool is_letter_of_any_case(char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) ==
           std::tolower(static_cast<unsigned char>(b));
}

}  // namespace

void ModelText::skip_blanks() {
    while (peek() == ' ' || peek() == '\t' || peek() == '\r' ||
           (peek() == '\n' && peek(1) == '\t')) {
        advance();
    }
}

void ModelText::skip_space() {
    while (peek() == ' ' || peek() == '\t' || peek() == '\r' || peek() == '\n') {
        advance();
    }
}

void ModelText::skip_line() {
    while (!at_line_end()) {
        advance();
    }
    advance();
}

bool ModelText::take(std::string_view word) {
    if (!starts_with(word)) {
        return false;
    }
    advance(word.size());
    return true;
}

bool ModelText::take_keyword(std::string_view words) {
    const std::size_t before = position_;
    bool is_first = true;
    for (const char c : words) {
        if (c == ' ') {
            skip_blanks();
            is_first = true;
            continue;
        }
        if (!(is_first ? is_letter_of_any_case(peek(), c) : peek() == c)) {
            position_ = before;
            return false;
        }
        is_first = false;
        advance();
    }
    if (is_name_character(peek())) {
        position_ = before;
        return false;
    }
    return true;
}

std::string_view ModelText::take_name() {
    const std::size_t first = position_;
    if (std::isdigit(static_cast<unsigned char>(peek())) == 0) {
        while (is_name_character(peek())) {
            advance();
        }
    }
    return text_.substr(std::min(first, text_.size()), position_ - first);
}

std::uint32_t ModelText::line_of(std::size_t position) const {
    position = std::min(position, text_.size());
    if (position < counted_to_) {
        counted_to_ = 0;
        newlines_ = 0;
    }
    const auto* from = text_.data() + counted_to_;
    newlines_ += static_cast<std::uint32_t>(std::count(from, text_.data() + position, '\n'));
    counted_to_ = position;
    return newlines_;
}

std::string ModelText::where(std::size_t position) const {
    position = std::min(position, text_.size());
    const std::size_t newline = text_.substr(0, position).rfind('\n');
    const std::size_t column = position - (newline == std::string_view::npos ? 0 : newline + 1) + 1;
    return fmt::format("{}:{}", source_.where(line_of(position)), column);
}

std::string ModelText::shown_next() const {
    if (at_end()) {
        return "the end of the file";
    }
    if (at_line_end()) {
        return "the end of the line";
    }
    constexpr std::size_t kShown = 12;
    const std::string_view rest = text_.substr(position_);
    return shown(rest.substr(0, std::min({rest.find('\n'), kShown, rest.size()})));
}

void ModelText::fail(std::string problem, std::string why, std::string suggestion) const {
    throw SyntaxError{position_, std::move(problem), std::move(why), std::move(suggestion)};
}

}  // namespace quasimc

#include "io/results/json_scanner.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "io/numbers.h"
#include "quasimc/error.h"

namespace quasimc {
namespace {

/// What a string with its quotes stands for, whose escapes are known to be right.
/// @throws nlohmann::json::exception  if there is half a surrogate pair, or no UTF-8, in one with
///                                    escapes
std::string unescaped(std::string_view quoted) {
    const std::string_view inner = quoted.substr(1, quoted.size() - 2);
    if (inner.find('\\') == std::string_view::npos) {
        return std::string(inner);
    }
    return nlohmann::json::parse(quoted).get<std::string>();
}

}  // namespace

void JsonScanner::refuse() const {
    throw InputError(
        {{std::string(path_), fmt::format("byte {}: not JSON", at_ + 1),
          "a result that `quasimc run --json` wrote is needed", ""}});
}

JsonScanner::Kind JsonScanner::kind() {
    switch (peek()) {
        case '{':
            return Kind::object;
        case '[':
            return Kind::list;
        case '"':
            return Kind::string;
        case 't':
        case 'f':
        case 'n':
            return Kind::word;
        default:
            return Kind::number;
    }
}

bool JsonScanner::begins(char open, char close) {
    pass(open);
    if (peek() == close) {
        ++at_;
        return false;
    }
    return true;
}

bool JsonScanner::goes_on(char close) {
    if (peek() == close) {
        ++at_;
        return false;
    }
    pass(',');
    return true;
}

std::string_view JsonScanner::key() {
    if (peek() != '"') {
        refuse();
    }
    key_.clear();
    const std::size_t begin = at_;
    const std::string_view quoted = pass_string();
    const std::string_view inner = quoted.substr(1, quoted.size() - 2);
    if (inner.find('\\') != std::string_view::npos) {
        at_ = begin;
        key_ = text();
    }
    pass(':');
    return key_.empty() ? inner : std::string_view(key_);
}

std::string JsonScanner::text() {
    if (peek() != '"') {
        refuse();
    }
    const std::size_t begin = at_;
    try {
        return unescaped(pass_string());
    } catch (const nlohmann::json::exception&) {
        at_ = begin;
        refuse();
    }
}

double JsonScanner::number() {
    pass_blanks();
    const std::size_t begin = at_;
    pass_number();
    const auto number = parse_real(text_.substr(begin, at_ - begin));
    if (!number) {
        at_ = begin;
        refuse();  // too large to hold
    }
    return *number;
}

std::string_view JsonScanner::pass_string() {
    const std::size_t begin = at_++;
    for (; at_ < text_.size(); ++at_) {
        const char c = text_[at_];
        if (c == '"') {
            ++at_;
            return text_.substr(begin, at_ - begin);
        }
        if (c == '\\') {
            pass_escape();
        } else if (static_cast<unsigned char>(c) < ' ') {
            break;
        }
    }
    refuse();
}

/// From the backslash to the last character.
void JsonScanner::pass_escape() {
    ++at_;
    if (at_ < text_.size() && text_[at_] == 'u') {
        const std::string_view digits = text_.substr(at_ + 1, 4);
        if (digits.size() < 4 ||
            digits.find_first_not_of("0123456789abcdefABCDEF") != std::string_view::npos) {
            refuse();
        }
        at_ += 4;
    } else if (
        at_ == text_.size() ||
        std::string_view("\"\\/bfnrt").find(text_[at_]) == std::string_view::npos) {
        refuse();
    }
}

void JsonScanner::pass_digits() {
    if (!is_digit()) {
        refuse();
    }
    while (is_digit()) {
        ++at_;
    }
}

void JsonScanner::pass_number() {
    const auto is = [this](char c) { return at_ < text_.size() && text_[at_] == c; };
    at_ += is('-') ? 1 : 0;
    if (is('0')) {
        ++at_;
    } else {
        pass_digits();
    }
    if (is('.')) {
        ++at_;
        pass_digits();
    }
    if (is('e') || is('E')) {
        ++at_;
        at_ += is('+') || is('-') ? 1 : 0;
        pass_digits();
    }
}

void JsonScanner::pass_word() {
    for (const std::string_view word : {"null", "true", "false"}) {
        if (text_.substr(at_).starts_with(word)) {
            at_ += word.size();
            return;
        }
    }
    refuse();
}

void JsonScanner::pass_single() {
    switch (kind()) {
        case Kind::string:
            pass_string();
            return;
        case Kind::word:
            pass_word();
            return;
        default:
            pass_number();
    }
}

std::string_view JsonScanner::skip() {
    const std::size_t begin = place();
    open_.clear();
    do {
        const char c = peek();
        if ((c == '{' || c == '[') && begins(c, c == '{' ? '}' : ']')) {
            open_ += c == '{' ? '}' : ']';
        } else {
            if (c != '{' && c != '[') {
                pass_single();
            }
            while (!open_.empty() && !goes_on(open_.back())) {
                open_.pop_back();
            }
        }
        if (!open_.empty() && open_.back() == '}') {
            if (peek() != '"') {
                refuse();
            }
            pass_string();
            pass(':');
        }
    } while (!open_.empty());
    return text_.substr(begin, at_ - begin);
}

void JsonScanner::end() {
    if (place() < text_.size()) {
        refuse();
    }
}

}  // namespace quasimc

#include "runfile/name_pattern.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "quasimc/error.h"

namespace quasimc {
namespace {

std::vector<std::string_view> split_path(std::string_view text) {
    std::vector<std::string_view> parts;
    while (true) {
        const std::size_t end = text.find('/');
        parts.push_back(text.substr(0, end));
        if (end == text.npos) {
            return parts;
        }
        text.remove_prefix(end + 1);
    }
}

[[noreturn]] void refuse_pattern(
    std::string problem, std::string why = {}, std::string suggestion = {}) {
    throw InputError({{"labels_from", std::move(problem), std::move(why), std::move(suggestion)}});
}

}  // namespace

NamePattern::NamePattern(std::string_view text) : text_(text) {
    for (const std::string_view part : split_path(text_)) {
        parts_.push_back(tokens_of(part));
    }
    check();
}

std::vector<NamePattern::Token> NamePattern::tokens_of(std::string_view part) {
    std::vector<Token> tokens;
    while (!part.empty()) {
        const std::size_t end = part.front() == '{' ? part.find('}') : part.npos;
        if (end != part.npos) {
            tokens.push_back({Token::Kind::key, std::string(part.substr(1, end - 1))});
            part.remove_prefix(end + 1);
        } else if (part.front() == '*') {
            tokens.push_back({Token::Kind::star, ""});
            part.remove_prefix(1);
        } else {
            const std::size_t next = part.find_first_of("{*", 1);
            tokens.push_back({Token::Kind::literal, std::string(part.substr(0, next))});
            part.remove_prefix(std::min(next, part.size()));
        }
    }
    return tokens;
}

void NamePattern::check() const {
    std::vector<std::string> seen;
    for (const Part& part : parts_) {
        for (std::size_t i = 0; i < part.size(); ++i) {
            if (i > 0 && part[i].kind != Token::Kind::literal &&
                part[i - 1].kind != Token::Kind::literal) {
                refuse_pattern(
                    fmt::format("'{}' has nothing between two keys", text_), "",
                    "put the text that parts them");
            }
            if (part[i].kind != Token::Kind::key) {
                continue;
            }
            const std::string& key = part[i].text;
            if (key.empty() || std::find(seen.begin(), seen.end(), key) != seen.end()) {
                refuse_pattern(
                    key.empty() ? fmt::format("'{}' has a key without a name", text_)
                                : fmt::format("'{}' has the key '{}' twice", text_, key));
            }
            seen.push_back(key);
        }
    }
    if (seen.empty()) {
        refuse_pattern(
            fmt::format("'{}' has no key", text_), "",
            "write as tree{tree}, or give labels = { ... }");
    }
}

std::vector<std::string> NamePattern::keys() const {
    std::vector<std::string> keys;
    for (const Part& part : parts_) {
        for (const Token& token : part) {
            if (token.kind == Token::Kind::key) {
                keys.push_back(token.text);
            }
        }
    }
    return keys;
}

/// Matches the tokens from `first` on with a text, the shortest keys first; adds their labels.
bool NamePattern::match_part(
    const Part& part, std::size_t first, std::string_view name, Labels& labels) {
    if (first == part.size()) {
        return name.empty();
    }
    const Token& token = part[first];
    if (token.kind == Token::Kind::literal) {
        return name.starts_with(token.text) &&
               match_part(part, first + 1, name.substr(token.text.size()), labels);
    }
    const bool is_key = token.kind == Token::Kind::key;
    for (std::size_t length = is_key ? 1 : 0; length <= name.size(); ++length) {
        const std::size_t before = labels.size();
        if (is_key) {
            labels.emplace_back(token.text, name.substr(0, length));
        }
        if (match_part(part, first + 1, name.substr(length), labels)) {
            return true;
        }
        labels.resize(before);
    }
    return false;
}

std::optional<Labels> NamePattern::match(std::string_view name) const {
    const std::vector<std::string_view> parts = split_path(name);
    if (parts.size() < parts_.size()) {
        return std::nullopt;
    }
    Labels labels;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        if (!match_part(parts_[i], 0, parts[i], labels)) {
            return std::nullopt;
        }
    }
    return labels;
}

}  // namespace quasimc

#include "results/group_request.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/text.h"

namespace quasimc {
namespace {

constexpr std::string_view kWhere = "where ";

/// The position of the word `where` that begins the condition; npos if there is none.
std::size_t find_where(std::string_view text) {
    if (text.starts_with(kWhere)) {
        return 0;
    }
    const std::size_t blank = text.find(" where ");
    return blank == text.npos ? text.npos : blank + 1;
}

std::vector<std::string> split_keys(std::string_view text) {
    std::vector<std::string> keys;
    while (!text.empty()) {
        const std::size_t end = text.find('+');
        keys.emplace_back(trimmed(text.substr(0, end)));
        if (end == text.npos) {
            break;
        }
        text.remove_prefix(end + 1);
        if (text.empty()) {
            keys.emplace_back();  // "plant+" lacks a key
        }
    }
    return keys;
}

}  // namespace

GroupRequest parse_group(std::string_view text, std::span<const std::string_view> known) {
    if (std::find(known.begin(), known.end(), text) != known.end()) {
        return {.by = std::string(text), .keys = {std::string(text)}};
    }
    GroupRequest request{.by = std::string(text), .keys = {}};
    std::string_view keys = text;
    if (const std::size_t where = find_where(text); where != text.npos) {
        request.where.emplace(trimmed(text.substr(where + kWhere.size())));
        keys = text.substr(0, where);
    }
    if (const std::size_t name = keys.find(':'); name != keys.npos) {
        request.by = trimmed(keys.substr(0, name));
        keys.remove_prefix(name + 1);
    }
    keys = trimmed(keys);
    const bool is_key = std::find(known.begin(), known.end(), keys) != known.end();
    request.keys = is_key ? std::vector{std::string(keys)} : split_keys(keys);
    if (request.keys.empty() && !request.where) {
        request.keys.emplace_back();  // "" is no key
    }
    return request;
}

std::string group_text(std::string_view name, std::string_view by, std::string_view where) {
    std::string text(by);
    if (!where.empty()) {
        text += fmt::format("{}where {}", by.empty() ? "" : " ", where);
    }
    return name.empty() ? text : fmt::format("{}: {}", name, text);
}

}  // namespace quasimc

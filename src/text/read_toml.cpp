#include <algorithm>
#include <sstream>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "quasimc/error.h"
#include "text/document.h"

namespace quasimc {
namespace {

Node converted(const toml::node& node, const std::string& file, int depth);

std::uint32_t line_of(const toml::source_region& region) {
    return region.begin.line;
}

Node::List converted_list(const toml::array& array, const std::string& file, int depth) {
    Node::List list;
    list.reserve(array.size());
    for (const toml::node& item : array) {
        list.push_back(converted(item, file, depth + 1));
    }
    return list;
}

/// Converts a table of the parser, which sorts by key, to the order of the file.
Node::Table converted_table(const toml::table& table, const std::string& file, int depth) {
    std::vector<std::pair<toml::source_position, Member>> members;
    for (const auto& [key, node] : table) {
        members.emplace_back(
            key.source().begin,
            Member{
                std::string(key.str()), line_of(key.source()), converted(node, file, depth + 1)});
    }
    std::stable_sort(members.begin(), members.end(), [](const auto& a, const auto& b) {
        return a.first < b.first;
    });
    Node::Table result;
    result.reserve(members.size());
    for (auto& [position, member] : members) {
        result.push_back(std::move(member));
    }
    return result;
}

Node converted(const toml::node& node, const std::string& file, int depth) {
    Node result;
    result.line = line_of(node.source());
    if (depth > kDeepestNesting) {
        throw InputError(
            {{fmt::format("{}:{}", file, result.line), "is nested too deeply",
              fmt::format("{} levels at most", kDeepestNesting), ""}});
    }
    if (const toml::table* table = node.as_table()) {
        result.value = converted_table(*table, file, depth);
    } else if (const toml::array* array = node.as_array()) {
        result.value = converted_list(*array, file, depth);
    } else if (const auto* text = node.as_string()) {
        result.value = text->get();
    } else if (const auto* integer = node.as_integer()) {
        result.value = integer->get();
    } else if (const auto* real = node.as_floating_point()) {
        result.value = real->get();
    } else if (const auto* boolean = node.as_boolean()) {
        result.value = boolean->get();
    } else {
        std::ostringstream words;
        node.visit([&](const auto& value) {
            if constexpr (toml::is_chronological<decltype(value)>) {
                words << value.get();
            }
        });
        result.value = Node::Other{"a date or time", std::move(words).str()};
    }
    return result;
}

/// End of a TOML string that begins at `at`: after its last quote.
std::size_t end_of_string(std::string_view text, std::size_t at) {
    const char quote = text[at];
    const bool is_long = text.substr(at, 3) == std::string(3, quote);
    const std::string end(is_long ? 3 : 1, quote);
    for (std::size_t i = at + end.size(); i < text.size(); ++i) {
        if (text.substr(i).starts_with(end) || (!is_long && text[i] == '\n')) {
            return text[i] == '\n' ? i : i + end.size();
        }
        i += text[i] == '\\' && quote == '"' ? 1 : 0;
    }
    return text.size();
}

bool is_end_of_key(char c) {
    return std::string_view("=,[]{}\n").find(c) != std::string_view::npos;
}

/// Refuses keys of very many parts (a.a.a...) before they are parsed: the parser recurses for each
/// part.
void refuse_deep_keys(std::string_view text, const std::string& file) {
    std::uint32_t line = 1;
    int dots = 0;
    for (std::size_t i = 0; i < text.size();) {
        const char c = text[i];
        if (c == '#') {
            i = std::min(text.find('\n', i), text.size());
            continue;
        }
        if (c == '"' || c == '\'') {
            const std::size_t end = end_of_string(text, i);
            line +=
                static_cast<std::uint32_t>(std::count(text.data() + i, text.data() + end, '\n'));
            i = end;
            continue;
        }
        dots = c == '.' ? dots + 1 : is_end_of_key(c) ? 0 : dots;
        line += c == '\n' ? 1 : 0;
        if (dots > kDeepestNesting) {
            throw InputError(
                {{fmt::format("{}:{}", file, line), "a key has too many parts",
                  fmt::format("{} levels at most", kDeepestNesting), ""}});
        }
        ++i;
    }
}

}  // namespace

Node read_toml(std::string_view text, const std::string& file) {
    refuse_deep_keys(text, file);
    try {
        const toml::table table = toml::parse(text);
        return converted(table, file, 0);
    } catch (const toml::parse_error& error) {
        throw InputError(
            {{fmt::format("{}:{}", file, line_of(error.source())), std::string(error.description()),
              "not TOML", ""}});
    }
}

}  // namespace quasimc

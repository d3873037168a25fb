#include <algorithm>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "runfile/sweep_keys.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

std::string name_of_item(const Node& item) {
    const Node* name = item.find("name");
    const auto* text = name == nullptr ? nullptr : name->as<std::string>();
    return text == nullptr ? "" : *text;
}

std::string suggest(std::string_view word, const std::vector<std::string>& names) {
    return did_you_mean(word, std::vector<std::string_view>(names.begin(), names.end()));
}

/// Sets the value of a key in a document.
class Setter {
  public:
    Setter(const SweptKey& key, const Node& value, Reporter& reporter)
        : key_(key), value_(value), reporter_(reporter) {}

    /// @param path  relative to `node`
    void set(Node& node, std::string_view path) {
        if (auto* table = std::get_if<Node::Table>(&node.value)) {
            set_in_table(*table, path);
        } else if (auto* list = std::get_if<Node::List>(&node.value)) {
            set_in_list(*list, path);
        } else {
            fault(
                fmt::format("'{}' is {}", walked(path), node.type_name()),
                fmt::format("it has no '{}'", path));
        }
    }

  private:
    void set_in_table(Node::Table& table, std::string_view path) {
        Member* longest = nullptr;
        std::string_view rest;
        for (Member& member : table) {
            if (member.key == path) {
                member.line = key_.line == 0 ? member.line : key_.line;
                member.node = value_;
                return;
            }
            const auto after = rest_after(path, member.key);
            if (after && (longest == nullptr || member.key.size() > longest->key.size())) {
                longest = &member;
                rest = *after;
            }
        }
        if (longest != nullptr) {
            set(longest->node, rest);
        } else if (path.find('.') == std::string_view::npos) {
            table.push_back({std::string(path), key_.line, value_});
        } else {
            std::vector<std::string> names;
            for (const Member& member : table) {
                names.push_back(member.key);
            }
            const bool is_section = prefix(path).empty();
            fault(
                fmt::format("there is no '{}{}'", prefix(path), first_part(path)), "",
                is_section ? "add it to the file" : suggest(first_part(path), names));
        }
    }

    /// Tables are found by their names, or counted from 1.
    void set_in_list(Node::List& list, std::string_view path) {
        std::vector<Node*> named;
        std::size_t length = 0;
        for (Node& item : list) {
            const std::string name = name_of_item(item);
            if (name.empty() || !rest_after(path, name) || name.size() < length) {
                continue;
            }
            if (name.size() > length) {
                named.clear();
            }
            length = name.size();
            named.push_back(&item);
        }
        if (named.size() > 1) {
            fault(
                fmt::format("{} tables have the name '{}'", named.size(), path.substr(0, length)),
                "a swept value must belong to one", "give them names of their own");
        } else if (named.size() == 1) {
            set(*named.front(), path.substr(length + 1));
        } else {
            set_numbered(list, path);
        }
    }

    void set_numbered(Node::List& list, std::string_view path) {
        const std::string_view first = first_part(path);
        const auto number = parse_integer(first);
        const auto size = static_cast<std::int64_t>(list.size());
        if (number && *number >= 1 && *number <= size && first.size() < path.size()) {
            set(list[static_cast<std::size_t>(*number - 1)], path.substr(first.size() + 1));
            return;
        }
        const std::vector<std::string> names = names_of_items(list);
        fault(
            fmt::format("there is no '{}{}'", prefix(path), first),
            "tables are selected by name, or by number from 1",
            names.empty() ? "" : suggest(first, names));
    }

    /// The part of the path before `rest`, with its dot.
    [[nodiscard]] std::string prefix(std::string_view rest) const {
        const std::string path = key_.from_top();
        return path.substr(0, path.size() - rest.size());
    }
    [[nodiscard]] std::string walked(std::string_view rest) const {
        const std::string before = prefix(rest);
        return before.substr(0, before.empty() ? 0 : before.size() - 1);
    }
    void fault(std::string problem, std::string why, std::string suggestion = {}) {
        reporter_.fault(
            key_.line, fmt::format("[sweep]: {}: {}", key_.path, problem), std::move(why),
            std::move(suggestion));
    }

    const SweptKey& key_;
    const Node& value_;
    Reporter& reporter_;
};

}  // namespace

std::vector<std::string> names_of_items(const Node::List& list) {
    std::vector<std::string> names;
    for (const Node& item : list) {
        if (!name_of_item(item).empty()) {
            names.push_back(name_of_item(item));
        }
    }
    return names;
}

void set_swept_value(Node& document, const SweptKey& key, const Node& value, Reporter& reporter) {
    Setter(key, value, reporter).set(document, key.from_top());
}

}  // namespace quasimc

#include "io/runfile/sweep.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/text.h"
#include "io/numbers.h"
#include "io/runfile/options.h"

namespace quasimc {
namespace {

constexpr std::string_view kSweep = "sweep";
constexpr std::string_view kTogether = "together";
constexpr std::array<std::string_view, 5> kSweptSections{
    "run", "source", "material", "place", "time"};
constexpr std::array<std::string_view, 4> kSweptGeometry{"organ", "geometry", "ground", "cell"};
/// Keys at the top of a file that are of the scene and its units.
constexpr std::array<std::string_view, 10> kOfAllPoints{
    "title",       "bands",           "band",   "up",     "north",
    "length_unit", "irradiance_unit", "format", "output", "detector"};
/// Options that decide which rows and columns there are, or are of all points together.
constexpr std::array<std::string_view, 6> kFixedOptions{"groups",      "layers", "layer_heights",
                                                        "max_seconds", "ratios", "threads"};

template <typename Names>
bool is_among(std::string_view name, const Names& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::string_view first_part(std::string_view path) {
    return path.substr(0, path.find('.'));
}

/// What follows `name` in a path "name.rest"; nothing if it does not begin so.
std::optional<std::string_view> rest_after(std::string_view path, std::string_view name) {
    const bool begins =
        path.size() > name.size() + 1 && path.starts_with(name) && path[name.size()] == '.';
    return begins ? std::optional(path.substr(name.size() + 1)) : std::nullopt;
}

std::string name_of_item(const Node& item) {
    const Node* name = item.find("name");
    const auto* text = name == nullptr ? nullptr : name->as<std::string>();
    return text == nullptr ? "" : *text;
}

/// The names of a list's tables, for suggestions.
std::vector<std::string> names_of_items(const Node::List& list) {
    std::vector<std::string> names;
    for (const Node& item : list) {
        if (!name_of_item(item).empty()) {
            names.push_back(name_of_item(item));
        }
    }
    return names;
}

std::string suggest(std::string_view word, const std::vector<std::string>& names) {
    return did_you_mean(word, std::vector<std::string_view>(names.begin(), names.end()));
}

/// Sets the value of a key somewhere in a document.
class Setter {
  public:
    Setter(const SweptKey& key, const Node& value, Reporter& reporter)
        : key_(key), value_(value), reporter_(reporter) {}

    /// @param path  from `node` on
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
                fmt::format("{} tables are named '{}'", named.size(), path.substr(0, length)),
                "a swept value is of one", "give them names of their own");
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
            "tables are found by their names, or counted from 1",
            names.empty() ? "" : suggest(first, names));
    }

    /// What precedes `rest` in the path, with its dot.
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

/// The section in which a table has that name, or "".
std::string_view section_with(const Node& document, std::string_view name) {
    for (const std::string_view section : {"source", "material", "organ", "geometry"}) {
        const Node* list = document.find(section);
        const auto* items = list == nullptr ? nullptr : list->as<Node::List>();
        if (items != nullptr && is_among(name, names_of_items(*items))) {
            return section;
        }
    }
    return "";
}

/// A key of a section, for suggestions.
std::string_view example_of(std::string_view section) {
    constexpr std::array<std::array<std::string_view, 2>, 9> kExamples{
        {{"run", "paths"},
         {"source", "source.sun.elevation_deg"},
         {"material", "material.leaf.reflectance"},
         {"place", "place.latitude_deg"},
         {"time", "time.day"},
         {"organ", "organ.leaf.material"},
         {"geometry", "geometry.plant.file"},
         {"ground", "ground.material"},
         {"cell", "cell.size"}}};
    const auto found = std::find_if(
        kExamples.begin(), kExamples.end(), [&](const auto& each) { return each[0] == section; });
    return found == kExamples.end() ? "" : (*found)[1];
}

std::string how_to_state(const Node& document, std::string_view path) {
    const std::string_view section = section_with(document, first_part(path));
    if (!section.empty()) {
        return fmt::format("write {}.{}", section, path);
    }
    std::vector<std::string_view> names(kSweptSections.begin(), kSweptSections.end());
    names.insert(names.end(), kSweptGeometry.begin(), kSweptGeometry.end());
    const std::string_view near = nearest_word(first_part(path), names);
    return near.empty() ? "" : fmt::format("did you mean '{}'?", near);
}

bool has_empty_part(std::string_view path) {
    return path.empty() || path.front() == '.' || path.back() == '.' ||
           path.find("..") != std::string_view::npos;
}

bool is_option(std::string_view key) {
    return find_option(key) != nullptr || find_former_option(key) != nullptr;
}

/// A key without a section is that of an option. @returns whether it is none, which is reported
bool refuse_single(const Node& document, const SweptKey& key, Reporter& reporter) {
    if (is_option(key.path)) {
        return false;
    }
    const bool is_section = is_among(std::string_view(key.path), kSweptSections) ||
                            is_among(std::string_view(key.path), kSweptGeometry);
    const std::string problem = fmt::format("[sweep]: '{}' can't be swept", key.path);
    if (is_section) {
        reporter.fault(
            key.line, problem, "it is a section",
            fmt::format("name a key of it, as {}", example_of(key.path)));
    } else {
        const std::string_view near = nearest_word(key.path, option_keys());
        reporter.fault(
            key.line, problem, "it is no option of the run",
            near.empty() ? how_to_state(document, key.path)
                         : fmt::format("did you mean '{}'?", near));
    }
    return true;
}

/// Reports a key that is no value of the run, or one for all points.
bool is_refused(const Node& document, const SweptKey& key, Reporter& reporter) {
    const std::string path = key.from_top();
    const std::string_view section = first_part(path);
    const bool is_known = is_among(section, kSweptSections) || is_among(section, kSweptGeometry);
    const std::string_view option = section == "run" ? rest_after(path, "run").value_or("") : "";
    const bool is_fixed = is_among(option, kFixedOptions);
    if (has_empty_part(path)) {
        reporter.fault(
            key.line, fmt::format("[sweep]: '{}' is no key", key.path), "a part of it is empty");
        return true;
    }
    if (is_among(first_part(key.path), kOfAllPoints)) {
        reporter.fault(
            key.line, fmt::format("[sweep]: '{}' can't be swept", key.path),
            "it is one for all points", "write a run file for each of its values");
        return true;
    }
    if (key.path.find('.') == std::string::npos && refuse_single(document, key, reporter)) {
        return true;
    }
    if (!is_known) {
        reporter.fault(
            key.line, fmt::format("[sweep]: '{}' can't be swept", key.path),
            "it is no value of run, source, material, place, time, organ, geometry, ground or cell",
            how_to_state(document, key.path));
    } else if (is_fixed) {
        reporter.fault(
            key.line, fmt::format("[sweep]: '{}' can't be swept", key.path),
            "it is one for all points", "state it in [run]");
    }
    return !is_known || is_fixed;
}

}  // namespace

std::string node_text(const Node& node) {
    if (const auto* text = node.as<std::string>()) {
        return option_toml(*text);
    }
    if (const auto* integer = node.as<std::int64_t>()) {
        return option_toml(*integer);
    }
    if (const auto* real = node.as<double>()) {
        return shortest(*real);
    }
    if (const auto* boolean = node.as<bool>()) {
        return *boolean ? "true" : "false";
    }
    if (const auto* other = node.as<Node::Other>()) {
        return other->text;
    }
    const auto* list = node.as<Node::List>();
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    if (list != nullptr) {
        for (const Node& item : *list) {
            add(node_text(item));
        }
        return "[" + text + "]";
    }
    for (const Member& member : *node.as<Node::Table>()) {
        add(member.key + " = " + node_text(member.node));
    }
    return "{" + text + "}";
}

std::string SweptKey::from_top() const {
    return path.find('.') == std::string::npos ? "run." + path : path;
}

SweepPlan::SweepPlan(const Node& document, Reporter& reporter) {
    const Node* table = document.find(kSweep);
    if (table == nullptr) {
        return;
    }
    if (table->as<Node::Table>() == nullptr) {
        reporter.fault(
            table->line, fmt::format("sweep is {}", table->type_name()),
            "it must be a table of keys and their values");
        return;
    }
    read_keys(*table, "", reporter);
    const std::size_t stated = keys_.size();
    std::erase_if(keys_, [&](const SweptKey& key) { return is_refused(document, key, reporter); });
    check_keys(reporter);
    if (stated > 0 || reporter.faults.empty()) {
        count_points(*table, stated, reporter);
    }
}

void SweepPlan::read_keys(const Node& table, const std::string& prefix, Reporter& reporter) {
    for (const Member& member : *table.as<Node::Table>()) {
        const std::string path = prefix + member.key;
        const auto* list = member.node.as<Node::List>();
        if (path == kTogether) {
            const auto* together = member.node.as<bool>();
            together_ = together != nullptr && *together;
            if (together == nullptr) {
                reporter.fault(
                    member.line, fmt::format("[sweep]: together is {}", member.node.type_name()),
                    "it must be true or false");
            }
        } else if (member.node.as<Node::Table>() != nullptr) {
            read_keys(member.node, path + ".", reporter);
        } else if (list == nullptr || list->empty()) {
            reporter.fault(
                member.line,
                fmt::format(
                    "[sweep]: {} is {}", path,
                    list ? "an empty list" : std::string(member.node.type_name())),
                "it must be a list of the values that it takes");
        } else {
            keys_.push_back({path, member.line, *list});
        }
    }
}

/// No key may set what another one sets.
void SweepPlan::check_keys(Reporter& reporter) const {
    for (std::size_t i = 0; i < keys_.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const std::string a = keys_[i].from_top();
            const std::string b = keys_[j].from_top();
            if (a == b || rest_after(a, b) || rest_after(b, a)) {
                reporter.fault(
                    keys_[i].line,
                    fmt::format("[sweep]: {} and {} set the same", keys_[j].path, keys_[i].path),
                    "one of them would win", "leave one out");
            }
        }
    }
}

void SweepPlan::count_points(const Node& table, std::size_t stated, Reporter& reporter) {
    if (stated == 0) {
        reporter.fault(table.line, "[sweep]: it has no keys", "nothing varies", "leave it out");
    }
    if (keys_.empty()) {
        return;
    }
    points_ = keys_.front().values.size();
    for (std::size_t i = 1; i < keys_.size(); ++i) {
        const std::size_t count = keys_[i].values.size();
        if (together_ && count != keys_.front().values.size()) {
            reporter.fault(
                keys_[i].line,
                fmt::format(
                    "[sweep]: {} has {} values, {} has {}", keys_[i].path, count,
                    keys_.front().path, keys_.front().values.size()),
                "with together = true the first of each are one point, and so on", "give as many");
        }
        points_ =
            together_ ? std::min(points_, count) : std::min(points_ * count, kMostSweepPoints + 1);
    }
    if (points_ > kMostSweepPoints) {
        reporter.fault(
            table.line, fmt::format("[sweep]: there are more than {} points", kMostSweepPoints),
            "every value is combined with every other one",
            "give fewer values, or together = true");
        points_ = 1;
    }
}

std::size_t SweepPlan::value_at(std::size_t key, std::size_t point) const {
    if (together_) {
        return point;
    }
    std::size_t before = 1;
    for (std::size_t i = key + 1; i < keys_.size(); ++i) {
        before *= keys_[i].values.size();
    }
    return point / before % keys_[key].values.size();
}

std::vector<SweptValue> SweepPlan::values_at(std::size_t point) const {
    std::vector<SweptValue> values;
    for (std::size_t k = 0; k < keys_.size(); ++k) {
        const Node& value = keys_[k].values[value_at(k, point)];
        const auto* word = value.as<std::string>();
        values.push_back(
            {keys_[k].path, word ? *word : node_text(value), std::make_shared<const Node>(value)});
    }
    return values;
}

bool SweepPlan::keeps_geometry() const {
    return std::none_of(keys_.begin(), keys_.end(), [](const SweptKey& key) {
        return is_among(first_part(key.from_top()), kSweptGeometry);
    });
}

Node SweepPlan::document_at(const Node& document, std::size_t point, Reporter& reporter) const {
    Node result = document;
    auto* members = std::get_if<Node::Table>(&result.value);
    if (members == nullptr) {
        return result;
    }
    std::erase_if(*members, [](const Member& member) { return member.key == kSweep; });
    for (std::size_t k = 0; k < keys_.size(); ++k) {
        const std::string path = keys_[k].from_top();
        if (first_part(path) == "run" && result.find("run") == nullptr) {
            members->push_back({"run", keys_[k].line, {Node::Table{}, keys_[k].line}});
        }
        Node value = keys_[k].values[value_at(k, point)];
        value.line = value.line == 0 ? keys_[k].line : value.line;
        Setter(keys_[k], value, reporter).set(result, path);
    }
    return result;
}

}  // namespace quasimc

#include "capi/scene_description.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "options/options.h"
#include "quasimc/error.h"

namespace quasimc::capi {
namespace {

constexpr const char* kPiece = "description";  // name of a piece of a run file in messages

Node* find_in(Node::Table& table, const std::string& key) {
    const auto found = std::find_if(
        table.begin(), table.end(), [&](const Member& member) { return member.key == key; });
    return found == table.end() ? nullptr : &found->node;
}

/// Removes line numbers, which are meaningless in joined pieces.
void forget_lines(Node& node) {
    node.line = 0;
    if (auto* table = std::get_if<Node::Table>(&node.value)) {
        for (Member& member : *table) {
            member.line = 0;
            forget_lines(member.node);
        }
    } else if (auto* list = std::get_if<Node::List>(&node.value)) {
        std::for_each(list->begin(), list->end(), forget_lines);
    }
}

bool is_list_of_tables(const Node& node) {
    const auto* list = node.as<Node::List>();
    return list != nullptr && !list->empty() && list->front().as<Node::Table>() != nullptr;
}

/// Whether the keys of a node are joined with those of another instead of replaced.
bool is_table_or_tables(const Node& node) {
    return node.as<Node::Table>() != nullptr || is_list_of_tables(node);
}

void join(Node::Table& into, Node::Table from);

void join_values(const std::string& key, Node& into, Node&& from) {
    auto* table = std::get_if<Node::Table>(&into.value);
    auto* more = std::get_if<Node::Table>(&from.value);
    if (table != nullptr && more != nullptr) {
        join(*table, std::move(*more));
    } else if (is_list_of_tables(into) && is_list_of_tables(from)) {
        auto& list = std::get<Node::List>(into.value);
        for (Node& item : std::get<Node::List>(from.value)) {
            list.push_back(std::move(item));
        }
    } else if (is_table_or_tables(into) || is_table_or_tables(from)) {
        throw InputError(
            {{kPiece, fmt::format("{} is {}", key, from.type_name()),
              fmt::format("it was given as {} before", into.type_name()), ""}});
    } else {
        into = std::move(from);
    }
}

void join(Node::Table& into, Node::Table from) {
    for (Member& member : from) {
        if (Node* known = find_in(into, member.key)) {
            join_values(member.key, *known, std::move(member.node));
        } else {
            into.push_back(std::move(member));
        }
    }
}

/// The part of a scene that a key at the top of a run file belongs to.
quasimc_part part_of(std::string_view key) {
    constexpr std::array<std::pair<std::string_view, quasimc_part>, 26> kParts{
        {{"bands", QUASIMC_BANDS},        {"band", QUASIMC_BANDS},
         {"material", QUASIMC_MATERIALS}, {"material_file", QUASIMC_MATERIALS},
         {"organ", QUASIMC_ORGANS},       {"geometry", QUASIMC_ORGANS},
         {"ground", QUASIMC_GROUND},      {"cell", QUASIMC_CELL},
         {"site", QUASIMC_SITE},          {"source", QUASIMC_SOURCES},
         {"light_file", QUASIMC_SOURCES}, {"time", QUASIMC_TIME},
         {"sweep", QUASIMC_SWEEP},        {"detector", QUASIMC_DETECTORS},
         {"sensors", QUASIMC_SENSORS},    {"run", QUASIMC_OPTIONS},
         {"format", QUASIMC_OTHER},       {"title", QUASIMC_OTHER},
         {"up", QUASIMC_OTHER},           {"north", QUASIMC_OTHER},
         {"length_unit", QUASIMC_OTHER},  {"irradiance_unit", QUASIMC_OTHER},
         {"output", QUASIMC_OTHER},       {"table", QUASIMC_OTHER},
         {"control", QUASIMC_TIME},       {"gap_fraction", QUASIMC_DETECTORS}}};
    const auto found = std::find_if(
        kParts.begin(), kParts.end(), [&](const auto& row) { return row.first == key; });
    return found == kParts.end() ? QUASIMC_UNKNOWN_KEYS : found->second;
}

}  // namespace

SceneDescription::SceneDescription()
    : document_{Node::Table{}}, name_("scene"), folder_(std::filesystem::current_path().string()) {}

SceneDescription::SceneDescription(const std::string& run_file)
    : document_(read_toml(read_file(run_file), run_file)),
      name_(run_file),
      folder_(std::filesystem::absolute(run_file).parent_path().string()) {}

void SceneDescription::add(const std::string& toml) {
    Node piece = read_toml(toml, kPiece);
    forget_lines(piece);
    Node joined = document_;  // nothing changes if a key is refused
    join(std::get<Node::Table>(joined.value), std::get<Node::Table>(std::move(piece.value)));
    document_ = std::move(joined);
}

void SceneDescription::add_table(const std::string& key, Node::Table table) {
    join(top(), {{key, 0, {Node::List{{std::move(table)}}}}});
}

Node* SceneDescription::find_named(const std::string& list, const std::string& name) {
    Node* known = find_in(top(), list);
    if (known == nullptr || !is_list_of_tables(*known)) {
        return nullptr;
    }
    auto& tables = std::get<Node::List>(known->value);
    const auto found = std::find_if(tables.begin(), tables.end(), [&](const Node& table) {
        const Node* of_table = table.find("name");
        const auto* text = of_table == nullptr ? nullptr : of_table->as<std::string>();
        return text != nullptr && *text == name;
    });
    return found == tables.end() ? nullptr : &*found;
}

void SceneDescription::put_table(
    const std::string& key, const std::string& name, Node::Table table) {
    if (Node* same = find_named(key, name)) {
        *same = {std::move(table)};
    } else {
        add_table(key, std::move(table));
    }
}

void SceneDescription::set_key(
    const std::string& list, const std::string& name, const std::string& key, Node value) {
    Node* table = find_named(list, name);
    if (table == nullptr) {
        throw InputError(
            {{fmt::format("{} '{}'", list, name), "there are none of this name", "",
              "add them first"}});
    }
    forget_lines(value);
    auto& keys = std::get<Node::Table>(table->value);
    if (Node* known = find_in(keys, key)) {
        *known = std::move(value);
    } else {
        keys.push_back({key, 0, std::move(value)});
    }
}

void SceneDescription::set_table(const std::string& key, Node::Table table) {
    remove(key);
    top().push_back({key, 0, {std::move(table)}});
}

void SceneDescription::remove(const std::string& key) {
    std::erase_if(top(), [&](const Member& member) { return member.key == key; });
}

void SceneDescription::clear(quasimc_part part) {
    std::erase_if(top(), [&](const Member& member) { return part_of(member.key) == part; });
    if (part == QUASIMC_ORGANS) {
        organs_.clear();
        indices_.clear();
    }
}

std::size_t SceneDescription::band_count() const {
    std::size_t count = 0;
    for (const char* key : {"bands", "band"}) {
        const Node* found = document_.find(key);
        const auto* list = found == nullptr ? nullptr : found->as<Node::List>();
        count += list == nullptr ? 0 : list->size();
    }
    return count;
}

void SceneDescription::set_option(const std::string& key, const std::string& text) {
    const Option* option = find_option(key);
    if (option == nullptr) {
        throw InputError(
            {{"option '" + key + "'", "no such option", "",
              "docs/reference/options.md lists them"}});
    }
    add(fmt::format("[run]\n{} = {}\n", key, option_toml(parse_option(*option, text))));
}

void SceneDescription::add_organs(std::vector<OrganSpec> organs) {
    for (const OrganSpec& organ : organs) {
        if (organ.id && indices_.contains(*organ.id)) {
            throw InputError(
                {{fmt::format("organ {}", *organ.id), "the scene has an organ with this id",
                  "ids must be unique", "give all faces of an organ in one call"}});
        }
    }
    for (OrganSpec& organ : organs) {
        if (organ.id) {
            indices_.emplace(*organ.id, organs_.size());
        }
        organs_.push_back(std::move(organ));
    }
}

OrganSpec& SceneDescription::organ(std::int64_t id) {
    const auto found = indices_.find(id);
    if (found == indices_.end()) {
        throw InputError(
            {{fmt::format("organ {}", id), "no mesh has an organ with this id", "",
              "add its mesh first"}});
    }
    return organs_[found->second];
}

void SceneDescription::give_organs_to(SceneBuilder& builder) const {
    for (const OrganSpec& organ : organs_) {
        builder.add_organ(organ);
    }
}

Node numbers_node(std::span<const double> numbers) {
    Node::List list;
    for (const double number : numbers) {
        list.push_back({number});
    }
    return {std::move(list)};
}

}  // namespace quasimc::capi

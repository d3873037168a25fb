// Reads `labels_from`: labels of organs from their names in a geometry file.

#include <algorithm>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/text.h"
#include "runfile/csv_table.h"
#include "runfile/labels_from.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

std::string_view path_of(const MeshGroup& group) {
    return group.path.empty() ? group.name : group.path;
}

void add_pattern(TableReader& table, const Node& node, LabelsFrom& from) {
    const auto* text = node.as<std::string>();
    if (text == nullptr) {
        table.fault_at(
            node, fmt::format("labels_from has {}", node.type_name()),
            "it must be a pattern \"tree{tree}\", a list of patterns, or { file = \"names.csv\" }");
        return;
    }
    try {
        from.patterns.emplace_back(*text);
    } catch (const InputError& error) {
        const Fault& fault = error.faults().front();
        table.fault_at(node, "labels_from: " + fault.problem, fault.why, fault.suggestion);
    }
}

/// Reads { file = "names.csv" }: the column `name`, others are labels.
void add_names(TableReader& table, const Node& node, InputFiles& files, LabelsFrom& from) {
    TableReader keys(node, table.what() + ": labels_from", table.reporter());
    const auto file = keys.required("file", keys.text("file"));
    const auto names = file ? read_csv_table(keys, *file, files) : std::nullopt;
    keys.finish();
    if (!names) {
        return;
    }
    const std::optional<std::size_t> column = names->column("name");
    if (!column) {
        const std::vector<std::string_view> known(names->names.begin(), names->names.end());
        keys.reporter().faults.add(
            {fmt::format("{}:{}", names->file, names->header_line), "there is no column 'name'",
             fmt::format("columns are {}", joined(known, ", ")),
             "it must have the names in the geometry file"});
        return;
    }
    for (const CsvTable::Row& row : names->rows) {
        Labels& labels = from.names[row.fields[*column]];
        for (std::size_t c = 0; c < row.fields.size(); ++c) {
            if (c != *column && !row.fields[c].empty()) {
                labels.emplace_back(names->names[c], row.fields[c]);
            }
        }
    }
    from.keys_of_names = names->names;
    std::erase(from.keys_of_names, "name");
    from.file = *file;
}

/// The labels in a table for a name, or for the first of its parts that are in the table.
const Labels* labels_of_name(const LabelsFrom& from, std::string_view name) {
    while (true) {
        const auto known = from.names.find(std::string(name));
        const std::size_t end = name.rfind('/');
        if (known != from.names.end() || end == name.npos) {
            return known == from.names.end() ? nullptr : &known->second;
        }
        name = name.substr(0, end);
    }
}

std::optional<Labels> labels_of(const LabelsFrom& from, std::string_view name) {
    if (const Labels* labels = labels_of_name(from, name)) {
        return *labels;
    }
    for (const NamePattern& pattern : from.patterns) {
        if (std::optional<Labels> labels = pattern.match(name)) {
            return labels;
        }
    }
    return std::nullopt;
}

/// The values of a key become integers if all of them are ("01" is 1).
void make_integers(std::vector<Labels*>& all, const std::string& key) {
    std::vector<std::pair<std::string*, std::int64_t>> values;
    for (Labels* labels : all) {
        for (auto& [name, value] : *labels) {
            if (name != key) {
                continue;
            }
            const std::optional<std::int64_t> integer = parse_integer(value);
            if (!integer) {
                return;
            }
            values.emplace_back(&value, *integer);
        }
    }
    for (const auto& [text, integer] : values) {
        *text = std::to_string(integer);
    }
}

/// Adds labels to those of a group, which has them no more under the same key.
void replace_labels(const Labels& labels, MeshGroup& group) {
    for (const auto& label : labels) {
        std::erase_if(group.labels, [&](const auto& own) { return own.first == label.first; });
    }
    group.labels.insert(group.labels.begin(), labels.begin(), labels.end());
}

/// Names that fit nothing: the number, and the first three.
struct UnmatchedNames {
    std::size_t count = 0, all = 0;
    std::string first;

    void add(std::string_view name) {
        constexpr std::size_t kShown = 3;
        if (count++ < kShown) {
            first += fmt::format("{}{}", first.empty() ? "" : ", ", shown(name));
        }
    }
};

void report(const LabelsFrom& from, const UnmatchedNames& names, TableReader& table) {
    const std::string subject =
        from.file.empty() ? fmt::format("'{}'", from.patterns.front().text()) : from.file;
    if (names.count == names.all) {
        table.fault_at(
            "labels_from",
            fmt::format("labels_from {} fits none of {}", subject, counted(names.all, "name")),
            fmt::format("first: {}", names.first), "patterns are compared from the start");
    } else if (names.count > 0) {
        table.warn(fmt::format(
            "{}: {} of {} names do not fit labels_from and have no such labels (first: {})",
            table.what(), names.count, names.all, names.first));
    }
}

}  // namespace

std::vector<std::string> LabelsFrom::keys() const {
    std::vector<std::string> all = keys_of_names;
    for (const NamePattern& pattern : patterns) {
        for (std::string& key : pattern.keys()) {
            if (std::find(all.begin(), all.end(), key) == all.end()) {
                all.push_back(std::move(key));
            }
        }
    }
    return all;
}

std::optional<LabelsFrom> read_labels_from(TableReader& table, InputFiles& files) {
    const Node* node = table.any("labels_from");
    if (node == nullptr) {
        return std::nullopt;
    }
    LabelsFrom from;
    if (const auto* list = node->as<Node::List>()) {
        for (const Node& item : *list) {
            add_pattern(table, item, from);
        }
        if (list->empty()) {
            table.fault_at(*node, "labels_from has no pattern", "", "remove it");
        }
    } else if (node->as<Node::Table>() != nullptr) {
        add_names(table, *node, files, from);
    } else {
        add_pattern(table, *node, from);
    }
    return from.patterns.empty() && from.names.empty() ? std::nullopt
                                                       : std::optional(std::move(from));
}

void check_keys(const LabelsFrom& from, const std::vector<FileCopy>& copies, TableReader& table) {
    for (const std::string& key : from.keys()) {
        const auto has_key = [&](const FileCopy& copy) {
            return find_label(copy.labels, key) != nullptr;
        };
        if (std::any_of(copies.begin(), copies.end(), has_key)) {
            const Node* labels = table.any("labels");
            const bool is_in_labels = labels != nullptr && labels->find(key) != nullptr;
            table.fault_at(
                "labels_from",
                fmt::format(
                    "the label '{}' is in {} and in labels_from", key,
                    is_in_labels ? "labels" : "at"),
                "", "keep one");
        }
    }
}

void set_labels_from(const LabelsFrom& from, std::vector<NamedMesh>& files, TableReader& table) {
    UnmatchedNames unmatched;
    std::vector<std::pair<MeshGroup*, Labels>> found;
    for (NamedMesh& file : files) {
        for (MeshGroup& group : file.mesh.groups) {
            ++unmatched.all;
            if (std::optional<Labels> labels = labels_of(from, path_of(group))) {
                found.emplace_back(&group, std::move(*labels));
            } else {
                unmatched.add(path_of(group));
            }
        }
    }
    std::vector<Labels*> all;
    all.reserve(found.size());
    for (auto& [group, labels] : found) {
        all.push_back(&labels);
    }
    for (const std::string& key : from.keys()) {
        make_integers(all, key);
    }
    for (const auto& [group, labels] : found) {
        replace_labels(labels, *group);
    }
    report(from, unmatched, table);
}

}  // namespace quasimc

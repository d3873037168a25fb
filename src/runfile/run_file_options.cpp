#include <algorithm>

#include <fmt/format.h>

#include "base/checks.h"
#include "base/text.h"
#include "options/options.h"
#include "results/group_request.h"
#include "runfile/run_file_sections.h"

namespace quasimc {
namespace {

/// Converts a list of texts or of numbers.
std::optional<OptionValue> list_value(const Node::List& list) {
    std::vector<std::string> words;
    std::vector<double> numbers;
    for (const Node& item : list) {
        if (const auto* word = item.as<std::string>()) {
            words.push_back(*word);
        } else if (const auto* integer = item.as<std::int64_t>()) {
            numbers.push_back(static_cast<double>(*integer));
        } else if (const auto* real = item.as<double>()) {
            numbers.push_back(*real);
        }
    }
    if (words.size() == list.size()) {
        return words;
    }
    return numbers.size() == list.size() ? std::optional<OptionValue>(numbers) : std::nullopt;
}

/// The value of a node, if options have its type.
std::optional<OptionValue> option_value(const Node& node) {
    if (const auto* integer = node.as<std::int64_t>()) {
        return *integer;
    }
    if (const auto* real = node.as<double>()) {
        return *real;
    }
    if (const auto* text = node.as<std::string>()) {
        return *text;
    }
    const auto* list = node.as<Node::List>();
    return list ? list_value(*list) : std::nullopt;
}

template <typename T>
Node list_node(const std::vector<T>& values) {
    Node::List list(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        list[i].value = values[i];
    }
    return {std::move(list)};
}

Node option_node(const OptionValue& value) {
    if (const auto* texts = std::get_if<std::vector<std::string>>(&value)) {
        return list_node(*texts);
    }
    if (const auto* numbers = std::get_if<std::vector<double>>(&value)) {
        return list_node(*numbers);
    }
    if (const auto* integer = std::get_if<std::int64_t>(&value)) {
        return {*integer};
    }
    if (const auto* real = std::get_if<double>(&value)) {
        return {*real};
    }
    return {std::get<std::string>(value)};
}

/// The text of a group that is written as a table { name, by, where }.
std::string read_group(const Node& node, Reporter& reporter) {
    TableReader group(node, reporter.table_name("run") + ": groups", reporter);
    const std::string name = group.text("name").value_or("");
    const std::string by = group.text("by").value_or("");
    const std::string where = group.text("where").value_or("");
    group.finish();
    if (name.find(':') != std::string::npos || name.find(" where ") != std::string::npos) {
        group.fault_at("name", fmt::format("the name '{}' has ':' or 'where'", name));
    }
    if (by.empty() && where.empty() && !group.failed()) {
        group.fault("a group has neither by nor where", "", "give by = \"plant\"");
    }
    return group_text(name, by, where);
}

/// A list whose tables are groups, as a list of texts.
Node with_group_texts(const Node& node, Reporter& reporter) {
    Node result = node;
    if (auto* list = std::get_if<Node::List>(&result.value)) {
        for (Node& item : *list) {
            if (item.as<Node::Table>() != nullptr) {
                item.value = read_group(item, reporter);
            }
        }
    }
    return result;
}

/// Reads one option.
void read_option(TableReader& table, const Option& option, RunOptions& options) {
    const Node* given = table.any(option.key);
    if (given == nullptr) {
        return;
    }
    options.locations[option.key] = table.reporter().where(given->line);
    options.unknown.push_back(option.key);  // until it is set
    const std::size_t before = table.reporter().faults.size();
    std::optional<OptionValue> value =
        option_value(option.key == "groups" ? with_group_texts(*given, table.reporter()) : *given);
    if (table.reporter().faults.size() > before) {
        return;
    }
    if (!value) {
        table.fault_at(
            *given, fmt::format("{}: it is {}", option.key, given->type_name()),
            "it must be " + domain_text(option));
        return;
    }
    value = whole_if_integer(option, *value);
    if (const std::optional<Fault> fault = check_option(option, *value)) {
        table.fault_at(
            *given, fmt::format("{}: {}", option.key, fault->problem), fault->why,
            fault->suggestion);
        return;
    }
    option.set(options.spec, *value);
    options.unknown.pop_back();
}

}  // namespace

void read_run_options(TableReader& top, RunOptions& options) {
    const Node* node = top.any("run");
    if (node == nullptr) {
        return;
    }
    TableReader table(*node, top.table_name("run"), top.reporter());
    for (const Option& option : option_table()) {
        read_option(table, option, options);
    }
    table.finish();
}

void apply_overrides(
    const std::vector<Override>& overrides, RunOptions& options, Reporter& reporter) {
    for (const Override& given : overrides) {
        const Option* option = find_option(given.key);
        if (option == nullptr) {
            reporter.faults.add(
                {given.where, fmt::format("there is no option '{}'", given.key), "",
                 did_you_mean(given.key, option_keys())});
        } else if (auto fault = check_option(*option, parse_option(*option, given.text))) {
            fault->where = given.where;
            reporter.faults.add(*fault);
            options.unknown.push_back(option->key);
        } else {
            option->set(options.spec, parse_option(*option, given.text));
            options.locations[option->key] = given.where;
        }
    }
}

Node completed(Node document, const RunSpec& spec) {
    Node::Table run;
    for (const Option& option : option_table()) {
        run.push_back({std::string(option.key), 0, option_node(option.get(spec))});
    }
    auto& members = std::get<Node::Table>(document.value);
    const auto found = std::find_if(
        members.begin(), members.end(), [](const Member& member) { return member.key == "run"; });
    if (found != members.end()) {
        found->node.value = std::move(run);
    } else {
        members.push_back({"run", 0, {std::move(run)}});
    }
    return document;
}

void refuse_options_at_the_top(TableReader& top) {
    for (const Option& option : option_table()) {
        if (const Node* node = top.any(option.key)) {
            top.fault_at(
                *node, fmt::format("{} is an option of the run", option.key), "",
                "put it below [run]");
        }
    }
}

void add_run_faults(const Faults& found, const RunOptions& options, Reporter& reporter) {
    for (Fault fault : found.all()) {
        const auto given = options.locations.find(fault.where);
        if (given != options.locations.end()) {
            fault.problem = fault.where + ": " + fault.problem;
            fault.where = given->second;
        } else {
            fault.where = reporter.file + ": " + fault.where;
        }
        reporter.faults.add(std::move(fault));
    }
}

}  // namespace quasimc

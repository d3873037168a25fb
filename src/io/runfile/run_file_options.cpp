#include <algorithm>

#include <fmt/format.h>

#include "base/text.h"
#include "io/runfile/options.h"
#include "io/runfile/run_file_sections.h"

namespace quasimc {
namespace {

std::vector<std::string_view> option_keys() {
    std::vector<std::string_view> keys;
    for (const Option& option : option_table()) {
        keys.push_back(option.key);
    }
    return keys;
}

/// The value a node states, if it is of a type that options have.
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
    std::vector<std::string> words;
    for (std::size_t i = 0; list && i < list->size(); ++i) {
        if (const auto* word = (*list)[i].as<std::string>()) {
            words.push_back(*word);
        }
    }
    return list && words.size() == list->size() ? std::optional<OptionValue>(words) : std::nullopt;
}

Node option_node(const OptionValue& value) {
    if (const auto* words = std::get_if<std::vector<std::string>>(&value)) {
        Node::List list;
        for (const std::string& word : *words) {
            list.push_back({word});
        }
        return {std::move(list)};
    }
    if (const auto* integer = std::get_if<std::int64_t>(&value)) {
        return {*integer};
    }
    if (const auto* real = std::get_if<double>(&value)) {
        return {*real};
    }
    return {std::get<std::string>(value)};
}

}  // namespace

void read_run_options(TableReader& top, RunOptions& options) {
    const Node* node = top.any("run");
    if (node == nullptr) {
        return;
    }
    TableReader table(*node, "[run]", top.reporter());
    for (const Option& option : option_table()) {
        const Node* stated = table.any(option.key);
        if (stated == nullptr) {
            continue;
        }
        options.places[option.key] = top.reporter().place(stated->line);
        const std::optional<OptionValue> value = option_value(*stated);
        if (!value) {
            table.fault_at(
                *stated, fmt::format("{} is {}", option.key, stated->type_name()),
                "it takes " + domain_text(option));
        } else if (const std::optional<Fault> fault = check_option(option, *value)) {
            table.fault_at(*stated, fault->problem, fault->why, fault->suggestion);
        } else {
            option.set(options.spec, *value);
        }
    }
    table.finish();
}

void apply_overrides(
    const std::vector<Override>& overrides, RunOptions& options, Reporter& reporter) {
    for (const Override& stated : overrides) {
        const Option* option = find_option(stated.key);
        if (option == nullptr) {
            reporter.faults.add(
                {stated.place, fmt::format("there is no option '{}'", stated.key), "",
                 did_you_mean(stated.key, option_keys())});
            continue;
        }
        const OptionValue value = parse_option(*option, stated.text);
        if (std::optional<Fault> fault = check_option(*option, value)) {
            fault->place = stated.place;
            reporter.faults.add(*fault);
        } else {
            option->set(options.spec, value);
            options.places[option->key] = stated.place;
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
        const auto stated = options.places.find(fault.place);
        if (stated != options.places.end()) {
            fault.problem = fault.place + ": " + fault.problem;
            fault.place = stated->second;
        } else {
            fault.place = reporter.file + ": " + fault.place;
        }
        reporter.faults.add(std::move(fault));
    }
}

}  // namespace quasimc

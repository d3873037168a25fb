#include "stress/nodes.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace quasimc::stress {
namespace {

template <typename T>
Node list_of(const std::vector<T>& values) {
    Node::List list;
    for (const T& value : values) {
        list.push_back(node_of(value));
    }
    Node node;
    node.value = std::move(list);
    return node;
}

bool is_list_of_tables(const Node& node) {
    const auto* list = node.as<Node::List>();
    return list != nullptr && !list->empty() && list->front().as<Node::Table>() != nullptr;
}

std::string inline_value(const Node& node) {
    if (const bool* b = node.as<bool>()) {
        return *b ? "true" : "false";
    }
    if (const std::int64_t* i = node.as<std::int64_t>()) {
        return fmt::format("{}", *i);
    }
    if (const double* x = node.as<double>()) {
        // The shortest text that reads back as the same number; -0 needs a fraction to keep its
        // sign.
        return *x == 0 && std::signbit(*x) ? "-0.0" : fmt::format("{}", *x);
    }
    if (const std::string* text = node.as<std::string>()) {
        return fmt::format("\"{}\"", *text);
    }
    std::string inner;
    if (const auto* list = node.as<Node::List>()) {
        for (const Node& item : *list) {
            inner += (inner.empty() ? "" : ", ") + inline_value(item);
        }
        return "[" + inner + "]";
    }
    if (const auto* table = node.as<Node::Table>()) {
        for (const Member& member : *table) {
            inner += fmt::format(
                "{}{} = {}", inner.empty() ? "" : ", ", member.key, inline_value(member.node));
        }
        return "{ " + inner + " }";
    }
    return "\"\"";
}

void append_values(const Node& table, std::string& text) {
    for (const Member& member : *table.as<Node::Table>()) {
        text += fmt::format("{} = {}\n", member.key, inline_value(member.node));
    }
}

}  // namespace

Node node_of(double number) {
    Node node;
    node.value = number;
    return node;
}

Node node_of(const std::string& text) {
    Node node;
    node.value = text;
    return node;
}

Node node_of(const Vec3& v) {
    return list_of(std::vector<double>{v.x, v.y, v.z});
}

Node node_of(const std::vector<double>& numbers) {
    return list_of(numbers);
}

Node node_of(const std::vector<Vec3>& points) {
    return list_of(points);
}

Node node_of(const std::vector<std::string>& texts) {
    return list_of(texts);
}

Node boolean_node(bool value) {
    Node node;
    node.value = value;
    return node;
}

Node empty_table() {
    Node node;
    node.value = Node::Table{};
    return node;
}

Node empty_list() {
    Node node;
    node.value = Node::List{};
    return node;
}

Node::Table& members(Node& node) {
    return std::get<Node::Table>(node.value);
}

Node::List& items(Node& node) {
    return std::get<Node::List>(node.value);
}

Node* find(Node& table, const std::string& key) {
    for (Member& member : members(table)) {
        if (member.key == key) {
            return &member.node;
        }
    }
    return nullptr;
}

void set(Node& table, const std::string& key, Node value) {
    if (Node* old = find(table, key)) {
        *old = std::move(value);
    } else {
        members(table).push_back({key, 0, std::move(value)});
    }
}

void add_table(Node& document, const std::string& key, Node table) {
    if (find(document, key) == nullptr) {
        set(document, key, empty_list());
    }
    items(*find(document, key)).push_back(std::move(table));
}

double number_in(const Node& node) {
    if (const std::int64_t* i = node.as<std::int64_t>()) {
        return static_cast<double>(*i);
    }
    return std::get<double>(node.value);
}

double number_at(const Node& table, const std::string& key, double usual) {
    const Node* node = table.find(key);
    return node == nullptr ? usual : number_in(*node);
}

std::string text_at(const Node& table, const std::string& key, const std::string& usual) {
    const Node* node = table.find(key);
    return node == nullptr ? usual : std::get<std::string>(node->value);
}

Vec3 vector_in(const Node& node) {
    const auto& list = std::get<Node::List>(node.value);
    return {number_in(list.at(0)), number_in(list.at(1)), number_in(list.at(2))};
}

Vec3 vector_at(const Node& table, const std::string& key, const Vec3& usual) {
    const Node* node = table.find(key);
    return node == nullptr ? usual : vector_in(*node);
}

std::vector<double> per_band_at(
    const Node& table, const std::string& key, std::size_t bands, double usual) {
    std::vector<double> values(bands, usual);
    const Node* node = table.find(key);
    if (node == nullptr) {
        return values;
    }
    const auto* list = node->as<Node::List>();
    for (std::size_t b = 0; b < bands; ++b) {
        values[b] = number_in(list == nullptr ? *node : list->at(b));
    }
    return values;
}

std::vector<const Node*> tables_at(const Node& document, const std::string& key) {
    std::vector<const Node*> tables;
    if (const Node* node = document.find(key)) {
        for (const Node& item : std::get<Node::List>(node->value)) {
            tables.push_back(&item);
        }
    }
    return tables;
}

std::string to_toml(const Node& document) {
    std::string text, tables;
    for (const Member& member : *document.as<Node::Table>()) {
        if (is_list_of_tables(member.node)) {
            for (const Node& item : *member.node.as<Node::List>()) {
                tables += fmt::format("\n[[{}]]\n", member.key);
                append_values(item, tables);
            }
        } else if (member.node.as<Node::Table>() != nullptr) {
            tables += fmt::format("\n[{}]\n", member.key);
            append_values(member.node, tables);
        } else {
            text += fmt::format("{} = {}\n", member.key, inline_value(member.node));
        }
    }
    return text + tables;
}

}  // namespace quasimc::stress

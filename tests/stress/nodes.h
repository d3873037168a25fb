#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "quasimc/mesh.h"
#include "text/document.h"

// Run files as values, which can be made, changed, and written as TOML.

namespace quasimc::stress {

[[nodiscard]] Node node_of(double number);
[[nodiscard]] Node node_of(const std::string& text);
[[nodiscard]] Node node_of(const Vec3& v);
[[nodiscard]] Node node_of(const std::vector<double>& numbers);
[[nodiscard]] Node node_of(const std::vector<Vec3>& points);
[[nodiscard]] Node node_of(const std::vector<std::string>& texts);
[[nodiscard]] Node boolean_node(bool value);
[[nodiscard]] Node empty_table();
[[nodiscard]] Node empty_list();

/// The members of a table, or the items of a list, which the node must be.
[[nodiscard]] Node::Table& members(Node& node);
[[nodiscard]] Node::List& items(Node& node);

/// Sets a key of a table.
void set(Node& table, const std::string& key, Node value);
/// The value of a key, or null.
[[nodiscard]] Node* find(Node& table, const std::string& key);
/// Adds a table to a list of tables.
void add_table(Node& document, const std::string& key, Node table);

// Access to valid documents for the reference, which has its own reader.

[[nodiscard]] double number_in(const Node& node);
[[nodiscard]] double number_at(const Node& table, const std::string& key, double usual);
[[nodiscard]] std::string text_at(
    const Node& table, const std::string& key, const std::string& usual);
[[nodiscard]] Vec3 vector_in(const Node& node);
[[nodiscard]] Vec3 vector_at(const Node& table, const std::string& key, const Vec3& usual);
/// A value per band: one number for all, or a list.
[[nodiscard]] std::vector<double> per_band_at(
    const Node& table, const std::string& key, std::size_t bands, double usual);
/// The tables of a list of tables; none if it is absent.
[[nodiscard]] std::vector<const Node*> tables_at(const Node& document, const std::string& key);

/// The document as TOML, which read_toml() reads as the same values.
[[nodiscard]] std::string to_toml(const Node& document);

}  // namespace quasimc::stress

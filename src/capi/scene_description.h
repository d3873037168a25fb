#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "files/input_files.h"
#include "quasimc/capi.h"
#include "quasimc/scene.h"
#include "text/document.h"

namespace quasimc::capi {

/// Description of a scene: a document like a run file, and organs from arrays.
class SceneDescription {
  public:
    /// An empty description; paths are relative to the current folder.
    SceneDescription();
    /// The description in a run file. @throws InputError  if it can't be read
    explicit SceneDescription(const std::string& run_file);

    /// Adds a piece of a run file. @throws InputError  if it is no TOML, or a key has another type
    void add(const std::string& toml);
    /// Adds a table to a list of tables ([[source]]).
    void add_table(const std::string& key, Node::Table table);
    /// Adds a table to a list of tables; replaces a table with its name, if there is one
    /// ([[material]]).
    void put_table(const std::string& key, const std::string& name, Node::Table table);
    /// Sets a key of the table with a name, in a list of tables. @throws InputError  if there is
    /// none
    void set_key(
        const std::string& list, const std::string& name, const std::string& key, Node value);
    /// Replaces a table ([ground]).
    void set_table(const std::string& key, Node::Table table);
    void remove(const std::string& key);
    /// Removes a part of the scene.
    void clear(quasimc_part part);
    /// Returns the number of bands.
    [[nodiscard]] std::size_t band_count() const;
    /// Sets an option of [run] from its text.
    void set_option(const std::string& key, const std::string& text);

    /// Appends organs.
    void add_organs(std::vector<OrganSpec> organs);
    /// The added organ with an id. @throws InputError  if there is none
    [[nodiscard]] OrganSpec& organ(std::int64_t id);

    [[nodiscard]] const Node& document() const { return document_; }
    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] InputFiles files() const { return InputFiles(folder_); }
    void give_organs_to(SceneBuilder& builder) const;

  private:
    [[nodiscard]] Node::Table& top() { return std::get<Node::Table>(document_.value); }

    /// The table with a name in a list of tables, or null.
    [[nodiscard]] Node* find_named(const std::string& list, const std::string& name);

    Node document_;
    std::string name_;
    std::string folder_;
    std::vector<OrganSpec> organs_;
    std::unordered_map<std::int64_t, std::size_t> indices_;  // by id
};

/// One number for each band.
[[nodiscard]] Node numbers_node(std::span<const double> numbers);

}  // namespace quasimc::capi

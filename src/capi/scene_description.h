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

/// What was stated of a scene: a document as a run file would have it, and organs from arrays.
class SceneDescription {
  public:
    /// Nothing yet; paths are relative to the current folder.
    SceneDescription();
    /// What a run file says. @throws InputError  if it can't be read
    explicit SceneDescription(const std::string& run_file);

    /// Adds a piece of a run file. @throws InputError  if it is no TOML, or a key is of another
    /// kind
    void add(const std::string& toml);
    /// Adds a table to a list of tables ([[source]]).
    void add_table(const std::string& key, Node::Table table);
    /// The same; replaces the table that has that name, if there is one ([[material]]).
    void put_table(const std::string& key, const std::string& name, Node::Table table);
    /// Replaces a table ([ground]).
    void set_table(const std::string& key, Node::Table table);
    void remove(const std::string& key);
    /// Removes all that was stated of a part of the scene.
    void clear(quasimc_part part);
    /// Returns how many bands were stated.
    [[nodiscard]] std::size_t band_count() const;
    /// Sets an option of [run], from its text.
    void set_option(const std::string& key, const std::string& text);

    /// Adds organs behind the others.
    void add_organs(std::vector<OrganSpec> organs);
    /// The organ that was added with that id. @throws InputError  if there is none
    [[nodiscard]] OrganSpec& organ(std::int64_t id);

    [[nodiscard]] const Node& document() const { return document_; }
    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] InputFiles files() const { return InputFiles(folder_); }
    void give_organs_to(SceneBuilder& builder) const;

  private:
    [[nodiscard]] Node::Table& top() { return std::get<Node::Table>(document_.value); }

    Node document_;
    std::string name_;
    std::string folder_;
    std::vector<OrganSpec> organs_;
    std::unordered_map<std::int64_t, std::size_t> indices_;  // of ids among them
};

/// One number for each band.
[[nodiscard]] Node numbers_node(std::span<const double> numbers);

}  // namespace quasimc::capi

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/mesh.h"
#include "text/document.h"
#include "text/table_reader.h"

namespace quasimc {

/// Reads the values of a glTF file. A value with a fault is reported and then absent. `where` is
/// the owner of a value: "node 3".
class GltfValues {
  public:
    explicit GltfValues(Reporter& reporter) : reporter_(reporter) {}

    void fault(std::string problem, std::string why, std::string suggestion = {}) {
        reporter_.fault(0, std::move(problem), std::move(why), std::move(suggestion));
    }
    /// An integer that is not negative.
    std::optional<std::uint64_t> whole(
        const Node& object, std::string_view key, const std::string& where);
    /// The index of a part of the file, less than `count`.
    std::optional<std::size_t> index(
        const Node& object, std::string_view key, std::size_t count, const std::string& where);
    /// The list of indices in the value of a key; empty if it is absent.
    std::vector<std::size_t> indices(
        const Node& object, std::string_view key, std::size_t count, const std::string& where);
    /// A list of the given number of finite numbers.
    std::optional<std::vector<double>> numbers(
        const Node& object, std::string_view key, std::size_t count, const std::string& where);
    /// The transform of a node: its matrix, or its scale, rotation and translation.
    Affine transform(const Node& node, const std::string& where);

  private:
    std::optional<std::size_t> index_of(
        const Node& value, std::string_view key, std::size_t count, const std::string& where);
    Affine matrix(const std::vector<double>& m, const std::string& where);

    Reporter& reporter_;
};

/// The finite numbers in the list of a key; none if there is no list.
[[nodiscard]] std::vector<double> gltf_numbers(const Node& object, std::string_view key);
/// The text of a key; "" if it has none.
[[nodiscard]] std::string gltf_text(const Node& object, std::string_view key);
/// The list of a key; an empty one if it has none.
[[nodiscard]] const Node::List& gltf_list(const Node& object, std::string_view key);

/// Warns of unknown keys of glTF 2.0 in geometry, such as a misspelled "translation".
void warn_of_unknown_keys(const Node& root, Reporter& reporter);

}  // namespace quasimc

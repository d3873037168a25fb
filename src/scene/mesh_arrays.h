#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "quasimc/scene.h"

namespace quasimc {

/// Organs as arrays. The arrays must outlive it.
struct MeshArrays {
    std::string where;                 ///< for messages: "mesh 1"
    std::span<const double> vertices;  ///< x, y, z of each; the file's axes
    /// Three vertex indices per face; empty: every three vertices are a face.
    std::variant<std::span<const std::int32_t>, std::span<const std::int64_t>> faces;
    /// Face indices, organ by organ; empty: in their order.
    std::span<const std::int64_t> order;
    /// First face of each organ in that order, and the end of the last organ.
    std::span<const std::int64_t> starts;
    std::span<const std::int64_t> ids;  ///< by organ; empty: the next free ones
    std::vector<std::string> materials;
    std::span<const std::uint32_t> material_of_face;  ///< empty: the first one for all faces
    std::vector<std::string> names;                   ///< by organ; empty: names by the builder
    /// Labels: a key with one value for all organs, or one per organ.
    std::vector<std::pair<std::string, std::vector<std::string>>> labels;
    bool measured = true;
    double field_of_view_deg = 90;
};

/// The organs. @throws InputError  if a face names a vertex that is not there
[[nodiscard]] std::vector<OrganSpec> make_organs(const MeshArrays& arrays);
/// Adds the organs. @throws InputError  if a face names a vertex that is not there
void add_organs(const MeshArrays& arrays, SceneBuilder& builder);

}  // namespace quasimc

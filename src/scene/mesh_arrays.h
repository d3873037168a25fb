#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "quasimc/scene.h"

namespace quasimc {

/// Organs as arrays, which must outlive it.
struct MeshArrays {
    std::string where;                 ///< for messages: "mesh 1"
    std::span<const double> vertices;  ///< x, y, z of each; the file's axes
    /// Three numbers of vertices for each face; empty: every three vertices are a face.
    std::variant<std::span<const std::int32_t>, std::span<const std::int64_t>> faces;
    /// The faces, organ by organ; empty: as they stand.
    std::span<const std::int64_t> order;
    /// Where among them each organ begins, and behind the last: where it ends.
    std::span<const std::int64_t> starts;
    std::span<const std::int64_t> ids;  ///< of each organ; empty: the next that are free
    std::vector<std::string> materials;
    std::span<const std::uint32_t> material_of_face;  ///< empty: the first, of all
    std::vector<std::string> names;                   ///< of each organ; empty: as the builder does
    /// Each for all organs (one value), or of each.
    std::vector<std::pair<std::string, std::vector<std::string>>> labels;
    bool measured = true;
    double field_of_view_deg = 90;
};

/// The organs. @throws InputError  if a face names a vertex that is not there
[[nodiscard]] std::vector<OrganSpec> make_organs(const MeshArrays& arrays);
/// Adds the organs. @throws InputError  if a face names a vertex that is not there
void add_organs(const MeshArrays& arrays, SceneBuilder& builder);

}  // namespace quasimc

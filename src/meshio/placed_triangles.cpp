#include "meshio/placed_triangles.h"

#include <limits>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/number_text.h"
#include "meshio/file_axes.h"

namespace quasimc {

void PlacedTriangles::add(
    const Mesh& shape,
    const Affine& transform,
    const std::string& material,
    std::uint32_t line,
    MeshGroup& group) {
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
    if (shape.faces.empty()) {
        return;
    }
    if (file_.vertices.size() + shape.vertices.size() >= kMost) {
        if (!std::exchange(is_too_large_, true)) {
            reporter_.fault(0, "it has more than 4294967294 vertices", "");
        }
        return;
    }
    const auto first = static_cast<std::uint32_t>(file_.vertices.size());
    for (const Vec3& point : shape.vertices) {
        file_.vertices.push_back(transform.point(point));
    }
    const bool is_mirrored = determinant(transform) < 0;
    MeshPart part{material, {}, std::vector<std::uint32_t>(shape.faces.size(), line)};
    part.faces.reserve(shape.faces.size());
    for (const auto& [a, b, c] : shape.faces) {
        part.faces.push_back(
            is_mirrored ? Face{first + a, first + c, first + b}
                        : Face{first + a, first + b, first + c});
    }
    group.parts.push_back(std::move(part));
}

void drop_repeated_ids(MeshFile& file, std::string_view word, Reporter& reporter) {
    std::set<std::int64_t> known;
    std::size_t repeated = 0;
    for (const MeshGroup& group : file.groups) {
        repeated += group.id && !known.insert(*group.id).second ? 1 : 0;
    }
    if (repeated == 0) {
        return;
    }
    reporter.warn(fmt::format(
        "{} with the id of another: organs are numbered instead",
        counted(repeated, word, word == "mesh" ? "meshes" : "")));
    for (MeshGroup& group : file.groups) {
        group.id.reset();
    }
}

}  // namespace quasimc

#include "capi/meshes.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>

#include <fmt/format.h>

#include "capi/guard.h"
#include "quasimc/error.h"
#include "scene/mesh_arrays.h"

namespace quasimc::capi {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::size_t begin = 0;
    for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
        end = text.find('\n', begin);
        lines.push_back(text.substr(begin, end - begin));
    }
    return lines;
}

template <typename T>
std::span<const T> span_of(const T* values, std::int64_t count) {
    return values == nullptr ? std::span<const T>()
                             : std::span<const T>(values, static_cast<std::size_t>(count));
}

void check_counts(const RawMesh& mesh) {
    constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
    const bool fits = mesh.vertex_count >= 0 && mesh.vertex_count <= kMost && mesh.face_count > 0 &&
                      mesh.face_count <= kMost;
    if (!fits) {
        throw InputError(
            {{mesh.where,
              fmt::format("{} vertices and {} faces", mesh.vertex_count, mesh.face_count),
              "there must be at least one face, and at most 2^31 - 1 of either", ""}});
    }
    if (mesh.faces == nullptr && mesh.vertex_count != 3 * mesh.face_count) {
        throw InputError(
            {{mesh.where,
              fmt::format("{} vertices for {} faces", mesh.vertex_count, mesh.face_count),
              "without an array of faces every three vertices are one", ""}});
    }
}

std::vector<std::uint32_t> materials_of(const RawMesh& mesh, std::size_t materials) {
    std::vector<std::uint32_t> numbers;
    for (const std::int32_t number : span_of(mesh.material_of_face, mesh.face_count)) {
        if (number < 0 || static_cast<std::size_t>(number) >= materials) {
            throw InputError(
                {{mesh.where, fmt::format("a face is of material {}", number),
                  fmt::format("there are {} materials, counted from 0", materials), ""}});
        }
        numbers.push_back(static_cast<std::uint32_t>(number));
    }
    return numbers;
}

/// Faces sorted by the ids of their organs, in stable order.
struct Grouping {
    std::vector<std::int64_t> order, starts, ids;
};

Grouping group(const RawMesh& mesh) {
    Grouping groups;
    const std::span<const std::int64_t> organs = span_of(mesh.organ_of_face, mesh.face_count);
    if (organs.empty()) {
        groups.starts = {0, mesh.face_count};
        return groups;
    }
    groups.order.resize(organs.size());
    std::iota(groups.order.begin(), groups.order.end(), 0);
    std::stable_sort(groups.order.begin(), groups.order.end(), [&](auto a, auto b) {
        return organs[a] < organs[b];
    });
    for (std::size_t i = 0; i < organs.size(); ++i) {
        const std::int64_t id = organs[groups.order[i]];
        if (groups.ids.empty() || id != groups.ids.back()) {
            groups.ids.push_back(id);
            groups.starts.push_back(static_cast<std::int64_t>(i));
        }
    }
    groups.starts.push_back(mesh.face_count);
    return groups;
}

}  // namespace

std::vector<OrganSpec> organs_of(const RawMesh& mesh) {
    static_cast<void>(deref(mesh.vertices, "vertices"));
    check_counts(mesh);
    const Grouping groups = group(mesh);
    MeshArrays arrays;
    arrays.where = mesh.where;
    arrays.vertices = span_of(mesh.vertices, 3 * mesh.vertex_count);
    arrays.faces = span_of(mesh.faces, 3 * mesh.face_count);
    arrays.order = groups.order;
    arrays.starts = groups.starts;
    arrays.ids = groups.ids;
    arrays.materials = lines_of(text_of(mesh.materials, "materials"));
    const std::vector<std::uint32_t> materials = materials_of(mesh, arrays.materials.size());
    arrays.material_of_face = materials;
    return make_organs(arrays);
}

}  // namespace quasimc::capi

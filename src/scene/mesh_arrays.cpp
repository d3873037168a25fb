#include "scene/mesh_arrays.h"

#include <algorithm>
#include <limits>
#include <string>

#include "quasimc/error.h"

namespace quasimc {
namespace {

/// Makes organs from arrays, one after the other.
class OrganMaker {
  public:
    explicit OrganMaker(const MeshArrays& arrays) : arrays_(arrays) {
        if (!is_single()) {
            number_.resize(vertex_count(), kNone);
        }
    }

    [[nodiscard]] OrganSpec make(std::size_t organ) {
        OrganSpec spec;
        spec.where = arrays_.where;
        if (!arrays_.ids.empty()) {
            spec.id = arrays_.ids[organ];
        }
        if (!arrays_.names.empty()) {
            spec.name = arrays_.names[organ];
        }
        for (const auto& [key, values] : arrays_.labels) {
            spec.labels.emplace_back(key, values.size() == 1 ? values[0] : values[organ]);
        }
        spec.measured = arrays_.measured;
        spec.field_of_view_deg = arrays_.field_of_view_deg;
        add_parts(
            static_cast<std::size_t>(arrays_.starts[organ]),
            static_cast<std::size_t>(arrays_.starts[organ + 1]), spec);
        return spec;
    }

  private:
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    /// Whether all faces form one part with all vertices of the arrays.
    [[nodiscard]] bool is_single() const {
        return arrays_.starts.size() == 2 && arrays_.material_of_face.empty();
    }
    [[nodiscard]] std::size_t vertex_count() const { return arrays_.vertices.size() / 3; }
    [[nodiscard]] Vec3 vertex(std::size_t i) const {
        return {arrays_.vertices[3 * i], arrays_.vertices[3 * i + 1], arrays_.vertices[3 * i + 2]};
    }

    [[nodiscard]] Face face(std::size_t i) const {
        return std::visit(
            [&](const auto& numbers) {
                Face face{};
                for (std::size_t k = 0; k < 3; ++k) {
                    const auto at = static_cast<std::int64_t>(3 * i + k);
                    const std::int64_t v = numbers.empty() ? at : std::int64_t{numbers[at]};
                    if (v < 0 || v >= static_cast<std::int64_t>(vertex_count())) {
                        refuse(i, v);
                    }
                    face[k] = static_cast<std::uint32_t>(v);
                }
                return face;
            },
            arrays_.faces);
    }

    [[noreturn]] void refuse(std::size_t face, std::int64_t vertex) const {
        throw InputError(
            {{arrays_.where,
              "face " + std::to_string(face) + " refers to vertex " + std::to_string(vertex),
              "there are " + std::to_string(vertex_count()) + " vertices, counted from 0", ""}});
    }

    [[nodiscard]] std::uint32_t material_of(std::size_t face) const {
        return arrays_.material_of_face.empty() ? 0 : arrays_.material_of_face[face];
    }

    void add_parts(std::size_t first, std::size_t last, OrganSpec& spec) {
        if (is_single()) {
            spec.parts.push_back({arrays_.materials[0], whole_mesh()});
            return;
        }
        // Parts in the order in which their materials first appear.
        std::vector<std::uint32_t> materials;
        for (std::size_t i = first; i < last; ++i) {
            const std::uint32_t material = material_of(face_at(i));
            if (std::find(materials.begin(), materials.end(), material) == materials.end()) {
                materials.push_back(material);
            }
        }
        for (const std::uint32_t material : materials) {
            spec.parts.push_back({arrays_.materials[material], part(first, last, material)});
        }
    }

    [[nodiscard]] std::size_t face_at(std::size_t index) const {
        return arrays_.order.empty() ? index : static_cast<std::size_t>(arrays_.order[index]);
    }

    [[nodiscard]] Mesh whole_mesh() const {
        Mesh mesh;
        mesh.vertices.reserve(vertex_count());
        for (std::size_t i = 0; i < vertex_count(); ++i) {
            mesh.vertices.push_back(vertex(i));
        }
        const auto count = static_cast<std::size_t>(arrays_.starts.back());
        mesh.faces.reserve(count);
        for (std::size_t i = 0; i < count; ++i) {
            mesh.faces.push_back(face(face_at(i)));
        }
        return mesh;
    }

    /// The faces of one material, with the vertices that they use.
    [[nodiscard]] Mesh part(std::size_t first, std::size_t last, std::uint32_t material) {
        Mesh mesh;
        used_.clear();
        for (std::size_t i = first; i < last; ++i) {
            if (material_of(face_at(i)) != material) {
                continue;
            }
            Face numbers = face(face_at(i));
            for (std::uint32_t& v : numbers) {
                if (number_[v] == kNone) {
                    number_[v] = static_cast<std::uint32_t>(mesh.vertices.size());
                    mesh.vertices.push_back(vertex(v));
                    used_.push_back(v);
                }
                v = number_[v];
            }
            mesh.faces.push_back(numbers);
        }
        for (const std::uint32_t v : used_) {
            number_[v] = kNone;
        }
        return mesh;
    }

    const MeshArrays& arrays_;
    std::vector<std::uint32_t> number_;  // by vertex, in the current part
    std::vector<std::uint32_t> used_;
};

}  // namespace

std::vector<OrganSpec> make_organs(const MeshArrays& arrays) {
    OrganMaker maker(arrays);
    std::vector<OrganSpec> organs;
    for (std::size_t i = 0; i + 1 < arrays.starts.size(); ++i) {
        organs.push_back(maker.make(i));
    }
    return organs;
}

void add_organs(const MeshArrays& arrays, SceneBuilder& builder) {
    OrganMaker maker(arrays);
    for (std::size_t i = 0; i + 1 < arrays.starts.size(); ++i) {
        builder.add_organ(maker.make(i));
    }
}

}  // namespace quasimc

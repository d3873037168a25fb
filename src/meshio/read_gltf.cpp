#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/number_text.h"
#include "meshio/file_axes.h"
#include "meshio/formats.h"
#include "meshio/gltf_buffers.h"
#include "meshio/gltf_document.h"
#include "meshio/gltf_shapes.h"
#include "meshio/placed_triangles.h"

namespace quasimc {
namespace {

/// Makes an organ of each node with a mesh.
class GltfSceneReader {
  public:
    GltfSceneReader(const GltfDocument& document, GltfBuffers& buffers, FormatContext& context)
        : document_(document),
          context_(context),
          shapes_(buffers, context.reporter),
          placed_(file_, context.reporter) {
        meshes_.resize(document.meshes.size());
        for (const GltfMaterial& material : document.materials) {
            materials_.push_back(name_of(material));
        }
    }

    MeshFile read() {
        const Affine top = from_y_up(context_.up, context_.units_per_metre());
        std::vector<Open> open;
        for (auto root = document_.roots.rbegin(); root != document_.roots.rend(); ++root) {
            open.push_back({*root, top, "", ""});
        }
        while (!open.empty() && !context_.reporter.is_full()) {
            const Open above = std::move(open.back());
            open.pop_back();
            const GltfNode& node = document_.nodes[above.node];
            const Affine transform = after(above.transform, node.transform);
            if (node.mesh) {
                add_organ(above, transform);
            }
            const std::string& parent = node.name.empty() ? above.parent : node.name;
            const std::string path = node.name.empty() ? above.path : above.path + node.name + "/";
            for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
                open.push_back({*child, transform, parent, path});
            }
        }
        finish();
        return std::move(file_);
    }

  private:
    /// A pending node.
    struct Open {
        std::size_t node;
        Affine transform;    ///< transform of its parent
        std::string parent;  ///< name of the nearest ancestor that has one
        std::string path;    ///< names of all ancestors, each followed by '/'
    };

    void add_organ(const Open& open, const Affine& transform) {
        const GltfNode& node = document_.nodes[open.node];
        const GltfMesh& mesh = document_.meshes[*node.mesh];
        const std::string& name = node.name.empty() ? mesh.name : node.name;
        MeshGroup group{name.empty() ? fmt::format("node {}", open.node) : name, node.organ_id, {}};
        const auto line = static_cast<std::uint32_t>(open.node);
        const std::vector<Mesh>& shapes = shapes_of(*node.mesh);
        for (std::size_t i = 0; i < shapes.size(); ++i) {
            const auto material = mesh.primitives[i].material;
            placed_.add(shapes[i], transform, material ? materials_[*material] : "", line, group);
        }
        if (group.parts.empty()) {
            return;
        }
        group.path = open.path + group.name;
        group.labels = node.labels;
        add_label("parent", open.parent, group);
        add_label("mesh", mesh.name, group);
        file_.groups.push_back(std::move(group));
    }

    /// Adds a label that the group does not have yet, unless it is empty or the group's name.
    static void add_label(std::string_view key, const std::string& value, MeshGroup& group) {
        if (find_label(group.labels, key) == nullptr && !value.empty() && value != group.name) {
            group.labels.emplace_back(key, value);
        }
    }

    /// The name for a material; "leaf (2)" with the alias "leaf" where another one, with another
    /// reflectance, is called "leaf".
    std::string name_of(const GltfMaterial& material) {
        std::vector<std::optional<double>>& known = names_[material.name];
        const auto found = std::find(known.begin(), known.end(), material.reflectance);
        const auto number = found - known.begin() + 1;
        if (found == known.end()) {
            known.push_back(material.reflectance);
        }
        if (number == 1) {
            return material.name;
        }
        std::string unique = fmt::format("{} ({})", material.name, number);
        file_.aliases.emplace(unique, material.name);
        return unique;
    }

    /// The triangles of a mesh, read at its first use.
    const std::vector<Mesh>& shapes_of(std::size_t number) {
        std::optional<std::vector<Mesh>>& shapes = meshes_[number];
        if (!shapes) {
            shapes.emplace();
            for (const GltfPrimitive& primitive : document_.meshes[number].primitives) {
                const bool has_triangles = primitive.mode != CornerOrder::none;
                without_triangles_ += has_triangles ? 0 : 1;
                shapes->push_back(
                    has_triangles ? shapes_.triangles(primitive).value_or(Mesh()) : Mesh());
                note_material(primitive, shapes->back());
            }
        }
        return *shapes;
    }

    void note_material(const GltfPrimitive& primitive, const Mesh& triangles) {
        if (primitive.material && !triangles.faces.empty() &&
            document_.materials[*primitive.material].is_cut_out) {
            file_.masks.emplace(materials_[*primitive.material], "alphaMode");
        }
    }

    void finish() {
        for (std::size_t i = 0; i < materials_.size(); ++i) {
            if (const auto reflectance = document_.materials[i].reflectance) {
                file_.materials.push_back({materials_[i], *reflectance});
            }
        }
        if (without_triangles_ > 0) {
            context_.reporter.warn(fmt::format(
                "{} of lines or points left out", counted(without_triangles_, "primitive")));
        }
        shapes_.finish();
        drop_repeated_ids(file_, "node", context_.reporter);
    }

    const GltfDocument& document_;
    FormatContext& context_;
    GltfShapes shapes_;
    MeshFile file_{{}, {}, "node", {}};
    PlacedTriangles placed_;
    std::vector<std::optional<std::vector<Mesh>>> meshes_;             // the meshes read so far
    std::map<std::string, std::vector<std::optional<double>>> names_;  // reflectances by name
    std::vector<std::string> materials_;                               // names
    std::size_t without_triangles_ = 0;
};

}  // namespace

MeshFile read_gltf(std::string_view bytes, FormatContext& context) {
    MeshFile nothing{{}, {}, "node", {}};
    const auto container = open_gltf(bytes, context.reporter);
    if (!container) {
        return nothing;
    }
    Node root;
    try {
        root = read_json(container->json, context.reporter.file);
    } catch (const InputError& error) {
        context.reporter.faults.add(error);
        return nothing;
    }
    const auto document = read_gltf_document(root, context.reporter);
    if (!document) {
        return nothing;
    }
    GltfBuffers buffers(root, *container, context);
    return GltfSceneReader(*document, buffers, context).read();
}

}  // namespace quasimc

#include "meshio/gltf_document.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "meshio/gltf_values.h"
#include "text/line_scanner.h"

namespace quasimc {
namespace {

/// Whether a required extension does not affect geometry, or concerns numbers that are read anyway.
bool is_harmless(std::string_view extension) {
    return extension == "KHR_mesh_quantization" || extension == "KHR_lights_punctual" ||
           extension.starts_with("KHR_materials_") || extension.starts_with("KHR_texture_") ||
           extension.starts_with("EXT_texture_") || extension.starts_with("KHR_xmp");
}

/// Converts a value of extras to a label; empty for tables and lists.
std::optional<std::string> label_text(const Node& node) {
    if (const auto* text = node.as<std::string>()) {
        return one_line(*text);
    }
    if (const auto* whole = node.as<std::int64_t>()) {
        return std::to_string(*whole);
    }
    if (const auto* real = node.as<double>()) {
        return shortest(*real);
    }
    const bool* flag = node.as<bool>();
    return flag == nullptr ? std::nullopt : std::optional<std::string>(*flag ? "true" : "false");
}

void read_extras(const Node& json, GltfNode& node) {
    const Node* extras = json.find("extras");
    const auto* members = extras != nullptr ? extras->as<Node::Table>() : nullptr;
    for (std::size_t i = 0; members != nullptr && i < members->size(); ++i) {
        const Member& member = (*members)[i];
        const auto* id = member.node.as<std::int64_t>();
        const std::string key = one_line(member.key);
        const auto text = label_text(member.node);
        const bool is_known = find_label(node.labels, key) != nullptr;
        if (key == "id" && id != nullptr) {
            node.organ_id = *id;
        } else if (text && !text->empty() && !key.empty() && !is_known) {
            node.labels.emplace_back(key, *text);
        }
    }
}

CornerOrder mode_of(std::uint64_t number) {
    constexpr std::uint64_t kTriangles = 4, kStrip = 5, kFan = 6;
    return number == kTriangles ? CornerOrder::triangles
           : number == kStrip   ? CornerOrder::strip
           : number == kFan     ? CornerOrder::fan
                                : CornerOrder::none;
}

class GltfDocumentReader {
  public:
    GltfDocumentReader(const Node& root, Reporter& reporter)
        : root_(root), reporter_(reporter), values_(reporter) {}

    std::optional<GltfDocument> read() {
        const std::size_t before = reporter_.faults.size();
        check_version();
        check_extensions();
        if (reporter_.faults.size() == before) {
            warn_of_unknown_keys(root_, reporter_);
            read_materials();
            read_meshes();
            read_nodes();
            read_roots();
            check_trees();
        }
        return reporter_.faults.size() == before ? std::optional(std::move(file_)) : std::nullopt;
    }

  private:
    void check_version() {
        const Node* asset = root_.find("asset");
        const std::string version = asset != nullptr ? gltf_text(*asset, "version") : "";
        if (!version.starts_with("2.")) {
            values_.fault(
                "it is not glTF 2.0",
                version.empty() ? "its asset.version is missing" : "its version is " + version,
                "export it as glTF 2.0");
            return;
        }
        const std::string least = gltf_text(*asset, "minVersion");
        if (!least.empty() && least != "2.0") {
            values_.fault(
                "it needs a reader of glTF " + least, "minVersion; version 2.0 is supported",
                "export it as glTF 2.0");
        }
    }

    void check_extensions() {
        for (const Node& extension : gltf_list(root_, "extensionsRequired")) {
            const auto* name = extension.as<std::string>();
            if (name != nullptr && !is_harmless(*name)) {
                values_.fault(
                    fmt::format("it requires the extension {}", shown(*name)),
                    "it is not supported", "export without it, or without compression");
            }
        }
    }

    void read_materials() {
        for (const Node& json : gltf_list(root_, "materials")) {
            GltfMaterial material;
            const std::string where = fmt::format("material {}", file_.materials.size());
            material.name = one_line(gltf_text(json, "name"));
            material.name = material.name.empty() ? where : material.name;
            const std::string alpha = gltf_text(json, "alphaMode");
            material.is_cut_out = alpha == "MASK" || alpha == "BLEND";
            const Node* metallic_roughness = json.find("pbrMetallicRoughness");
            if (metallic_roughness != nullptr &&
                metallic_roughness->find("baseColorTexture") == nullptr) {
                constexpr std::size_t kColor = 4;
                const auto color =
                    values_.numbers(*metallic_roughness, "baseColorFactor", kColor, where);
                material.reflectance =
                    color ? std::optional(((*color)[0] + (*color)[1] + (*color)[2]) / 3)
                          : std::nullopt;
            }
            file_.materials.push_back(std::move(material));
        }
    }

    void read_meshes() {
        for (const Node& json : gltf_list(root_, "meshes")) {
            const std::string where = fmt::format("mesh {}", file_.meshes.size());
            check_weights(json, where);
            GltfMesh mesh{one_line(gltf_text(json, "name")), {}};
            for (const Node& primitive : gltf_list(json, "primitives")) {
                mesh.primitives.push_back(read_primitive(primitive, where));
            }
            file_.meshes.push_back(std::move(mesh));
        }
    }

    GltfPrimitive read_primitive(const Node& json, const std::string& where) {
        constexpr std::uint64_t kUsual = 4;
        GltfPrimitive primitive;
        primitive.mode = mode_of(values_.whole(json, "mode", where).value_or(kUsual));
        primitive.material = values_.index(json, "material", file_.materials.size(), where);
        const std::size_t accessors = gltf_list(root_, "accessors").size();
        primitive.indices = values_.index(json, "indices", accessors, where);
        if (const Node* attributes = json.find("attributes")) {
            primitive.positions = values_.index(*attributes, "POSITION", accessors, where);
        }
        if (!primitive.positions) {
            values_.fault(where + " has a part without positions", "");
        }
        return primitive;
    }

    void check_weights(const Node& json, const std::string& where) {
        const Node::List& weights = gltf_list(json, "weights");
        const bool is_blended = std::any_of(weights.begin(), weights.end(), [](const Node& weight) {
            const auto* whole = weight.as<std::int64_t>();
            const auto* real = weight.as<double>();
            return (whole == nullptr || *whole != 0) && (real == nullptr || *real != 0);
        });
        if (is_blended) {
            values_.fault(
                where + " has morph targets (weights)", "they are not supported",
                "apply the shape keys and export again");
        }
    }

    void read_nodes() {
        const Node::List& nodes = gltf_list(root_, "nodes");
        for (const Node& json : nodes) {
            const std::string where = fmt::format("node {}", file_.nodes.size());
            GltfNode node;
            node.name = one_line(gltf_text(json, "name"));
            node.mesh = values_.index(json, "mesh", file_.meshes.size(), where);
            node.children = values_.indices(json, "children", nodes.size(), where);
            node.transform = values_.transform(json, where);
            check_weights(json, where);
            refuse_deformed(json, where);
            read_extras(json, node);
            file_.nodes.push_back(std::move(node));
        }
    }

    void refuse_deformed(const Node& json, const std::string& where) {
        if (json.find("skin") != nullptr && json.find("mesh") != nullptr) {
            values_.fault(
                where + " has a skin", "skinned meshes are not supported",
                "apply the armature and export again");
        }
        const Node* extensions = json.find("extensions");
        if (extensions != nullptr && extensions->find("EXT_mesh_gpu_instancing") != nullptr) {
            values_.fault(
                where + " has the extension 'EXT_mesh_gpu_instancing'", "it is not supported",
                "export each copy as a node");
        }
    }

    /// Reads the roots: the nodes of the default scene, or else the nodes without a parent.
    void read_roots() {
        const Node::List& scenes = gltf_list(root_, "scenes");
        if (!scenes.empty()) {
            const auto scene = values_.index(root_, "scene", scenes.size(), "the file");
            file_.roots = values_.indices(
                scenes[scene.value_or(0)], "nodes", file_.nodes.size(), "the scene");
            return;
        }
        std::vector<bool> is_child(file_.nodes.size());
        for (const GltfNode& node : file_.nodes) {
            for (const std::size_t child : node.children) {
                is_child[child] = true;
            }
        }
        for (std::size_t i = 0; i < is_child.size(); ++i) {
            if (!is_child[i]) {
                file_.roots.push_back(i);
            }
        }
    }

    /// Checks that each node has one parent, or is a root.
    void check_trees() {
        std::vector<int> parents(file_.nodes.size());
        const auto count = [&](const std::vector<std::size_t>& numbers) {
            for (const std::size_t number : numbers) {
                if (++parents[number] == 2) {
                    values_.fault(
                        fmt::format(
                            "node {} has two parents, or appears twice in the scene", number),
                        "nodes must form trees");
                }
            }
        };
        count(file_.roots);
        for (const GltfNode& node : file_.nodes) {
            count(node.children);
        }
    }

    const Node& root_;
    Reporter& reporter_;
    GltfValues values_;
    GltfDocument file_;
};

}  // namespace

std::optional<GltfDocument> read_gltf_document(const Node& root, Reporter& reporter) {
    return GltfDocumentReader(root, reporter).read();
}

}  // namespace quasimc

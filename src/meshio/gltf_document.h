#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "meshio/formats.h"
#include "quasimc/mesh.h"
#include "quasimc/scene.h"
#include "text/document.h"

namespace quasimc {

/// How the corners of triangles follow each other; what is none has no triangles.
enum class CornerOrder { none, triangles, strip, fan };

/// A part of a mesh that is of one material.
struct GltfPrimitive {
    CornerOrder mode = CornerOrder::triangles;
    std::optional<std::size_t> positions, indices, material;  ///< accessors; of the materials
};

struct GltfMesh {
    std::string name;
    std::vector<GltfPrimitive> primitives;
};

struct GltfNode {
    std::string name;
    std::optional<std::size_t> mesh;
    std::vector<std::size_t> children;
    Affine transform;                      ///< to the axes of its parent
    std::optional<std::int64_t> organ_id;  ///< `id` of its extras
    Labels labels;                         ///< the rest of its extras: texts, numbers, booleans
};

struct GltfMaterial {
    std::string name;
    std::optional<double> reflectance;  ///< mean of its base colour, if that is stated as a number
    bool is_cut_out = false;            ///< its texture makes parts of it transparent
};

/// What of a glTF file is geometry. Every number that names another part is that of one that is
/// there, and nodes are trees.
struct GltfDocument {
    std::vector<GltfMesh> meshes;
    std::vector<GltfNode> nodes;
    std::vector<GltfMaterial> materials;
    std::vector<std::size_t> roots;  ///< nodes of the scene
};

/// Reads glTF 2.0. @returns nothing after a fault
[[nodiscard]] std::optional<GltfDocument> read_gltf_document(const Node& root, Reporter& reporter);

}  // namespace quasimc

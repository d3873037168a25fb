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

/// Order of the corners of triangles; `none` for points and lines.
enum class CornerOrder { none, triangles, strip, fan };

/// A part of a mesh that is of one material.
struct GltfPrimitive {
    CornerOrder mode = CornerOrder::triangles;
    /// Numbers of accessors, and of the material.
    std::optional<std::size_t> positions, indices, material;
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
    Labels labels;                         ///< its other extras: texts, numbers, booleans
};

struct GltfMaterial {
    std::string name;
    std::optional<double> reflectance;  ///< mean of its base colour, if that is given as numbers
    bool is_cut_out = false;            ///< its texture makes parts transparent
};

/// The geometry of a glTF file. All references between its parts are valid, and nodes form trees.
struct GltfDocument {
    std::vector<GltfMesh> meshes;
    std::vector<GltfNode> nodes;
    std::vector<GltfMaterial> materials;
    std::vector<std::size_t> roots;  ///< nodes of the scene
};

/// Reads glTF 2.0. @returns empty after a fault
[[nodiscard]] std::optional<GltfDocument> read_gltf_document(const Node& root, Reporter& reporter);

}  // namespace quasimc

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "quasimc/scene.h"
#include "runfile/file_materials.h"

namespace quasimc {

/// A copy of a file.
struct FileCopy {
    std::string name;  ///< prefix of the names of its organs
    Labels labels = {};
    Affine transform = {};
    std::size_t file = 0;  ///< index among the files of its table
};

/// The organs of a [[geometry]] table, apart from their triangles.
struct GeometryKeys {
    std::string organs;  ///< "each", "groups" or "one"
    std::optional<std::int64_t> first_id = {};
    bool measured = true;
    /// Copies share the meshes of their files. Without copies there is one, whose triangles are
    /// not moved.
    std::vector<FileCopy> copies = {};
    bool has_copies = false;
};

/// A file of a table, with the materials of the run for those in the file.
struct FileOfTable {
    std::string name;
    MeshFile mesh;
    FoundMaterials materials;
};

/// Adds the organs of a table to a builder, copy by copy.
void add_geometry(const GeometryKeys& keys, std::vector<FileOfTable> files, SceneBuilder& builder);

}  // namespace quasimc

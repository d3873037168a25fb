#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/vec3.h"
#include "quasimc/mesh.h"

namespace quasimc {

/// A mesh of an OPF file, in coordinates of its own.
struct OpfMesh {
    std::vector<Vec3> points;
    std::vector<std::vector<std::uint32_t>> faces;
    bool is_scaled = true;     ///< its girth follows the diameters of the node (enableScale)
    bool says_scaled = false;  ///< whether the file says so, or that it does not
};

/// A mesh and what it is made of, by their ids.
struct OpfShape {
    std::optional<std::int64_t> mesh, material;
};

/// The meshes, materials and shapes at the head of an OPF file, by their ids.
struct OpfLibrary {
    std::map<std::int64_t, OpfMesh> meshes;
    std::map<std::int64_t, double> reflectances;  ///< of materials: mean of the diffuse colour
    std::map<std::int64_t, OpfShape> shapes;

    /// The mesh of a shape, or null.
    [[nodiscard]] const OpfMesh* find_mesh(std::int64_t shape) const;
    /// "material 1"; "" if the shape names none.
    [[nodiscard]] std::string material_of(std::int64_t shape) const;
};

/// How a node of the plant places a shape.
struct OpfPlace {
    std::optional<std::int64_t> shape;
    Affine transform;
    double diameter_down = 1, diameter_up = 1;  ///< at the ends of the mesh's x axis
};

/// The points of a mesh where a node has it: y and z times the diameter that is interpolated along
/// x, if the mesh is scaled, and then moved.
[[nodiscard]] std::vector<Vec3> placed_points(const OpfMesh& mesh, const OpfPlace& place);

}  // namespace quasimc

#pragma once

#include <memory>
#include <optional>

#include "base/notices.h"
#include "quasimc/mesh.h"

namespace quasimc {

struct NamedFile;  // growth/view/view_lines.h

/// A predefined surface of Bezier patches, in units of its size: x to the left of the turtle, y
/// along its heading, z up.
struct BezierSurface {
    char name = 0;
    std::shared_ptr<const Mesh> mesh;  ///< triangles of all patches
    Vec3 end_point;                    ///< where the turtle goes
    Bounds control_bounds;             ///< bounds of the control points
};

/// Divisions of each patch along s, across its rows of points, and along t, within them.
struct PatchDivisions {
    int s = 0, t = 0;  ///< if one is 0, the S of the file's PRECISION for both
};

/// Adds the triangles of a patch to a mesh, in the order of cpfg.
void add_patch_triangles(const BezierPatch& points, PatchDivisions divisions, Mesh& mesh);

/// Reads a surface file (.s). Neighbours share their vertices within a patch only.
/// @param size  factor of the view file
/// @returns nothing, after a notice, if patches do not name each other as neighbours
/// @throws InputError
[[nodiscard]] std::optional<BezierSurface> read_surface_file(
    const NamedFile& file, double size, PatchDivisions divisions, Notices& notices);

}  // namespace quasimc

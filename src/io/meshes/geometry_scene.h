#pragma once

#include <string>
#include <vector>

#include "io/meshes/formats.h"
#include "quasimc/file.h"
#include "scene/scene.h"

namespace quasimc {

/// What becomes of triangles that lie on each other.
enum class Overlaps {
    cut,   ///< as in a run: light falls on the first of them only
    keep,  ///< all are kept as the file has them
};

/// A geometry file by itself, without optics or light.
struct GeometryScene {
    Scene scene;  ///< materials have the names of the file ("unnamed" without one), and no meaning
    std::vector<Warning> warnings;  ///< of the reader
    std::vector<InputFile> inputs;  ///< what was read
};

/// Reads a geometry file. Its organs are those that a run file gets that says nothing of them.
/// @throws InputError  with all faults
[[nodiscard]] GeometryScene read_geometry_scene(
    const std::string& path, const FormatEntry& format, Overlaps overlaps);

}  // namespace quasimc

#pragma once

#include <string>
#include <vector>

#include "meshio/formats.h"
#include "quasimc/error.h"
#include "scene/scene.h"

namespace quasimc {

/// A geometry file by itself, without optics or light.
struct GeometryScene {
    Scene scene;  ///< materials have the names of the file ("unnamed" without one), and no meaning
    std::vector<Warning> warnings;  ///< of the reader and of lint()
    std::vector<InputFile> inputs;  ///< what was read
    std::string unit;               ///< of length; "" if the file states none
};

/// Reads a geometry file. Its organs are those that a run file gets that says nothing of them.
/// Triangles that lie on others are cut away, as in a run.
/// @throws InputError  with all faults
[[nodiscard]] GeometryScene read_geometry_scene(const std::string& path, const FormatEntry& format);

/// Warnings of the names of materials and the labels that a scene has and a format does not keep.
[[nodiscard]] std::vector<Warning> lost_when_written(const FormatEntry& format, const Scene& scene);

}  // namespace quasimc

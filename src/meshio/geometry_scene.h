#pragma once

#include <string>
#include <vector>

#include "meshio/formats.h"
#include "quasimc/error.h"
#include "scene/scene.h"

namespace quasimc {

/// A geometry file by itself, without optics or light.
struct GeometryScene {
    Scene scene;  ///< materials have the names of the file ("unnamed" without one) and arbitrary
                  ///< optics
    std::vector<Warning> warnings;  ///< from the reader and from lint()
    std::vector<InputFile> inputs;  ///< files that were read
    std::string unit;               ///< unit of length; "" if the file has none
};

/// Reads a geometry file, with the organs that a run file gets by default. Coplanar overlaps are
/// cut away, as in a run.
/// @throws InputError  with all faults
[[nodiscard]] GeometryScene read_geometry_scene(const std::string& path, const FormatEntry& format);

/// Warns of names of materials and labels of a scene that a format does not store.
[[nodiscard]] std::vector<Warning> lost_when_written(const FormatEntry& format, const Scene& scene);

}  // namespace quasimc

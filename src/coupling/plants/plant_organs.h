#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "growth/turtle/mesh_drawing.h"
#include "quasimc/scene.h"

namespace quasimc {

/// The name of the material that the shapes of a colour index have: "color 2".
[[nodiscard]] std::string color_material(int color);

/// The organs of a drawing, in its order: one for each module that has triangles. Its id is one
/// more than the index of the module in the string, its name is "L 12" for the module L with the
/// id 12, and its labels are module, step, branch and order. Instances stay instances.
/// @param step  derivation steps of the string
[[nodiscard]] std::vector<OrganSpec> plant_organs(const MeshDrawing& drawing, std::int64_t step);

/// A drawing as a scene with one band, in the axes of plants (y up): each colour index is a
/// material with the optics of a plain leaf.
/// @returns nothing if no module has triangles
/// @throws InputError  as SceneBuilder::build
[[nodiscard]] std::optional<Scene> drawn_plant_scene(const MeshDrawing& drawing, std::int64_t step);

}  // namespace quasimc

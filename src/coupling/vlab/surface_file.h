#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "quasimc/mesh.h"

namespace quasimc {

/// Reads a surface of Bezier patches (.s) as the plant simulators draw it: moved to its contact
/// point, turned into the frame of an organ (x across, y along the heading, z up; the upper side of
/// each patch towards z), and divided by its SIZE (the largest extent if it has none).
/// @param subdivisions  0 to 6: each step quarters the distance of the triangles from the surface,
///                      from a fiftieth of its size on
/// @throws InputError  if something is missing or no number, with its line
[[nodiscard]] std::vector<Triangle> read_surface_text(
    std::string_view text, const std::string& name, int subdivisions);

}  // namespace quasimc

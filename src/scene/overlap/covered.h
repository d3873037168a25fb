#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/mesh/cell.h"
#include "geometry/scene_geometry.h"
#include "optics/material.h"
#include "quasimc/scene.h"
#include "scene/assembly.h"
#include "scene/overlap/known_overlaps.h"

namespace quasimc {

/// Whose the light is where two organs lie on each other.
enum class OverlapOwner {
    first,  ///< to the one that comes first; the other is cut away there
    both,   ///< one is a sensor: it stands just above, on its upper side, and lets light pass
};

/// Triangles of one organ that lie on those of another, or of itself, which comes before.
struct Coincidence {
    OrganIndex first, second;
    std::uint32_t triangles = 0;  ///< of the second
    bool is_same = false;         ///< they have the same corners
    OverlapOwner light = OverlapOwner::first;
};

/// What of a scene lies on each other in one plane.
struct Coincidences {
    std::vector<Coincidence> pairs;
    bool is_skipped = false;  ///< there are too many triangles to look
    bool gave_up = false;     ///< too many lie close together to compare all
};

/// Triangles of which none lies on another, and what did.
struct CutGeometry {
    std::shared_ptr<const SceneGeometry> geometry;
    Coincidences coincidences;
};

/// Takes the triangles out of `scene`, and cuts away what coincides with a surface that comes
/// before it: of triangles that lie on each other in one plane, also through the borders of a
/// periodic cell, the part that they share stays with the organ that comes first, and the light on
/// both of its sides is that organ's (docs/develop/decisions/coplanar-overlaps.md). Organs keep
/// their areas; Organ::covered_area tells how much was cut away. Sensors, which let light pass,
/// neither cover nor are covered: where one lies on a surface it is lifted a little to its own
/// upper side, so that light meets both.
/// @throws InputError  if so many images of the same triangles lie on each other in the cell that
/// they can't be compared
/// @param known  of the scene before, for one that differs little from it; or null
[[nodiscard]] CutGeometry cut_covered(
    DraftAssembly& scene,
    const Cell& cell,
    const std::vector<Material>& materials,
    KnownOverlaps* known = nullptr);

}  // namespace quasimc

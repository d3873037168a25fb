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

/// Organ that receives the light where two organs overlap.
enum class OverlapOwner {
    first,  ///< the first organ; the other is cut away there
    both,   ///< one is a sensor, which is moved slightly to its upper side and lets light pass
};

/// Triangles of one organ that lie on those of an earlier organ, or on earlier ones of the same
/// organ.
struct Coincidence {
    OrganIndex first, second;
    std::uint32_t triangles = 0;  ///< number of the second organ's triangles
    bool is_same = false;         ///< they have the same corners
    OverlapOwner light = OverlapOwner::first;
};

/// Coplanar overlaps of a scene.
struct Coincidences {
    std::vector<Coincidence> pairs;
    bool is_skipped = false;  ///< too many triangles for a search
    bool gave_up = false;     ///< too many lie close together to compare all
};

/// Triangles without overlaps, and the overlaps that were cut away.
struct CutGeometry {
    std::shared_ptr<const SceneGeometry> geometry;
    Coincidences coincidences;
};

/// Takes the triangles out of `scene` and cuts coplanar overlaps: the common part of coplanar
/// triangles, also across the borders of a periodic cell, belongs to the first organ, which
/// receives the light on both sides of it (docs/develop/decisions/coplanar-overlaps.md). Organs
/// keep their areas; Organ::covered_area is the area that was cut away. Sensors, which let light
/// pass, neither cover nor are covered: a sensor on a surface is moved slightly to its own upper
/// side, so that light hits both.
/// @throws InputError  if too many periodic copies of the same triangles overlap to be compared
/// @param known  overlaps of the previous scene, if it differs little; or null
[[nodiscard]] CutGeometry cut_covered(
    DraftAssembly& scene,
    const Cell& cell,
    const std::vector<Material>& materials,
    KnownOverlaps* known = nullptr);

}  // namespace quasimc

#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/scene_draft.h"

namespace quasimc {

class KnownOverlaps;

/// What a SceneBuilder was given.
struct BuilderData {
    std::vector<Band> bands;
    Orientation orientation;
    std::string length_unit = "m";
    std::vector<std::pair<MaterialSpec, std::string>> materials;  ///< each with its location
    SceneDraft draft;
    std::optional<GroundSpec> ground;
    std::vector<DetectorSpec> detectors;
    Cell cell;
};

/// Returns the scene that build() gives, in less time if it differs little from the one before.
/// @param known  overlaps of the scene before, which become those of this one; or null
[[nodiscard]] Scene build_after(SceneBuilder builder, KnownOverlaps* known);

/// Returns whether build_on() gives what build() would with the organs, ground, cell and axes of
/// `scene`: it has the same bands, and materials of the same names in the same order, of which
/// the same ones let all light pass (what coincides is cut accordingly).
[[nodiscard]] bool can_build_on(const SceneBuilder& builder, const Scene& scene);

/// Returns a scene with the organs, ground, cell and axes of another one, whose triangles it
/// shares, and with the materials and detectors of a builder. Organs of the builder are left out.
/// Takes no time for the triangles.
/// @param scene  on which can_build_on()
/// @throws InputError  with every fault of materials and detectors
[[nodiscard]] Scene build_on(const SceneBuilder& builder, const Scene& scene);

}  // namespace quasimc

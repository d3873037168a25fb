#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/scene_draft.h"

namespace quasimc {

class KnownOverlaps;

/// Input of a SceneBuilder.
struct BuilderData {
    std::vector<Band> bands;
    Orientation orientation;
    std::string length_unit = "m";
    std::vector<std::pair<MaterialSpec, std::string>> materials;  ///< each with its location
    SceneDraft draft;
    std::optional<GroundSpec> ground;
    std::vector<DetectorSpec> detectors;
    std::vector<SensorSet> sensors;
    Cell cell;
};

/// Returns the scene of build(), in less time if it differs little from the previous scene.
/// @param known  overlaps of the previous scene, replaced by those of this one; or null
[[nodiscard]] Scene build_after(SceneBuilder builder, KnownOverlaps* known);

/// Returns whether build_on() has the result of build() with the organs, ground, cell and axes of
/// `scene`: the bands are the same, and so are the names and order of the materials and which of
/// them let all light pass (coplanar overlaps are cut accordingly).
[[nodiscard]] bool can_build_on(const SceneBuilder& builder, const Scene& scene);

/// Returns a scene with the organs, ground, cell and axes of another one, whose triangles it
/// shares, and with the materials, detectors and sensors of a builder. Organs of the builder are
/// left out.
/// The time does not depend on the number of triangles.
/// @param scene  on which can_build_on()
/// @throws InputError  with every fault of materials, detectors and sensors
[[nodiscard]] Scene build_on(const SceneBuilder& builder, const Scene& scene);

}  // namespace quasimc

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "coupling/vlab/organ_shapes.h"

namespace quasimc {

/// An organ to be put into a scene.
struct PlacedShape {
    std::uint32_t query = 0;  ///< index in Pass::queries
    bool is_sensor = false;
    OrganShape shape;
};

/// The scene of some of the specification's bands: organs in the order of the shapes, then the
/// ground, if there is one.
/// @throws InputError  as SceneBuilder::build
[[nodiscard]] Scene build_plant_scene(
    const Specification& spec,
    std::span<const std::size_t> bands,
    const Pass& pass,
    std::span<const PlacedShape> shapes);

}  // namespace quasimc

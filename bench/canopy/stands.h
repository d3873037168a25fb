#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "quasimc/run.h"
#include "scene/scene.h"

namespace quasimc::bench {

/// Five stands of different kinds, two bands (PAR and NIR), under a sun and a sky. Made by code
/// alone, the same on every machine. tests/statistical uses small ones.
enum class StandKind {
    random_leaves,   ///< triangles in a cube
    clumped_plants,  ///< stems and rhombic leaves, nine plants
    curved_leaves,   ///< Bezier surfaces of hundreds of triangles each
    shiny_leaves,    ///< Phong and Blinn-Phong lobes, and mirrors on one leaf in ten
    over_ground,     ///< leaves above a soil
};
inline constexpr std::array kStandKinds{
    StandKind::random_leaves, StandKind::clumped_plants, StandKind::curved_leaves,
    StandKind::shiny_leaves, StandKind::over_ground};

[[nodiscard]] std::string name_of(StandKind kind);

/// @param leaves  about so many; the leaf area index stays
[[nodiscard]] Scene make_stand(StandKind kind, std::uint32_t leaves);

[[nodiscard]] Sources light_of_stands();

}  // namespace quasimc::bench

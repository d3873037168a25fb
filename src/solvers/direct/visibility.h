#pragma once

// Shadow rays: of next-event estimation, of connections and of bright spots. Sensors are
// transparent to them.

#include "transport/prepared_scene.h"

namespace quasimc {

/// Whether light passes between `p` on triangle `self` of the mesh and a source at `distance`
/// (local units; infinite: the sky).
[[nodiscard]] bool is_visible_source(
    const PreparedScene& prepared,
    const Vec3& p,
    const Vec3& direction,
    double distance,
    std::uint32_t self);

/// Whether light passes between `p` on triangle `self` of the mesh and a point at `distance` (local
/// units) on triangle `other`. Not in periodic scenes.
[[nodiscard]] bool is_visible_point(
    const PreparedScene& prepared,
    const Vec3& p,
    const Vec3& direction,
    double distance,
    std::uint32_t self,
    std::uint32_t other);

}  // namespace quasimc

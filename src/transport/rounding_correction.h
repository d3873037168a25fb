#pragma once

#include <cmath>
#include <cstdint>

#include "geometry/cast/ray_caster.h"
#include "quasimc/mesh.h"
#include "scene/scene.h"

namespace quasimc {

/// The cosine up to which light counts as parallel to a surface: corners have single precision.
inline constexpr double kEdgeOn = 0x1p-24;

/// Corrections of the light on triangles for the single precision in which they are traced.
class RoundingCorrection {
  public:
    RoundingCorrection(const Scene& scene, const RayCaster& caster);

    /// Light along `direction` on a triangle as given, over light on its rounded corners. It
    /// differs from 1 for slivers (LocalMesh::exact_share), and for triangles that rounding turns,
    /// in grazing light. @param cosine  dot(unit normal, direction) as traced
    [[nodiscard]] double light_share(
        std::uint32_t mesh_triangle, const Vec3& direction, double cosine) const {
        const double share = mesh_->exact_share(mesh_triangle, direction);
        return share != 1 || std::abs(cosine) > grazing_ ? share
                                                         : grazed_share(mesh_triangle, direction);
    }
    /// Lit area of a triangle that is_sunlit(), over that of its rounded corners. Rounding may turn
    /// these, so their lit area follows from their own cosine.
    [[nodiscard]] double area_share(std::uint32_t mesh_triangle) const {
        return mesh_->exact_area_share(mesh_triangle);
    }
    /// Whether light of a sun along `direction` (of either sign) makes a triangle of the mesh count
    /// as sunlit: not if it is parallel to the given surface, to rounding (kEdgeOn).
    /// @param cosine  dot(unit normal, direction) as traced
    [[nodiscard]] bool is_sunlit(
        std::uint32_t mesh_triangle, const Vec3& direction, double cosine) const {
        // Rounding of the corners hardly turns a surface by more.
        constexpr double kSteep = 1e-3;
        return std::abs(cosine) > kSteep || lights_as_given(mesh_triangle, direction);
    }

  private:
    [[nodiscard]] double grazed_share(std::uint32_t mesh_triangle, const Vec3& direction) const;
    [[nodiscard]] bool lights_as_given(std::uint32_t mesh_triangle, const Vec3& direction) const;
    [[nodiscard]] Vec3 given_across(std::uint32_t mesh_triangle) const;

    const Scene* scene_;
    const RayCaster* caster_;
    const LocalMesh* mesh_;
    double grazing_;  ///< cosine above which rounding changes the light too little to be corrected
};

}  // namespace quasimc

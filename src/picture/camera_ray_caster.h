#pragma once

#include <optional>
#include <vector>

#include "geometry/cast/ray_caster.h"
#include "picture/camera.h"
#include "quasimc/scene.h"

namespace quasimc {

/// Clips a scene to one side of a plane: dot(normal, p) <= offset; world, z up.
struct CutPlane {
    Vec3 normal;
    double offset = 0;
};

/// The first hit of a camera ray.
struct PrimaryHit {
    Hit hit;  ///< in the caster's mesh, local coordinates
    std::uint32_t region = 0;
    Vec3 direction;  ///< unit vector along the ray
};

/// Casts camera rays into a clipped scene. A periodic scene is reduced to one cell, but for a
/// fisheye, which sees all of it.
class CameraRayCaster {
  public:
    /// All arguments must outlive this object.
    CameraRayCaster(const Scene& scene, const Camera& camera, const std::vector<CutPlane>& cuts);

    /// @param pixel  in the picture. @returns nothing for background
    [[nodiscard]] std::optional<PrimaryHit> trace(const PixelPoint& pixel) const;
    [[nodiscard]] const RayCaster& caster() const { return caster_; }

  private:
    const Scene& scene_;
    const Camera& camera_;
    const std::vector<CutPlane>& cuts_;
    RayCaster caster_;
    Bounds box_;
};

}  // namespace quasimc

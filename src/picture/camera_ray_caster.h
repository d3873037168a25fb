#pragma once

#include <optional>
#include <vector>

#include "geometry/cast/ray_caster.h"
#include "picture/camera.h"
#include "quasimc/scene.h"

namespace quasimc {

/// What lies on one side of a plane is shown: dot(normal, p) <= offset; world, z up.
struct CutPlane {
    Vec3 normal;
    double offset = 0;
};

/// What a line of sight meets.
struct PrimaryHit {
    Hit hit;  ///< of the caster's mesh, local coordinates
    std::uint32_t region = 0;
    Vec3 direction;  ///< of the line, unit
};

/// Casts lines of sight into a scene, of which cuts leave a part. Of a periodic scene one cell.
class CameraRayCaster {
  public:
    /// All outlive the object.
    CameraRayCaster(const Scene& scene, const Camera& camera, const std::vector<CutPlane>& cuts);

    /// @param pixel  in the picture. @returns nothing where nothing is seen
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

#pragma once

#include <cstddef>
#include <memory>
#include <stop_token>

#include "geometry/cast/ray_caster.h"
#include "scene/scene.h"

namespace quasimc {

/// Caches the ray caster of the last scene. It is rebuilt when triangles, cell or accelerator
/// change.
class CachedRayCaster {
  public:
    /// @throws StopRequested  if a stop is requested during the construction
    /// @throws InputError  if there is not enough memory for it
    [[nodiscard]] std::shared_ptr<const RayCaster> caster_for(
        const Scene& scene, Accelerator accelerator, const std::stop_token& stop);
    /// Releases the cached ray caster.
    void forget();
    /// Number of ray casters built.
    [[nodiscard]] std::size_t builds() const { return builds_; }

  private:
    std::shared_ptr<const RayCaster> caster_;
    std::shared_ptr<const SceneGeometry> triangles_;  // of caster_, with cell and accelerator:
    Cell cell_;
    Accelerator accelerator_ = Accelerator::embree;
    std::size_t builds_ = 0;
};

}  // namespace quasimc

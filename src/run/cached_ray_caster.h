#pragma once

#include <cstddef>
#include <memory>
#include <stop_token>

#include "geometry/cast/ray_caster.h"
#include "scene/scene.h"

namespace quasimc {

/// The ray caster of the scene that was asked for last: it is built anew when triangles, cell or
/// accelerator are others.
class CachedRayCaster {
  public:
    /// @throws StopRequested  if it was stopped while it was built
    /// @throws InputError  if there is not enough memory for it
    [[nodiscard]] std::shared_ptr<const RayCaster> caster_for(
        const Scene& scene, Accelerator accelerator, const std::stop_token& stop);
    /// Gives its memory back.
    void forget();
    /// How many were built.
    [[nodiscard]] std::size_t builds() const { return builds_; }

  private:
    std::shared_ptr<const RayCaster> caster_;
    std::shared_ptr<const SceneGeometry> triangles_;  // of caster_, with cell and accelerator:
    Cell cell_;
    Accelerator accelerator_ = Accelerator::embree;
    std::size_t builds_ = 0;
};

}  // namespace quasimc

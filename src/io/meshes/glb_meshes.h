#pragma once

#include <cstdint>
#include <vector>

#include "quasimc/mesh.h"
#include "quasimc/vec3.h"
#include "scene/scene.h"

namespace quasimc {

/// Takes parts of a scene as meshes of their own, in metres with y up, as glTF has it.
class GlbMeshes {
  public:
    explicit GlbMeshes(const Scene& scene);

    /// The triangles of a scene from one number on, with the vertices that they share.
    /// @param first, count  triangles of one region
    [[nodiscard]] Mesh mesh(std::uint32_t first, std::uint32_t count);

  private:
    static constexpr std::uint32_t kNone = 0xFFFFFFFF;

    const Scene& scene_;
    Affine outward_;                      // from the scene's axes and unit
    std::vector<std::uint32_t> numbers_;  // of the scene's vertices in the mesh being made
};

/// The middle of the box about points; the origin if there are none.
[[nodiscard]] Vec3 middle_of(const std::vector<Vec3>& points);

}  // namespace quasimc

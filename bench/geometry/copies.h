#pragma once

#include <memory>
#include <vector>

#include "geometry/mesh/local_mesh.h"
#include "scenes.h"

namespace quasimc::bench {

/// Copies of the unit square as instances of one tree, used like a caster.
class Copies {
  public:
    /// Makes `reach` copies to each side, (2 reach + 1)^2 in all.
    Copies(const std::vector<Triangle>& triangles, int reach);
    ~Copies();
    Copies(const Copies&) = delete;
    Copies& operator=(const Copies&) = delete;

    [[nodiscard]] const LocalMesh& mesh() const { return mesh_; }

    /// Whether a ray hits anything except the triangle it starts on; computes its first hit.
    [[nodiscard]] bool cast(const BenchRay& ray) const;

  private:
    struct Scene;
    LocalMesh mesh_;
    std::unique_ptr<Scene> scene_;
};

}  // namespace quasimc::bench

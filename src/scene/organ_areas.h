#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/scene_geometry.h"
#include "scene/scene.h"

namespace quasimc {

/// Cumulative areas of the triangles of each organ. Instances use those of their mesh.
class OrganAreas {
  public:
    OrganAreas(std::shared_ptr<const SceneGeometry> geometry, const std::vector<Organ>& organs);

    /// A triangle of an organ chosen by cumulative area, and the position within it.
    struct Pick {
        std::uint32_t triangle = 0;
        double fraction = 0;  ///< part of the triangle's area before it, 0 to 1
    };
    [[nodiscard]] Pick pick(const Organ& organ, double area) const;

  private:
    [[nodiscard]] Pick pick_of_instances(const Organ& organ, double area) const;

    void sum_within(const Organ& organ);

    std::shared_ptr<const SceneGeometry> geometry_;
    std::vector<double> until_;                    // by triangle that belongs to no instance
    std::vector<double> instance_until_;           // by instance, summed within its organ
    std::vector<std::uint32_t> sums_;              // by instance: index of its list below
    std::vector<std::vector<double>> mesh_until_;  // sums over the triangles of a mesh
};

/// Returns the areas of a scene, computed at the first call. Copies of a scene share them.
[[nodiscard]] const OrganAreas& organ_areas(const Scene& scene);

}  // namespace quasimc

#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/scene_geometry.h"
#include "scene/scene.h"

namespace quasimc {

/// The areas of triangles, summed within each organ. Those of an instance follow from its mesh.
class OrganAreas {
  public:
    OrganAreas(std::shared_ptr<const SceneGeometry> geometry, const std::vector<Organ>& organs);

    /// A triangle of an organ, and where in it a number falls that runs through the organ's area.
    struct Pick {
        std::uint32_t triangle = 0;
        double fraction = 0;  ///< of the triangle's area before it, 0 to 1
    };
    [[nodiscard]] Pick pick(const Organ& organ, double area) const;

  private:
    [[nodiscard]] Pick pick_of_instances(const Organ& organ, double area) const;

    void sum_within(const Organ& organ);

    std::shared_ptr<const SceneGeometry> geometry_;
    std::vector<double> until_;           // of each triangle that belongs to no instance
    std::vector<double> instance_until_;  // of each instance, summed within its organ
    std::vector<std::uint32_t> sums_;     // of each instance: which of the lists below is its own
    std::vector<std::vector<double>> mesh_until_;  // sums over the triangles of a mesh
};

/// Returns the areas of a scene, computed at the first call. Copies of a scene share them.
[[nodiscard]] const OrganAreas& organ_areas(const Scene& scene);

}  // namespace quasimc

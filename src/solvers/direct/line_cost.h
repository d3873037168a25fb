#pragma once

#include "raster/projected_scene.h"

namespace quasimc {

/// Cost of scan lines across a beam in a periodic scene: in low light the projection of a triangle
/// reaches over many periods, and a line cuts as many images of it.
class LineCost {
  public:
    /// Takes time in proportion to the triangles.
    explicit LineCost(const ProjectedScene& scene);

    /// An upper bound of the mean number of images of triangles that a scan line cuts
    /// (raster/scan_lines.h), about twice the number itself. 0 in an open scene, which does not use
    /// it. @param direction  of a beam that meets the scene, unit
    [[nodiscard]] double cuts_per_line(const Vec3& direction) const;

  private:
    const ProjectedScene& scene_;
    Vec3 extents_;  ///< extents along x, y, z, summed over triangles
    Vec3 areas_;    ///< projected areas along x, y, z, summed over triangles
};

}  // namespace quasimc

#pragma once

#include "raster/projected_scene.h"

namespace quasimc {

/// What scan lines across a beam cost in a periodic scene: where light comes in low, a triangle is
/// seen so long that it reaches into many periods, and a line cuts as many images of it.
class LineCost {
  public:
    /// Takes time in proportion to the triangles.
    explicit LineCost(const ProjectedScene& scene);

    /// An upper bound of the mean number of images of triangles that a scan line cuts
    /// (raster/scan_lines.h), about twice the number itself. 0 in an open scene, where it
    /// is not asked for. @param direction  of a beam that meets the scene, unit
    [[nodiscard]] double cuts_per_line(const Vec3& direction) const;

  private:
    const ProjectedScene& scene_;
    Vec3 extents_;  ///< sums over triangles of their extents along x, y, z
    Vec3 areas_;    ///< sums of their areas as seen along x, y, z
};

}  // namespace quasimc

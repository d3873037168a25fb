#pragma once

#include "solvers/from_organs/organ_points.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// A direction from a point of an organ, in which it looks for light that surfaces send to it.
struct GatherSample {
    Vec3 away;           ///< unit
    SurfaceSide side{};  ///< of the organ, on which the direction lies
    double cosine = 0;   ///< with the normal of that side
    double factor = 0;   ///< cosine over density; 0: outside the organ's field of view
};

/// Draws such directions: by the cosine law on either side, and where the ground sends much light
/// almost along itself, a part of them so.
///
/// Phong's lobes, folded at the surface, send a finite density of light along it, so that the
/// radiance grows as one over the cosine of the angle of exit. To what stands upright over an
/// endless ground each factor of the cosine brings as much light as the next one; of directions by
/// the cosine law hardly any look there, and those that do find so much that no error tells.
class GatherDirections {
  public:
    explicit GatherDirections(const PreparedScene& prepared);
    [[nodiscard]] GatherSample draw(const OrganPoint& point, double u0, double u1) const;

  private:
    [[nodiscard]] double mixed(double factor, double cosine, const Vec3& away) const;

    const PreparedScene& prepared_;
    double along_ground_ = 0;  // the part of the directions
};

}  // namespace quasimc

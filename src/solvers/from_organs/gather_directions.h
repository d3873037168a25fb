#pragma once

#include "solvers/from_organs/organ_points.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// A direction from a point of an organ, along which light of other surfaces is sampled.
struct GatherSample {
    Vec3 away;           ///< unit
    SurfaceSide side{};  ///< the organ's side that faces the direction; upper of a sphere
    double cosine = 0;   ///< with the normal of that side; 1 for a sphere
    double factor = 0;   ///< cosine over density; 0: outside the organ's field of view
};

/// Samples such directions: by the cosine law on either side, and a fraction of them almost along
/// the ground if the ground scatters much light there.
///
/// Phong's lobes, folded at the surface, scatter a finite density of light along it, so that the
/// radiance grows as one over the cosine of the exit angle. An upright organ above an infinite
/// ground then receives the same light from every decade of this cosine. The cosine law samples few
/// directions there, with contributions so large that the error is not estimated reliably.
class GatherDirections {
  public:
    explicit GatherDirections(const PreparedScene& prepared);
    [[nodiscard]] GatherSample draw(const OrganPoint& point, double u0, double u1) const;

  private:
    [[nodiscard]] double mixed(double factor, double cosine, const Vec3& away) const;

    const PreparedScene& prepared_;
    double along_ground_ = 0;  // fraction of the directions
};

}  // namespace quasimc

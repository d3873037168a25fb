#pragma once

#include <cstdint>
#include <stop_token>

#include "solvers/from_organs/light_vertices.h"
#include "solvers/from_organs/next_event.h"
#include "solvers/from_organs/organ_points.h"
#include "solvers/solver.h"

namespace quasimc {

/// The random numbers of a path: coordinates of point `index` from `dimension` on.
struct PathNumbers {
    const Stream& stream;
    std::uint64_t index;
    std::uint32_t dimension;
};

/// Paths that run backwards from points of organs, and the estimators of light at their vertices.
class BackwardPaths {
  public:
    /// @param narrow_from  peak_brightness() of lobes through which suns and lamps are not sampled
    BackwardPaths(
        const SolverInput& input,
        const NextEvent& next_event,
        const VertexLight& vertex_light,
        const LampNearField& near,
        double narrow_from);

    /// Sets path.gathered to the radiance at a point of an organ along -away, in units of
    /// NextEvent. Returns the rays cast.
    /// @param vertices  of the light subpath that belongs to the point
    /// @throws StopRequested  if a stop was requested
    std::uint64_t gather(
        PathNumbers numbers,
        const OrganPoint& point,
        Vec3 away,
        const LightVertices& vertices,
        GatherScratch& path) const;

  private:
    std::uint64_t add_vertices(
        const LightVertices& vertices,
        const Surface& surface,
        const Vec3& p,
        const Vec3& out,
        std::uint32_t depth,
        GatherScratch& path) const;

    const PreparedScene& prepared_;
    const Sampler& sampler_;
    const NextEvent& next_event_;
    const VertexLight& vertex_light_;
    const LampNearField& near_;
    std::stop_token stop_;
    std::uint32_t max_depth_;
    double roulette_threshold_, narrow_from_;
};

}  // namespace quasimc

#pragma once

#include <cstdint>
#include <vector>

#include "solvers/estimator.h"
#include "transport/sky_directions.h"

namespace quasimc {

/// Directions that stand for the disk of a sun.
inline constexpr std::uint32_t kDiskBeams = 8;

/// Part of the light from far away in one round: a beam that is cut into scan lines, or all skies.
struct VisibilityTask {
    bool is_sky = false;
    std::uint32_t light = 0;            ///< of a beam
    std::uint32_t beam = 0, beams = 1;  ///< of a sun's disk: which direction, and of how many
    std::uint32_t count = 0;            ///< lines, or directions
    double pixels = 0;                  ///< of each direction of the skies
    std::uint64_t first_block = 0, blocks = 0;
};

/// How much is looked at for how many paths. Direct light and scattered light each have their
/// error; these numbers make the figure of merit of both together the largest in our measurements
/// (docs/theory/lit-surfaces.md).
class SamplingBudget {
  public:
    SamplingBudget(const PreparedScene& prepared, const SkyDirections& skies);

    [[nodiscard]] std::vector<VisibilityTask> parts(const Round& round) const;

  private:
    void add_beams(std::uint32_t light, double paths, std::vector<VisibilityTask>& parts) const;
    void add_skies(double paths, std::vector<VisibilityTask>& parts) const;

    [[nodiscard]] double pixels_for(double paths) const;

    const PreparedScene& prepared_;
    const SkyDirections& skies_;
    double paths_per_line_, pixels_per_path_;
};

}  // namespace quasimc

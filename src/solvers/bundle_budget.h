#pragma once

#include <cstdint>
#include <vector>

#include "solvers/bundle_exchange.h"
#include "solvers/patch_light.h"

namespace quasimc {

/// Patches that a scene is cut into for so many paths of the first round.
[[nodiscard]] double patches_for(std::uint64_t paths);

/// Of a path's light, what goes along one stretch of a line, about: most bring less.
[[nodiscard]] double light_of_stretch();

/// How many directions and lines each step of the exchange gets. A path is worth some stretches of
/// lines, from a patch to the next; they are shared out by the light that is on its way, so that a
/// step that brings little costs little. See docs/theory/ray-bundles.md.
class BundleBudget {
  public:
    /// @param paths  of the round
    /// @param first  light that leaves surfaces at first, by column of PatchLight
    BundleBudget(const PatchScene& scene, std::uint64_t paths, std::vector<double> first);

    /// Of a step in which so much light leaves surfaces.
    [[nodiscard]] BundleGroup group(const std::vector<double>& leaving, std::uint64_t key) const;

  private:
    double patches_, area_, stretches_;
    std::vector<double> first_;
};

}  // namespace quasimc

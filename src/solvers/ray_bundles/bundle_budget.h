#pragma once

#include <cstdint>
#include <vector>

#include "solvers/ray_bundles/bundle_exchange.h"
#include "solvers/ray_bundles/patch_light.h"

namespace quasimc {

/// Patches that a scene is cut into for so many paths of all rounds together.
[[nodiscard]] double patches_for(std::uint64_t paths);

/// Of a path's light, what goes along one stretch of a line, about: most bring less.
[[nodiscard]] double light_of_segment();

/// How many directions and lines each step of the exchange gets. A path is worth some segments of
/// lines, from a patch to the next. Most go to the last step, in which all light is sent once more;
/// those of single orders share the rest by the light that is on its way, so that a step that
/// brings little costs little. See docs/develop/notebook/ray-bundles.md.
class BundleBudget {
  public:
    /// @param paths  of the round
    /// @param first  light that leaves surfaces at first, by column of PatchLight
    BundleBudget(const PatchScene& scene, std::uint64_t paths, std::vector<double> first);

    /// The bundles of a step for light of one order.
    /// @param leaving  the flux that leaves surfaces, [column]
    [[nodiscard]] BundleGroup of_order(const std::vector<double>& leaving, std::uint64_t key) const;
    /// The bundles of the step in which light of all orders goes together.
    /// @param of_orders  BundleGroup::segments of all single orders together
    [[nodiscard]] BundleGroup of_all(double of_orders, std::uint64_t key) const;

  private:
    struct Wanted {
        double segments = 0, fewest = 0, fewest_directions = 0;
        std::uint64_t key = 0;
    };
    [[nodiscard]] BundleGroup group(const Wanted& wanted) const;

    double patches_, area_;
    double passed_on_;          // by the brightest surface, twice; of nearly white ones 1
    double of_direction_;       // segments
    double of_first_, of_all_;  // segments of the first order, and of all orders together
    std::vector<double> first_;
};

}  // namespace quasimc

#pragma once

#include <cstdint>
#include <vector>

#include "solvers/ray_bundles/bundle_exchange.h"
#include "solvers/ray_bundles/patch_light.h"

namespace quasimc {

/// Number of patches of a scene for the paths of all rounds together.
[[nodiscard]] double patches_for(std::uint64_t paths);

/// Allocates directions and lines to the steps of the exchange. A path is worth some line segments
/// between patches. Most go to the last step, the final gather. Single orders share the others in
/// proportion to their light, so that weak orders cost little. See
/// docs/develop/notebook/ray-bundles.md.
class BundleBudget {
  public:
    /// @param paths  of the round
    /// @param first  flux of the first order that leaves surfaces, by column of PatchLight
    BundleBudget(const PatchScene& scene, std::uint64_t paths, std::vector<double> first);

    /// The bundles for light of one order.
    /// @param leaving  the flux that leaves surfaces, [column]
    [[nodiscard]] BundleGroup of_order(const std::vector<double>& leaving, std::uint64_t key) const;
    /// The bundles of the final gather.
    /// @param of_orders  BundleGroup::segments of all single orders together
    [[nodiscard]] BundleGroup of_all(double of_orders, std::uint64_t key) const;

  private:
    [[nodiscard]] BundleGroup group(double segments, std::uint64_t key) const;

    double patches_, area_;
    double
        passed_on_;  // fraction that the brightest surface scatters in two steps; 1 if nearly white
    double of_direction_;       // segments
    double of_first_, of_all_;  // segments of the first order, and of all orders together
    std::vector<double> first_;
};

}  // namespace quasimc

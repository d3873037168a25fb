#include "solvers/bundle_budget.h"

#include <algorithm>
#include <cmath>

namespace quasimc {
namespace {

/// What a path is worth: about the time that light tracing takes for one.
constexpr double kStretchesPerPath = 16;
/// A patch is met so often in all steps together; with less, fewer patches would do as well. Of
/// very many stretches patches get more: then there are more directions too, which are what is left
/// of the error.
constexpr double kStretchesPerPatch = 100, kManyStretches = 1 << 20;
/// ... and at least so often in each step. With less, single patches would pass on light that was
/// meant for many, the variance of which may grow from step to step.
constexpr double kFewestPerPatch = 3;
/// Beyond this number patches take memory and bring nothing.
constexpr double kMostPatches = 1 << 21;
/// A direction meets so many of all patches, until there are as many directions as there may be.
constexpr double kPatchesPerDirection = 0.4;
constexpr double kFewestInGroup = 8, kMostInGroup = 4096;
/// Of the mean albedo, what goes on to the next order: the rest escapes.
constexpr double kCaught = 0.75;

}  // namespace

double patches_for(std::uint64_t paths) {
    const double stretches = kStretchesPerPath * static_cast<double>(paths);
    const double few = std::min(stretches, kManyStretches);
    return std::min(std::sqrt(stretches * few) / kStretchesPerPatch, kMostPatches);
}

double light_of_stretch() {
    return 2 / kStretchesPerPath;
}

BundleBudget::BundleBudget(const PatchScene& scene, std::uint64_t paths, std::vector<double> first)
    : patches_(scene.patches.count()),
      area_(scene.area),
      stretches_(
          kStretchesPerPath * static_cast<double>(paths) * (1 - kCaught * scene.mean_albedo)),
      first_(std::move(first)) {}

BundleGroup BundleBudget::group(const std::vector<double>& leaving, std::uint64_t key) const {
    double part = 0;
    for (std::size_t c = 0; c < first_.size(); ++c) {
        part = std::max(part, first_[c] > 0 ? leaving[c] / first_[c] : 0);
    }
    const double stretches = std::max(part * stretches_, kFewestPerPatch * patches_);
    const double directions = std::clamp(
        2 * std::round(stretches / (kPatchesPerDirection * patches_) / 2), kFewestInGroup,
        kMostInGroup);
    // Along a direction surfaces look half as large, on average.
    return {static_cast<std::uint32_t>(directions), area_ / 2 * directions / stretches, key};
}

}  // namespace quasimc

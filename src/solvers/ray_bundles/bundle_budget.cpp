#include "solvers/ray_bundles/bundle_budget.h"

#include <algorithm>
#include <cmath>

#include "scene/scene.h"

namespace quasimc {
namespace {

/// What a path is worth: about the time that light tracing takes for one.
constexpr double kSegmentsPerPath = 16;
/// ... and, times the fourth power of the mean albedo, more where much is scattered again and
/// again: it is most of the error, which for dark surfaces is in direct light as well.
constexpr double kMoreOfBright = 0.85;
/// A patch is met so often in all steps together; with less, fewer patches would do as well. Of
/// very many segments patches get more: then there are more directions too, which are what is left
/// of the error.
constexpr double kSegmentsPerPatch = 100, kManySegments = 1 << 20;
/// ... but so many patches at least, or as many as are met so often: they cost next to nothing, and
/// light of lamps or of narrow gaps lies in spots that fewer don't tell apart, nor their errors.
constexpr double kFewPatches = 4096, kFewSegmentsPerPatch = 8;
/// ... and at least so often in each step. With less, single patches would pass on light that was
/// meant for many, the variance of which may grow from step to step.
constexpr double kMinPerPatch = 3;
/// ... but where no surface scatters this much, a step of weak light may meet them less often: what
/// one that is met too often sends on too much of dies out.
constexpr double kNearlyWhite = 0.9;
/// Beyond this number patches take memory and bring nothing.
constexpr double kMaxPatches = 1 << 21;
/// A direction meets so many of all patches; where that would be more, only as many as let it meet
/// each organ so often, or each triangle, on average: more directions bring more than more lines.
constexpr double kPatchesPerDirection = 0.2, kMeetingsOfOrgan = 4, kMeetingsOfTriangle = 1;
/// Starting with a direction takes as long as some segments.
constexpr double kMinOfDirection = 512;
constexpr double kMinInGroup = 8, kMinOfWeak = 4, kMaxInGroup = 4096;
/// Of all segments, times the albedo, those of single orders: their noise is seen through the last
/// step alone, where organs get light of very many patches, and less of it the darker they are.
constexpr double kForOrders = 0.3;
/// ... and the last step has as many segments as they have at least: of few paths and bright
/// surfaces there are many orders, each with its fewest, and what is left of the error is in the
/// last step. With twice as many, what patches get wrong beside stems shows beside so little noise.
constexpr double kLastOverOrders = 1;
/// Of the mean albedo, what goes on to the next order: the rest escapes.
constexpr double kCaught = 0.75;

/// By the brightest surface, twice; of nearly white ones 1.
double passed_on_twice(const Scene& scene) {
    const std::vector<double> albedos = largest_albedos(scene);
    const double once = *std::max_element(albedos.begin(), albedos.end()) / kNearlyWhite;
    return std::min(1.0, once * once);
}

}  // namespace

double patches_for(std::uint64_t paths) {
    const double segments = kSegmentsPerPath * static_cast<double>(paths);
    const double few = std::min(segments, kManySegments);
    const double at_least = std::min(segments / kFewSegmentsPerPatch, kFewPatches);
    return std::clamp(std::sqrt(segments * few) / kSegmentsPerPatch, at_least, kMaxPatches);
}

double light_of_segment() {
    return 2 / kSegmentsPerPath;
}

BundleBudget::BundleBudget(const PatchScene& scene, std::uint64_t paths, std::vector<double> first)
    : patches_(scene.patches.count()),
      area_(scene.area),
      passed_on_(passed_on_twice(scene.prepared.scene())),
      first_(std::move(first)) {
    const double more = 1 + kMoreOfBright * std::pow(scene.mean_albedo, 4);
    const double all = more * kSegmentsPerPath * static_cast<double>(paths);
    const double for_orders = kForOrders * scene.mean_albedo;
    of_first_ = for_orders * all * (1 - kCaught * scene.mean_albedo);
    of_all_ = (1 - for_orders) * all;
    const auto organs = static_cast<double>(scene.prepared.scene().organs().size());
    const auto triangles = static_cast<double>(scene.surfaces.size());
    of_direction_ = std::min(
        kPatchesPerDirection * patches_,
        std::max({kMeetingsOfOrgan * organs, kMeetingsOfTriangle * triangles, kMinOfDirection}));
}

BundleGroup BundleBudget::of_order(const std::vector<double>& leaving, std::uint64_t key) const {
    double part = 0;
    for (std::size_t c = 0; c < first_.size(); ++c) {
        part = std::max(part, first_[c] > 0 ? leaving[c] / first_[c] : 0);
    }
    const double strength = std::min(1.0, std::max(part, passed_on_));
    return group(
        {part * of_first_, strength * kMinPerPatch * patches_,
         std::max(kMinOfWeak, kMinInGroup * std::sqrt(strength)), key});
}

BundleGroup BundleBudget::of_all(double of_orders, std::uint64_t key) const {
    const double fewest = std::max(kMinPerPatch * patches_, kLastOverOrders * of_orders);
    return group({of_all_, fewest, kMinInGroup, key});
}

BundleGroup BundleBudget::group(const Wanted& wanted) const {
    const double segments = std::max(wanted.segments, wanted.fewest);
    const double directions =
        std::clamp(segments / of_direction_, wanted.fewest_directions, kMaxInGroup);
    const double even = 2 * std::round(directions / 2);
    // Along a direction surfaces look half as large, on average.
    return {static_cast<std::uint32_t>(even), area_ / 2 * even / segments, wanted.key, segments};
}

}  // namespace quasimc

#include "solvers/ray_bundles/bundle_budget.h"

#include <algorithm>
#include <cmath>

#include "scene/scene.h"

namespace quasimc {
namespace {

/// Line segments per path: they take about the time of a path in light tracing.
constexpr double kSegmentsPerPath = 16;
/// Additional fraction, times the fourth power of the mean albedo: multiple scattering dominates
/// the error of high-albedo surfaces.
constexpr double kMoreOfBright = 0.85;
/// Line segments per patch in all steps together; fewer would suffice for fewer patches. Beyond
/// kManySegments segments patches get more, and with them more directions, which dominate the
/// error.
constexpr double kSegmentsPerPatch = 25, kManySegments = 1 << 20;
/// Minimum number of patches, or as many as get this number of segments. They cost hardly any time,
/// and resolve spots of light of lamps or narrow gaps, and their errors.
constexpr double kFewPatches = 16384, kFewSegmentsPerPatch = 2;
/// Minimum segments per patch in each step: three for each group of four. With fewer, single groups
/// would pass on the light of many, and the variance might grow from step to step.
constexpr double kMinPerPatch = 0.75;
/// Below this albedo, steps of weak light may have fewer: their variance dies out.
constexpr double kNearlyWhite = 0.9;
/// Maximum number of patches: more take memory without improvement.
constexpr double kMaxPatches = 1 << 21;
/// Segments per direction: this fraction of the patches, but not more than these mean numbers for
/// each organ or triangle. More directions improve results more than more lines.
constexpr double kPatchesPerDirection = 0.2, kMeetingsOfOrgan = 4, kMeetingsOfTriangle = 1;
/// Minimum segments per direction: preparing a direction takes as long as some segments.
constexpr double kMinOfDirection = 512;
constexpr double kMinInGroup = 4, kMaxInGroup = 4096;
/// Fraction of all segments for single orders, times the albedo: their noise passes the final
/// gather, where organs receive light of very many patches, and less of it the lower their albedo.
constexpr double kForOrders = 0.3;
/// The final gather has at least this multiple of their segments. With few paths and bright
/// surfaces there are many orders, each with its minimum, and the final gather dominates the error.
constexpr double kLastOverOrders = 1.5;
/// Fraction of scattered light that reaches a surface, not the sky.
constexpr double kCaught = 0.75;

/// The fraction that the brightest surface scatters in two steps; 1 if nearly white.
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
    return group(std::max(part * of_first_, strength * kMinPerPatch * patches_), key);
}

BundleGroup BundleBudget::of_all(double of_orders, std::uint64_t key) const {
    return group(std::max({of_all_, kMinPerPatch * patches_, kLastOverOrders * of_orders}), key);
}

BundleGroup BundleBudget::group(double segments, std::uint64_t key) const {
    const double directions = std::clamp(segments / of_direction_, kMinInGroup, kMaxInGroup);
    const double even = 2 * std::round(directions / 2);
    // The mean projected area of surfaces is half of their area.
    return {static_cast<std::uint32_t>(even), area_ / 2 * even / segments, key, segments};
}

}  // namespace quasimc

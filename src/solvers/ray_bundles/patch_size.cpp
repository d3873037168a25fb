#include "solvers/ray_bundles/patch_size.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "raster/patches.h"
#include "transport/organ_shares.h"

namespace quasimc {
namespace {

/// Patches per typical organ that resolve its shadow (docs/develop/notebook/ray-bundles.md).
constexpr double kPatchesPerOrgan = 8;
/// Minimum number, of few paths or for organs of one triangle, which suffices for the shadows of
/// similar organs.
constexpr double kMinPerOrgan = 4;
/// Minimum number of patches per triangle.
constexpr double kPatchesPerTriangle = 4;
/// Largest factor on the minimum number of all triangles, to resolve shadows.
constexpr double kMaxTimes = 4;

/// Patches smaller than the mean by this factor are met less than once in two steps.
constexpr double kMuchSmaller = 6;
/// Tolerated fraction of organs with such patches, if they are flat: they exchange no light within
/// themselves.
constexpr double kMaxSmall = 0.05;
constexpr std::uint32_t kTrianglesOfFlat = 2;

/// The area of an organ's patches; it is `usual` for most.
double patch_of(const Organ& organ, double usual) {
    return std::min(organ.area / (kPatchesPerTriangle * organ.triangle_count), usual);
}

double count_patches(const Scene& scene, double usual) {
    double patches = 0;
    for (const Organ& organ : scene.organs()) {
        patches += organ.area > 0 ? organ.area / patch_of(organ, usual) : 0;
    }
    return patches;
}

/// @param mean  area of a patch
bool are_alike(const Scene& scene, double mean, double usual) {
    double small = 0;
    for (const Organ& organ : scene.organs()) {
        if (organ.area > 0 && kMuchSmaller * patch_of(organ, usual) < mean) {
            if (organ.triangle_count > kTrianglesOfFlat) {
                return false;
            }
            ++small;
        }
    }
    return small <= kMaxSmall * static_cast<double>(scene.organs().size());
}

}  // namespace

int patch_level(double area, double patch) {
    return static_cast<int>(
        std::clamp(std::round(std::log2(area / patch) / 2), 1.0, double{Patches::kFinest}));
}

PatchSize patch_size(const Scene& scene, double most) {
    double area = 0;
    double triangles = 0;
    for (const Organ& organ : scene.organs()) {
        area += organ.area;
        triangles += organ.triangle_count;
    }
    const double typical = median_measured_area(scene);
    if (!(area > 0 && typical > 0)) {
        return {area, 1 / std::max(1.0, most), std::max(1.0, most)};
    }
    const double per_organ =
        std::clamp(kPatchesPerOrgan * most * typical / area, kMinPerOrgan, kPatchesPerOrgan);
    const double for_shadows =
        std::max(typical / per_organ, area / (kMaxTimes * kPatchesPerTriangle * triangles));
    const double usual = std::min(area / std::max(1.0, most), for_shadows);
    const bool holds =
        std::all_of(scene.organs().begin(), scene.organs().end(), [&](const Organ& organ) {
            return !(organ.area > 0 && patch_of(organ, usual) > typical / kMinPerOrgan);
        });
    const double count = count_patches(scene, usual);
    return {area, usual / area, count, holds, are_alike(scene, area / count, usual)};
}

}  // namespace quasimc

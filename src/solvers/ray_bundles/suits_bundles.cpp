#include "solvers/ray_bundles/suits_bundles.h"

#include <algorithm>

#include "solvers/ray_bundles/bundle_budget.h"
#include "solvers/ray_bundles/bundle_memory.h"
#include "solvers/ray_bundles/long_patches.h"
#include "solvers/ray_bundles/patch_light.h"
#include "solvers/ray_bundles/patch_size.h"

namespace quasimc {
namespace {

/// Minimum number of paths per triangle: each patch is met a few times in every step, however few
/// paths there are.
constexpr double kMinPathsPerTriangle = 0.2;
/// Maximum number of paths per organ: with more, the errors of patches exceed those of first hits.
constexpr double kMaxPathsPerOrgan = 1000;
/// The maximum under a sun if this fraction of all surfaces is in closed stems with long patches,
/// whose error does not decrease with more paths.
constexpr double kManyStems = 0.15, kMaxPathsBesideStems = 4;
constexpr std::size_t kMinOrgans = 16;

bool is_diffuse(const Side& side) {
    return std::all_of(side.lobes().begin(), side.lobes().end(), [](const Lobe& lobe) {
        return lobe.shape->is_lambertian();
    });
}

}  // namespace

bool is_diffuse(const Material& material) {
    return material.is_transparent() || (is_diffuse(material.side(SurfaceSide::upper)) &&
                                         is_diffuse(material.side(SurfaceSide::lower)));
}

bool is_diffuse(const Scene& scene) {
    const std::vector<bool> is_used = used_materials(scene);
    for (std::size_t m = 0; m < is_used.size(); ++m) {
        if (is_used[m] && !is_diffuse(data_of(scene).materials[m])) {
            return false;
        }
    }
    return true;
}

bool suits_bundles(const Scene& scene, const RunSpec& spec, double gain, bool has_sun) {
    const auto organs = static_cast<double>(scene.organs().size());
    const auto triangles = static_cast<double>(scene.triangle_count());
    const auto paths = static_cast<double>(spec.paths);
    const auto has_good_patches = [&] {
        const PatchSize size = patch_size(scene, patches_for(spec.paths));
        if (!size.holds_shadows || !size.are_alike ||
            bytes_of_patch_light(size.count, scene.bands().size()) > kMaxBytesUnasked) {
            return false;
        }
        const LongPatches are_long = find_long_patches(scene, size);
        return are_long.organs.empty() && (!has_sun || are_long.closed_part < kManyStems ||
                                           paths <= kMaxPathsBesideStems * organs);
    };
    return scene.organs().size() >= kMinOrgans && paths <= kMaxPathsPerOrgan * organs &&
           paths >= kMinPathsPerTriangle * triangles * std::max(1.0, gain) && is_diffuse(scene) &&
           has_good_patches();
}

}  // namespace quasimc

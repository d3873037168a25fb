#include "solvers/ray_bundles/suits_bundles.h"

#include <algorithm>

#include "solvers/ray_bundles/bundle_budget.h"
#include "solvers/ray_bundles/bundle_memory.h"
#include "solvers/ray_bundles/long_patches.h"
#include "solvers/ray_bundles/patch_light.h"
#include "solvers/ray_bundles/patch_size.h"
#include "solvers/ray_bundles/solved_bands.h"

namespace quasimc {
namespace {

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

bool suits_bundles(const Scene& scene, const Sources& sources, const RunSpec& spec) {
    if (!is_diffuse(scene)) {
        return false;
    }
    const PatchSize size = patch_size(scene, patches_for(spec.paths));
    return size.holds_shadows && size.are_alike &&
           bytes_of_patch_light(size.count, count_solved_bands(scene, sources, spec.origins)) <=
               kMaxBytesUnasked &&
           find_long_patches(scene, size).organs.empty();
}

}  // namespace quasimc

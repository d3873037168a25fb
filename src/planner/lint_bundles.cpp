#include "planner/lint_bundles.h"

#include <utility>

#include "planner/near_lamp.h"
#include "scene/lint.h"
#include "solvers/ray_bundles/bundle_budget.h"
#include "solvers/ray_bundles/bundle_memory.h"
#include "solvers/ray_bundles/long_patches.h"
#include "solvers/ray_bundles/patch_size.h"

namespace quasimc {
namespace {

std::vector<Warning> lint_long(const Scene& scene, const PatchSize& size) {
    WarningKind found("organ has long thin triangles", "organs have long thin triangles");
    for (const Organ* organ : find_long_patches(scene, size).organs) {
        found.add(
            describe_organ(*organ),
            "has long thin triangles; ray_bundles can be wrong there by more than its errors say; "
            "subdivide them or use method = \"first_hits\"");
    }
    return std::move(found).finish();
}

std::vector<Warning> lint_large(const PatchSize& size) {
    std::vector<Warning> found;
    if (!size.holds_shadows) {
        found.push_back(
            {"scene",
             "surfaces have patches larger than the shadow of a typical organ; ray_bundles can be "
             "wrong there by more than its errors say; use more paths or method = \"first_hits\""});
    }
    if (!size.are_alike) {
        found.push_back(
            {"scene",
             "organs are much smaller than the patches of their neighbours; ray_bundles can be "
             "wrong there by more than its errors say; use more paths or method = \"first_hits\""});
    }
    return found;
}

std::vector<Warning> lint_lamps(const Scene& scene, const Sources& sources) {
    WarningKind found("lamp is close to surfaces", "lamps are close to surfaces");
    for (const auto& source : sources) {
        if (is_near_lamp(*source, scene.bounds())) {
            found.add(
                "source '" + source->name() + "'",
                "is a lamp close to surfaces; its light can fall in spots smaller than the patches "
                "of ray_bundles, which can be wrong there by more than its errors say; use method "
                "= \"light_tracing\"");
        }
    }
    return std::move(found).finish();
}

}  // namespace

std::vector<Warning> lint_bundles(const Scene& scene, const Sources& sources, const RunSpec& spec) {
    if (spec.method != Method::ray_bundles) {
        return {};
    }
    const PatchSize size = patch_size(scene, patches_for(spec.paths));
    std::vector<Warning> all = lint_long(scene, size);
    for (const auto& more :
         {lint_large(size), lint_lamps(scene, sources),
          lint_bundle_memory(scene, sources, spec, size)}) {
        all.insert(all.end(), more.begin(), more.end());
    }
    return all;
}

}  // namespace quasimc

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
    WarningKind found("organs are of long thin triangles");
    for (const Organ* organ : find_long_patches(scene, size).organs) {
        found.add(
            words_for(*organ),
            "is of long thin triangles: ray_bundles takes light as even along patches that are "
            "longer than it is wide, and its errors don't tell what is wrong with that; cut them "
            "into shorter ones, or use method = \"first_hits\"");
    }
    return std::move(found).finish();
}

std::vector<Warning> lint_large(const PatchSize& size) {
    std::vector<Warning> found;
    if (!size.holds_shadows) {
        found.push_back(
            {"scene",
             "surfaces are so large beside a typical organ that its shadow is lost in the patches "
             "that ray_bundles cuts them into, and its errors don't tell what is wrong with that; "
             "ask for more paths, or use method = \"first_hits\""});
    }
    if (!size.are_alike) {
        found.push_back(
            {"scene",
             "organs are far smaller than the patches that ray_bundles cuts others into: what they "
             "get from these next to them is lost, and its errors don't tell; ask for more paths, "
             "or use method = \"first_hits\""});
    }
    return found;
}

std::vector<Warning> lint_lamps(const Scene& scene, const Sources& sources) {
    WarningKind found("lamps are next to surfaces");
    for (const auto& source : sources) {
        if (is_near_lamp(*source, scene.bounds())) {
            found.add(
                "source '" + source->name() + "'",
                "is a lamp next to surfaces, where its light may lie in spots smaller than the "
                "patches of ray_bundles, whose errors don't tell what is wrong with that; use "
                "method = \"light_tracing\"");
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
         {lint_large(size), lint_lamps(scene, sources), lint_bundle_memory(scene, spec, size)}) {
        all.insert(all.end(), more.begin(), more.end());
    }
    return all;
}

}  // namespace quasimc

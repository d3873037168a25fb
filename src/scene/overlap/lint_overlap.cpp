// Warnings about coplanar overlaps (scene/overlap/covered.h).

#include <iterator>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/number_text.h"
#include "scene/lint.h"
#include "scene/overlap/covered.h"
#include "scene/overlap/overlap_search.h"
#include "scene/scene.h"

namespace quasimc {
namespace {

/// "12 triangles have the same corners as triangles of organ 'b' (id 2)"
std::string describe_pair(const Scene& scene, const Coincidence& pair) {
    const bool is_own = pair.first == pair.second;
    const std::string other =
        is_own ? "others of this organ"
               : "triangles of " + describe_organ(scene.organs()[pair.first.value]);
    const bool is_one = pair.triangles == 1;
    const char* relation = pair.is_same
                               ? (is_one ? "has the same corners as" : "have the same corners as")
                               : (is_one ? "overlaps coplanar" : "overlap coplanar");
    const char* light = pair.light == OverlapOwner::both
                            ? "the sensor is treated as just above the upper side"
                        : is_own ? "there, only one of them receives light"
                                 : "there, only that organ receives light";
    return fmt::format("{} {} {}; {}", counted(pair.triangles, "triangle"), relation, other, light);
}

}  // namespace

std::vector<Warning> lint_overlap(const Survey& survey) {
    const Scene& scene = survey.scene;
    const Coincidences& found = *data_of(scene).coincidences;
    if (found.is_skipped) {
        return {
            {"scene",
             fmt::format("has more than {} triangles; overlaps were not checked", kMaxToCompare)}};
    }
    WarningKind same(
        "pair of organs has triangles in common", "pairs of organs have triangles in common");
    WarningKind onto(
        "pair of organs has coplanar triangles that overlap",
        "pairs of organs have coplanar triangles that overlap");
    for (const Coincidence& pair : found.pairs) {
        (pair.is_same ? same : onto)
            .add(describe_organ(scene.organs()[pair.second.value]), describe_pair(scene, pair));
    }
    std::vector<Warning> warnings = std::move(same).finish();
    std::vector<Warning> more = std::move(onto).finish();
    std::move(more.begin(), more.end(), std::back_inserter(warnings));
    if (found.gave_up) {
        warnings.push_back(
            {"scene", "has too many triangles close together; not all were checked for overlaps"});
    }
    return warnings;
}

}  // namespace quasimc

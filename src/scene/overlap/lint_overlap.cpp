// What is said of triangles that lie on each other in one plane (scene/overlap/covered.h).

#include <iterator>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "scene/lint.h"
#include "scene/overlap/covered.h"
#include "scene/overlap/overlap_search.h"
#include "scene/scene.h"

namespace quasimc {
namespace {

/// "has 12 triangles with the same corners as triangles of organ 'b' (id 2)"
std::string words_for(const Scene& scene, const Coincidence& pair) {
    const bool is_own = pair.first == pair.second;
    const std::string other = is_own
                                  ? "others of the same organ"
                                  : "triangles of " + words_for(scene.organs()[pair.first.value]);
    const std::string number =
        pair.triangles == 1 ? "a triangle" : fmt::format("{} triangles", pair.triangles);
    const char* light = pair.light == OverlapOwner::both
                            ? "the sensor is taken to stand just above, on its upper side"
                        : is_own ? "light falls on one of them, where they lie on each other"
                                 : "where they lie on each other, light falls on that organ only";
    return fmt::format(
        "has {} {} {}: {}", number,
        pair.is_same ? "with the same corners as" : "in one plane with, and overlapping,", other,
        light);
}

}  // namespace

std::vector<Warning> lint_overlap(const Survey& survey) {
    const Scene& scene = survey.scene;
    const Coincidences& found = *data_of(scene).coincidences;
    if (found.is_skipped) {
        return {
            {"scene",
             fmt::format(
                 "has more than {} triangles: overlaps were not looked for", kMaxToCompare)}};
    }
    WarningKind same("pairs of organs have triangles in common");
    WarningKind onto("pairs of organs have triangles that overlap in one plane");
    for (const Coincidence& pair : found.pairs) {
        (pair.is_same ? same : onto)
            .add(words_for(scene.organs()[pair.second.value]), words_for(scene, pair));
    }
    std::vector<Warning> warnings = std::move(same).finish();
    std::vector<Warning> more = std::move(onto).finish();
    std::move(more.begin(), more.end(), std::back_inserter(warnings));
    if (found.gave_up) {
        warnings.push_back(
            {"scene", "has too many triangles close together: not all were compared for overlaps"});
    }
    return warnings;
}

}  // namespace quasimc

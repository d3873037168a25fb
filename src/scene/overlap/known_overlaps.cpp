#include "scene/overlap/known_overlaps.h"

#include <algorithm>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "scene/overlap/coplanar.h"

namespace quasimc {
namespace {

bool are_equal(
    const SceneGeometry& a,
    std::uint32_t i,
    const SceneGeometry& b,
    std::uint32_t k,
    std::uint32_t count) {
    for (std::uint32_t n = 0; n < count; ++n) {
        if (a[i + n] != b[k + n]) {
            return false;
        }
    }
    return true;
}

Bounds bounds_of_changed(
    const SceneGeometry& triangles, const std::vector<bool>& changed, double margin) {
    Bounds bounds;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        if (changed[i]) {
            bounds.include(bounds_of(triangles[i]));
        }
    }
    const Vec3 grown{margin, margin, margin};
    return {bounds.low - grown, bounds.high + grown};
}

/// search_overlaps_of() for scenes that may have instances: instances near changed triangles are
/// expanded.
OverlapSearchResult search_changed(
    const SceneGeometry& triangles, const std::vector<bool>& changed, const Bounds& scene) {
    if (triangles.instances().empty()) {
        return search_overlaps_of(triangles, changed, scene);
    }
    const double size = size_of(scene);
    const Bounds bounds = bounds_of_changed(triangles, changed, coplanar_tolerance(size, size));
    Mesh near;
    std::vector<std::uint32_t> numbers;
    std::vector<bool> is_changed;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const Triangle t = triangles[i];
        if (meet(bounds_of(t), bounds)) {
            near.push_back(t);
            numbers.push_back(i);
            is_changed.push_back(changed[i]);
        }
    }
    OverlapSearchResult found =
        search_overlaps_of(SceneGeometry(std::move(near)), is_changed, scene);
    for (Overlap& pair : found.overlaps.pairs) {
        pair.first = numbers[pair.first];
        pair.second = numbers[pair.second];
    }
    return found;
}

}  // namespace

std::vector<KnownOverlaps::Run> KnownOverlaps::runs_of(const std::vector<std::int64_t>& owners) {
    std::vector<Run> runs;
    for (std::uint32_t i = 0; i < owners.size(); ++i) {
        if (runs.empty() || runs.back().owner != owners[i]) {
            runs.push_back({owners[i], i, 0});
        }
        ++runs.back().count;
    }
    return runs;
}

KnownOverlaps::Matching KnownOverlaps::match(
    const SceneGeometry& triangles, const std::vector<Run>& runs) const {
    std::unordered_map<std::int64_t, const Run*> known;
    for (const Run& run : runs_) {
        known.emplace(run.owner, &run);
    }
    Matching matching{
        std::vector<std::uint32_t>(triangles_->size(), kGone),
        std::vector<bool>(triangles.size(), false), 0};
    for (const Run& run : runs) {
        const auto before = known.find(run.owner);
        const bool is_same =
            before != known.end() && before->second->count == run.count &&
            are_equal(triangles, run.first, *triangles_, before->second->first, run.count);
        for (std::uint32_t n = 0; n < run.count; ++n) {
            if (is_same) {
                matching.new_number[before->second->first + n] = run.first + n;
            } else {
                matching.changed[run.first + n] = true;
            }
        }
        matching.changed_count += is_same ? 0 : run.count;
        if (is_same) {
            known.erase(before);  // a repeated organ is matched once
        }
    }
    return matching;
}

/// Whether the last search compared all pairs, with the same tolerances.
bool KnownOverlaps::can_go_on(const Bounds& bounds) const {
    return triangles_ && !known_.overlaps.gave_up && size_of(bounds_) == size_of(bounds);
}

std::optional<OverlapSearchResult> KnownOverlaps::find_among_changed(
    const SceneGeometry& triangles, const Bounds& bounds, const std::vector<Run>& runs) {
    if (!can_go_on(bounds)) {
        return std::nullopt;
    }
    const Matching matching = match(triangles, runs);
    constexpr std::size_t kWorthwhile = 3;
    if (kWorthwhile * matching.changed_count > triangles.size()) {
        return std::nullopt;
    }
    OverlapSearchResult found;
    if (matching.changed_count > 0) {
        found = search_changed(triangles, matching.changed, bounds);
    }
    // At least the count of a complete search, as the first search counted the remaining pairs.
    // Pairs may be counted more often if a shifted scene puts them in other cubes.
    found.work += known_.work;
    found.most_same += known_.most_same;
    OverlapWork most = found.work;
    if (bounds_.low != bounds.low) {
        most += found.work;
    }
    if (found.overlaps.gave_up || most.is_too_much(triangles.size()) ||
        found.most_same >= kPileOfTriangles) {
        return std::nullopt;
    }
    std::vector<Overlap>& pairs = found.overlaps.pairs;
    for (const Overlap& pair : known_.overlaps.pairs) {
        const std::uint32_t a = matching.new_number[pair.first];
        const std::uint32_t b = matching.new_number[pair.second];
        if (a != kGone && b != kGone) {
            pairs.push_back({std::min(a, b), std::max(a, b), pair.is_same, pair.is_little});
        }
    }
    std::sort(pairs.begin(), pairs.end(), [](const Overlap& a, const Overlap& b) {
        return std::tie(a.first, a.second) < std::tie(b.first, b.second);
    });
    last_changed_ = matching.changed_count;
    return found;
}

Overlaps KnownOverlaps::find(
    std::shared_ptr<const SceneGeometry> triangles, const std::vector<std::int64_t>& owners) {
    last_changed_.reset();
    if (triangles->size() > kMaxToCompare) {
        triangles_.reset();
        return find_overlaps(*triangles);
    }
    const Bounds bounds = bounds_of(*triangles);
    std::vector<Run> runs = runs_of(owners);
    std::optional<OverlapSearchResult> found = find_among_changed(*triangles, bounds, runs);
    known_ = found ? std::move(*found) : search_overlaps(*triangles);
    triangles_ = std::move(triangles);
    runs_ = std::move(runs);
    bounds_ = bounds;
    return known_.overlaps;
}

}  // namespace quasimc

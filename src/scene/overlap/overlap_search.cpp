// Search for coplanar triangles that overlap: two of them share a cube on the home level of the
// larger (OverlapGrid). The triangles of a cube are sorted by a function of the normal that is
// equal for both sides, so that only nearly parallel triangles are compared.

#include "scene/overlap/overlap_search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "base/checks.h"
#include "scene/overlap/coplanar.h"
#include "scene/overlap/overlap_grid.h"

namespace quasimc {
namespace {

using Entries = std::span<const OverlapEntry>;

bool faces_before(const OverlapEntry& a, const OverlapEntry& b) {
    return a.facing != b.facing ? a.facing < b.facing : a.triangle < b.triangle;
}

class OverlapSearch {
  public:
    OverlapSearch(
        const SceneGeometry& triangles, const std::vector<bool>& changed, const Bounds& scene)
        : triangles_(triangles),
          changed_(changed),
          grid_(triangles, changed, scene),
          same_before_(triangles.size()) {}

    OverlapSearchResult run() {
        for (std::uint64_t pass = 0; pass < grid_.passes(); ++pass) {
            grid_.enter_all(pass);
            compare_all();
        }
        sort_found();
        const auto most = std::max_element(same_before_.begin(), same_before_.end());
        return {
            {std::move(found_), false, is_given_up()},
            work_,
            most == same_before_.end() ? 0U : *most};
    }

  private:
    /// A triangle and its extent.
    struct Placed {
        Placed(std::uint32_t i, const Triangle& t) : number(i), triangle(t), extent(t) {}
        std::uint32_t number;
        Triangle triangle;
        TriangleExtent extent;
    };

    void compare_all() {
        std::vector<OverlapEntry>& natives = grid_.natives();
        Entries visitors = grid_.visitors();
        for (auto first = natives.begin(); first != natives.end();) {
            const std::uint64_t cube = first->cube;
            const auto last = std::find_if_not(
                first, natives.end(), [&](const OverlapEntry& e) { return e.cube == cube; });
            const auto come = std::find_if(
                visitors.begin(), visitors.end(),
                [&](const OverlapEntry& e) { return e.cube >= cube; });
            const auto gone = std::find_if_not(
                come, visitors.end(), [&](const OverlapEntry& e) { return e.cube == cube; });
            std::sort(first, last, faces_before);
            compare_in_cube({first, last}, {come, gone});
            first = last;
            visitors = {gone, visitors.end()};
        }
    }

    void compare_in_cube(Entries natives, Entries visitors) {
        float most_blur = 0;
        for (const OverlapEntry& native : natives) {
            most_blur = std::max(most_blur, native.blur);
        }
        for (std::size_t i = 0; i < natives.size(); ++i) {
            compare(natives[i], natives.subspan(i + 1), most_blur);
        }
        for (const OverlapEntry& visitor : visitors) {
            const auto near = std::lower_bound(
                natives.begin(), natives.end(), visitor.facing - visitor.blur - most_blur,
                [](const OverlapEntry& e, float facing) { return e.facing < facing; });
            compare(visitor, {near, natives.end()}, most_blur);
        }
    }

    /// Compares `entry` with the natives of a cube, sorted by `facing`, in both directions: slivers
    /// share their home level with larger triangles, and lie on smaller ones.
    /// @param most_blur  largest `blur` of the natives
    void compare(const OverlapEntry& entry, Entries natives, float most_blur) {
        std::optional<Placed> placed;
        for (const OverlapEntry& other : natives) {
            if (other.facing > entry.facing + entry.blur + most_blur) {
                return;
            }
            if (!entry.is_parallel_to(other) || other.triangle == entry.triangle) {
                continue;  // rejects most triangles before they are fetched
            }
            if (is_piled(entry)) {
                return;
            }
            if (is_piled(other) || !is_asked_for(entry, other)) {
                continue;
            }
            const bool is_in_plane = entry.is_in_plane_of(other);
            ++(is_in_plane ? work_.comparisons : work_.candidates);
            if (is_given_up()) {
                return;
            }
            if (!is_in_plane) {
                continue;
            }
            if (!placed) {
                placed.emplace(entry.triangle, triangles_[entry.triangle]);
            }
            compare(*placed, {other.triangle, triangles_[other.triangle]});
        }
    }

    void compare(const Placed& a, const Placed& b) {
        if (!meet(grown(a.extent), grown(b.extent))) {
            return;
        }
        const bool is_a_smaller = is_smaller(a.triangle, b.triangle);
        if (is_a_smaller) {
            look_on_larger(a, b);
        }
        if (!is_a_smaller || is_smaller(b.triangle, a.triangle)) {
            look_on_larger(b, a);
        }
    }

    void look_on_larger(const Placed& small, const Placed& large) {
        const double tolerance = grid_.thickness(small.extent.size);
        constexpr double kLeast = 1e-6, kMuch = 1e-3;
        if (!may_lie_on(small.triangle, small.extent.bounds, large.triangle, tolerance)) {
            return;
        }
        const double part = covered_part(small.triangle, large.triangle);
        if (!(part > kLeast)) {
            return;
        }
        const Overlap found{
            std::min(small.number, large.number), std::max(small.number, large.number),
            is_same(small.triangle, large.triangle, tolerance), part <= kMuch};
        if (found.is_same) {
            ++same_before_[found.second];
        }
        found_.push_back(found);
    }

    /// The bounds, enlarged by the tolerance.
    [[nodiscard]] Bounds grown(const TriangleExtent& extent) const {
        const double blur = grid_.thickness(extent.size);
        const Vec3 margin{blur, blur, blur};
        return {extent.bounds.low - margin, extent.bounds.high + margin};
    }

    /// Whether a triangle equals kPileOfTriangles earlier ones, so that further comparisons are
    /// unnecessary.
    [[nodiscard]] bool is_piled(const OverlapEntry& entry) const {
        return same_before_[entry.triangle] >= kPileOfTriangles;
    }

    [[nodiscard]] bool is_given_up() const { return work_.is_too_much(triangles_.size()); }

    [[nodiscard]] bool is_asked_for(const OverlapEntry& a, const OverlapEntry& b) const {
        return changed_.empty() || changed_[a.triangle] || changed_[b.triangle];
    }

    /// Whether `a` is the smaller of two triangles of one home level.
    static bool is_smaller(const Triangle& a, const Triangle& b) {
        constexpr double kRounding = 1e-6;
        return area(a) <= (1 + kRounding) * area(b);
    }

    /// Merges the overlaps of pairs that share several cubes: they are the same triangle if one
    /// cube says so, and more than a little is covered if it is for either.
    void sort_found() {
        const auto key = [](const Overlap& o) { return std::tie(o.first, o.second); };
        std::sort(found_.begin(), found_.end(), [&](const Overlap& a, const Overlap& b) {
            const auto worth = [](const Overlap& o) { return std::pair(!o.is_same, o.is_little); };
            return key(a) != key(b) ? key(a) < key(b) : worth(a) < worth(b);
        });
        const auto end = std::unique(
            found_.begin(), found_.end(),
            [&](const Overlap& a, const Overlap& b) { return key(a) == key(b); });
        found_.erase(end, found_.end());
    }

    /// Whether part of `small` may lie on `large`. The quick tests come first.
    static bool may_lie_on(
        const Triangle& small, Bounds bounds, const Triangle& large, double tolerance) {
        const Vec3 blur{tolerance, tolerance, tolerance};
        bounds.low -= blur;
        bounds.high += blur;
        return meet(bounds, bounds_of(large)) && lies_in_plane(small, large, tolerance) &&
               !lie_apart(small, large, tolerance);
    }

    const SceneGeometry& triangles_;
    const std::vector<bool>& changed_;
    OverlapGrid grid_;
    std::vector<std::uint8_t> same_before_;
    std::vector<Overlap> found_;
    OverlapWork work_;
};

}  // namespace

double coplanar_tolerance(double triangle_size, double scene_size) {
    constexpr double kOfTriangle = 1e-6;
    constexpr double kSinglePrecision = 0x1p-22;  // rounding of a ray's origin: kNear
    return kOfTriangle * triangle_size + kSinglePrecision * scene_size;
}

Overlaps find_overlaps(const SceneGeometry& triangles) {
    if (triangles.size() > kMaxToCompare) {
        return {.pairs = {}, .is_skipped = true};
    }
    return search_overlaps(triangles).overlaps;
}

OverlapWork& OverlapWork::operator+=(const OverlapWork& other) {
    comparisons += other.comparisons;
    candidates += other.candidates;
    return *this;
}

bool OverlapWork::is_too_much(std::size_t triangles) const {
    return comparisons + candidates / 8 > 1'000'000 + 200 * triangles;
}

OverlapSearchResult search_overlaps(const SceneGeometry& triangles) {
    EXPECT(triangles.size() <= kMaxToCompare);
    const std::vector<bool> all;
    return OverlapSearch(triangles, all, bounds_of(triangles)).run();
}

OverlapSearchResult search_overlaps_of(
    const SceneGeometry& triangles, const std::vector<bool>& changed, const Bounds& scene) {
    EXPECT(triangles.size() <= kMaxToCompare && changed.size() == triangles.size());
    return OverlapSearch(triangles, changed, scene).run();
}

}  // namespace quasimc

#include "scene/overlap/overlap_search.h"

#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "base/vec3.h"
#include "scene/overlap/coplanar.h"
#include "scene/overlap/overlap_grid.h"

namespace quasimc::test {
namespace {

using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

/// Pairs of triangles in one plane, in planes that face anywhere; a third of them along the
/// direction by which the search orients planes, so that either side of them may count as the
/// upper one.
class FlatPairs {
  public:
    explicit FlatPairs(std::uint64_t seed) : draw_(seed) {}

    std::vector<Triangle> make(std::size_t pairs) {
        std::vector<Triangle> triangles;
        for (std::size_t i = 0; i < pairs; ++i) {
            const Vec3 normal = i % 3 == 0 ? normalized(cross(kGenericDirection, any())) : any();
            const Vec3 s = normalized(cross(normal, any()));
            const Vec3 t = cross(normal, s);
            const Vec3 corner{unit_(draw_), unit_(draw_), unit_(draw_)};
            const double size = std::exp(-5 * unit_(draw_));
            triangles.push_back(corners(corner, size * s, size * t));
            const double part = .05 + .9 * unit_(draw_);
            const Vec3 shift = .3 * size * (unit_(draw_) * s + unit_(draw_) * t);
            triangles.push_back(corners(corner + shift, -part * size * t, part * size * s));
        }
        return triangles;
    }

  private:
    static Triangle corners(const Vec3& a, const Vec3& s, const Vec3& t) {
        return {a, a + s, a + .5 * s + t};
    }
    Vec3 any() { return normalized(Vec3{normal_(draw_), normal_(draw_), normal_(draw_)}); }

    std::mt19937_64 draw_;
    std::uniform_real_distribution<double> unit_;
    std::normal_distribution<double> normal_;
};

/// Each with each, without a grid.
Pairs compare_all(const std::vector<Triangle>& triangles, double scene_size) {
    Pairs pairs;
    const auto lies_on = [&](const Triangle& small, const Triangle& large) {
        const double tolerance = coplanar_tolerance(size_of(bounds_of(small)), scene_size);
        return area(small) <= area(large) && lies_in_plane(small, large, tolerance) &&
               !lie_apart(small, large, tolerance) && covered_part(small, large) > 1e-6;
    };
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        for (std::uint32_t j = i + 1; j < triangles.size(); ++j) {
            if (lies_on(triangles[i], triangles[j]) || lies_on(triangles[j], triangles[i])) {
                pairs.emplace(i, j);
            }
        }
    }
    return pairs;
}

TEST(OverlapSearch, FindsWhatComparingEachWithEachFindsInPlanesThatFaceAnywhere) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const std::vector<Triangle> triangles = FlatPairs(seed).make(300);
        const SceneGeometry geometry{Mesh(triangles)};
        const Pairs expected = compare_all(triangles, size_of(bounds_of(geometry)));
        ASSERT_GT(expected.size(), 200U);
        Pairs found;
        for (const Overlap& overlap : find_overlaps(geometry).pairs) {
            found.emplace(overlap.first, overlap.second);
        }
        EXPECT_EQ(found, expected) << "seed " << seed;
    }
}

TEST(OverlapSearch, ComparesNoTrianglesInParallelPlanes) {
    std::vector<Triangle> triangles;
    for (int i = 0; i < 1000; ++i) {
        const double z = 1e-3 * i;
        triangles.push_back({Vec3{0, 0, z}, {1, 0, z}, {0, 1, z}});
    }
    const OverlapSearchResult result = search_overlaps(SceneGeometry{Mesh(triangles)});
    EXPECT_EQ(result.work.comparisons, 0U);
    EXPECT_FALSE(result.overlaps.gave_up);
}

}  // namespace
}  // namespace quasimc::test

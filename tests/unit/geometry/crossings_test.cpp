#include "geometry/mesh/crossings.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "geometry_testing.h"
#include "support/random_leaves.h"

namespace quasimc {
namespace {

std::vector<SurfaceCrossing> crossings_of(const std::vector<Triangle>& triangles) {
    return find_crossings(make_local_mesh(triangles)).found;
}

/// Whether a side from a to b passes through a triangle, by signs of volumes.
bool passes_through(const Vec3& a, const Vec3& b, const Triangle& t) {
    const auto volume = [](const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
        return dot(cross(q - p, r - p), s - p);
    };
    const bool lies_across = volume(t[0], t[1], t[2], a) * volume(t[0], t[1], t[2], b) < 0;
    const double first = volume(a, b, t[0], t[1]);
    return lies_across && first * volume(a, b, t[1], t[2]) > 0 &&
           first * volume(a, b, t[2], t[0]) > 0;
}

bool cross_each_other(const Triangle& a, const Triangle& b) {
    bool found = false;
    for (std::size_t i = 0; i < 3; ++i) {
        found = found || passes_through(a[i], a[(i + 1) % 3], b) ||
                passes_through(b[i], b[(i + 1) % 3], a);
    }
    return found;
}

/// Of leaves in all directions each one that passes through another one, and where: on both.
TEST(SurfaceCrossings, AreThoseOfAllPairs) {
    const std::vector<Triangle> leaves = test::random_leaves(150, .3, 1, 2);
    const LocalMesh mesh = make_local_mesh(leaves);
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            pairs += cross_each_other(leaves[i], leaves[j]) ? 1 : 0;
        }
    }
    const std::vector<SurfaceCrossing> found = find_crossings(mesh).found;
    EXPECT_GT(pairs, 100U);
    EXPECT_EQ(found.size(), 2 * pairs);
    const auto before = [](const SurfaceCrossing& a, const SurfaceCrossing& b) {
        return a.triangle < b.triangle;
    };
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end(), before));
    for (const SurfaceCrossing& one : found) {
        const auto ends = [&](const SurfaceCrossing& c) {
            return std::pair{
                mesh.point(c.triangle, c.from.s, c.from.t), mesh.point(c.triangle, c.to.s, c.to.t)};
        };
        const auto [a, b] = ends(one);
        EXPECT_EQ(
            std::count_if(
                found.begin(), found.end(),
                [&, a = a, b = b](const SurfaceCrossing& other) {
                    const auto [c, d] = ends(other);
                    return std::min(length(c - a) + length(d - b), length(d - a) + length(c - b)) <
                           1e-9;
                }),
            2);
    }
}

TEST(SurfaceCrossings, EndWhereTheOtherTriangleEnds) {
    const auto found = crossings_of({test::kLeaf, {Vec3{.25, .2, -1}, {.25, .2, 1}, {.25, -5, 0}}});
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].triangle, 0U);
    EXPECT_NEAR(found[0].from.s, .25, 1e-6);
    EXPECT_NEAR(found[0].to.s, .25, 1e-6);
    EXPECT_NEAR(std::min(found[0].from.t, found[0].to.t), 0, 1e-6);
    EXPECT_NEAR(std::max(found[0].from.t, found[0].to.t), .2, 1e-6);
}

/// A wall on a floor divides the floor's light, not its own.
TEST(SurfaceCrossings, AreWhereOneTriangleEndsOnAnother) {
    const auto found = crossings_of({test::kLeaf, {Vec3{.2, .1, 0}, {.2, .6, 0}, {.2, .3, 1}}});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].triangle, 0U);
    EXPECT_NEAR(std::abs(found[0].from.t - found[0].to.t), .5, 1e-6);
}

TEST(SurfaceCrossings, AreNotWhereNeighboursMeet) {
    const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, d{.7, .8, .4}, e{-.6, -.3, .5};
    // By a side, by a corner, by part of a side, and one on the other.
    EXPECT_TRUE(crossings_of({Triangle{a, b, c}, Triangle{b, d, c}}).empty());
    EXPECT_TRUE(crossings_of({Triangle{a, b, c}, Triangle{a, e, Vec3{-.5, .2, -.7}}}).empty());
    EXPECT_TRUE(crossings_of({Triangle{a, b, c},
                              Triangle{Vec3{.2, 0, 0}, Vec3{.7, 0, 0}, Vec3{.4, -.5, .5}}})
                    .empty());
    EXPECT_TRUE(crossings_of({Triangle{a, b, c},
                              Triangle{Vec3{.1, .1, 0}, Vec3{.8, .1, 0}, Vec3{.1, .8, 0}}})
                    .empty());
    // Above one another, and beside one another.
    EXPECT_TRUE(
        crossings_of({Triangle{a, b, c}, Triangle{Vec3{0, 0, .1}, Vec3{1, 0, .1}, Vec3{0, 1, .1}}})
            .empty());
    EXPECT_TRUE(crossings_of(
                    {Triangle{a, b, c}, Triangle{Vec3{.8, .8, -1}, Vec3{.8, .8, 1}, Vec3{1, 1, 0}}})
                    .empty());
}

TEST(SurfaceCrossings, AreNotLookedForWhereAllBoxesOverlap) {
    std::vector<Triangle> heap(6000, Triangle{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 1}});
    EXPECT_GT(heap.size() * heap.size(), most_compared_for_crossings(heap.size()));
    EXPECT_TRUE(find_crossings(make_local_mesh(heap)).gave_up);
    heap.resize(100);
    EXPECT_FALSE(find_crossings(make_local_mesh(heap)).gave_up);
}

/// Each crosses all others: what they would be cut into takes seconds for each hundred.
TEST(SurfaceCrossings, AreNotTakenOfManyTrianglesThroughOnePoint) {
    const auto heap = [](std::uint32_t triangles) {
        std::vector<Triangle> all = test::random_leaves(triangles, 1, 1, 5);
        for (Triangle& t : all) {
            const Vec3 center = (t[0] + t[1] + t[2]) / 3;
            t = {t[0] - center, t[1] - center, t[2] - center};
        }
        return find_crossings(make_local_mesh(all));
    };
    const SurfaceCrossings few = heap(50);
    EXPECT_FALSE(few.gave_up);
    EXPECT_GT(few.found.size(), 50U * 49U / 4U);
    EXPECT_LE(few.found.size(), most_crossings(50));
    const SurfaceCrossings many = heap(3000);
    EXPECT_TRUE(many.gave_up);
    EXPECT_TRUE(many.found.empty());
}

}  // namespace
}  // namespace quasimc

#include "raster/cut_triangle.h"

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "geometry_testing.h"
#include "raster/patches.h"

namespace quasimc {
namespace {

/// A point on a triangle, uniform.
Point2 random_point(test::Random& random) {
    const double u = random.uniform();
    const double v = random.uniform();
    return u + v > 1 ? Point2{1 - u, 1 - v} : Point2{u, v};
}

std::uint32_t patch_at(const CutTriangle& cut, int level, const Point2& p) {
    return cut.patch(TriangleParts(level).at(p.s, p.t), p.s, p.t);
}

/// The sides of a closed stem that a triangle passes through.
std::vector<SurfaceCrossing> octagon(double s, double t, double radius) {
    const auto corner = [&](int i) {
        const double angle = std::numbers::pi * (i + .3) / 4;
        return Point2{s + radius * std::cos(angle), t + radius * std::sin(angle)};
    };
    std::vector<SurfaceCrossing> sides;
    for (int i = 0; i < 8; ++i) {
        sides.push_back({0, 1, corner(i), corner(i + 1)});
    }
    return sides;
}

bool is_inside(const std::vector<SurfaceCrossing>& sides, const Point2& p) {
    for (const SurfaceCrossing& side : sides) {
        if (turn(side.from, side.to, p) < 0) {
            return false;
        }
    }
    return true;
}

/// Patches share the triangle: points fall into each in proportion to its area.
void expect_areas(const CutTriangle& cut, int level) {
    test::Random random(1);
    constexpr int kPoints = 200000;
    std::vector<double> counts(cut.patches());
    for (int i = 0; i < kPoints; ++i) {
        counts.at(patch_at(cut, level, random_point(random))) += 1;
    }
    double sum = 0;
    for (std::uint32_t patch = 0; patch < cut.patches(); ++patch) {
        const double expected = cut.area(patch) * kPoints;
        EXPECT_NEAR(counts[patch], expected, 5 * std::sqrt(expected) + 1e-9) << patch;
        sum += cut.area(patch);
    }
    EXPECT_NEAR(sum, 1, 1e-12);
}

TEST(CutTriangle, HasNoPatchOnBothSidesOfWhatCrossesIt) {
    constexpr int kLevel = 2;
    const SurfaceCrossing crossing{0, 1, {0, .37}, {.71, 0}};
    const std::vector<SurfaceCrossing> crossings{crossing};
    const CutTriangle cut(kLevel, crossings);
    expect_areas(cut, kLevel);
    test::Random random(2);
    std::map<std::uint32_t, std::set<bool>> sides;
    for (int i = 0; i < 20000; ++i) {
        const Point2 p = random_point(random);
        const double beside = turn(crossing.from, crossing.to, p);
        if (std::abs(beside) < 2e-3) {
            continue;  // less is not cut off
        }
        sides[patch_at(cut, kLevel, p)].insert(beside > 0);
    }
    for (const auto& [patch, found] : sides) {
        EXPECT_EQ(found.size(), 1U) << patch;
    }
}

/// However many sides a stem has, inside and outside are one patch each, unless they are large.
TEST(CutTriangle, KeepsTogetherWhatNoSurfaceParts) {
    for (const int level : {1, 2, 4}) {
        const std::vector<SurfaceCrossing> stem = octagon(.3, .28, .04);
        const CutTriangle cut(level, stem);
        expect_areas(cut, level);
        EXPECT_LT(cut.patches(), (1U << (2U * static_cast<unsigned>(level))) + 8U);
        test::Random random(3);
        std::map<std::uint32_t, std::set<bool>> sides;
        double inside = 0;
        for (int i = 0; i < 100000; ++i) {
            const Point2 p = random_point(random);
            // Not on the border itself, where rounding and what is not cut off lie.
            const double at = std::hypot(p.s - .3, p.t - .28) / .04;
            if (at < .9 || at > 1.03) {
                sides[patch_at(cut, level, p)].insert(is_inside(stem, p));
                inside += is_inside(stem, p) ? 1 : 0;
            }
        }
        EXPECT_GT(inside, 100);
        for (const auto& [patch, found] : sides) {
            EXPECT_EQ(found.size(), 1U) << level << " " << patch;
        }
    }
}

/// What is cut off a part goes to a neighbour in the patch of the level above if it is small.
TEST(CutTriangle, JoinsWhatIsSmallToANeighbourOnItsSide) {
    constexpr int kLevel = 3;
    const std::vector<SurfaceCrossing> crossings{{0, 1, {0, .135}, {.865, .135}}};
    const CutTriangle cut(kLevel, crossings);
    expect_areas(cut, kLevel);
    std::size_t small = 0;
    for (std::uint32_t patch = 0; patch < cut.patches(); ++patch) {
        small += cut.area(patch) > 0 && cut.area(patch) < .25 / 64 ? 1 : 0;
    }
    // Strips .01 high stand on parts of the height .125: they are no patches of their own.
    EXPECT_EQ(small, 0U);
    EXPECT_EQ(
        cut.patch(TriangleParts(kLevel).at(.05, .13), .05, .13),
        TriangleParts(kLevel).at(.05, .12));
}

TEST(CutTriangle, CutsALineWhereItPassesFromPatchToPatch) {
    constexpr int kLevel = 2;
    std::vector<SurfaceCrossing> crossings = octagon(.4, .25, .15);
    crossings.push_back({0, 1, {.1, .8}, {.5, 0}});
    const Patches patches({kLevel}, crossings);
    test::Random random(4);
    constexpr int kPoints = 20000;
    std::vector<TriangleParts::Segment> scratch;
    for (int i = 0; i < 20; ++i) {
        const auto point = [&] {
            const Point2 p = random_point(random);
            return Barycentric{static_cast<float>(p.s), static_cast<float>(p.t)};
        };
        const Barycentric a = point();
        const Barycentric b = point();
        std::vector<double> shares(patches.count());
        double sum = 0;
        patches.cut(0, a, b, scratch, [&](std::uint32_t patch, double share) {
            shares.at(patch) += share;
            sum += share;
        });
        EXPECT_NEAR(sum, 1, 1e-12);
        for (int k = 0; k < kPoints; ++k) {
            const double f = (k + .5) / kPoints;
            shares[patches.at(0, a.u + f * (b.u - a.u), a.v + f * (b.v - a.v))] -= 1. / kPoints;
        }
        for (const double share : shares) {
            EXPECT_NEAR(share, 0, 4. / kPoints);
        }
    }
}

TEST(Patches, OfATriangleThatIsCutFollowThoseBeforeIt) {
    const std::vector<SurfaceCrossing> crossings{{1, 0, {.25, 0}, {.25, .75}}};
    const Patches patches({1, 1, Patches::kNone, 1}, crossings);
    EXPECT_EQ(patches.cut_triangles(), 1U);
    EXPECT_EQ(patches.cut_of(0), nullptr);
    ASSERT_NE(patches.cut_of(1), nullptr);
    EXPECT_EQ(patches.first(1), 4U);
    EXPECT_EQ(patches.first(3), 4U + patches.cut_of(1)->patches());
    EXPECT_GT(patches.cut_of(1)->patches(), 4U);
    EXPECT_DOUBLE_EQ(patches.share(0, 2), .25);
    EXPECT_EQ(patches.at(3, .1, .1), patches.first(3));
}

}  // namespace
}  // namespace quasimc

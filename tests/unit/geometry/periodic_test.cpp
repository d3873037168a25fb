// Rays through periodic scenes, against many explicit copies of the cell in double precision.

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "geometry/cast/ray_caster.h"
#include "geometry/shapes/shapes.h"
#include "geometry_testing.h"

namespace quasimc {

namespace {

using test::FirstHit;
using test::Random;

constexpr double kHeight = 0.3;

/// Triangles of every awkward kind: inside, over borders, far outside, larger than the cell.
std::vector<Triangle> awkward_scene(Random& random) {
    std::vector<Triangle> triangles;
    const auto add = [&](std::size_t count, double size, double from, double to) {
        for (Triangle t : test::random_soup(count, size, random)) {
            const Vec3 center{random.between(from, to), random.between(from, to), 0};
            for (Vec3& corner : t) {
                corner = {corner.x + center.x, corner.y + center.y, kHeight * corner.z};
            }
            triangles.push_back(t);
        }
    };
    add(8, 0.15, -0.5, 0.5);
    add(2, 0.1, -7, 7);
    add(1, 1.5, -1, 1);
    return triangles;
}

struct Kind {
    std::string name;
    Cell cell;
};

class PeriodicScene : public ::testing::TestWithParam<Kind> {
  protected:
    [[nodiscard]] static const Cell& cell() { return GetParam().cell; }
};

INSTANTIATE_TEST_SUITE_P(
    Cells,
    PeriodicScene,
    ::testing::Values(
        Kind{"AlongX", {true, false, 0.1, 0, 1.1, 1}},
        Kind{"AlongY", {false, true, 0, -0.2, 1, 0.9}},
        Kind{"AlongBoth", {true, true, 0.1, -0.2, 1.1, 0.9}}),
    [](const auto& tested) { return tested.param.name; });

/// Down or up through the layer, at most seven cells far.
Vec3 slanting_direction(Random& random) {
    const Vec3 d = random.direction();
    const double steep = random.between(0.07, 1);
    return normalized({d.x, d.y, d.z > 0 ? steep : -steep});
}

TEST_P(PeriodicScene, RaysMeetWhatTheyMeetAmongCopies) {
    Random random(61);
    int hits = 0, close_calls = 0, differences = 0;
    constexpr int kScenes = 4, kRays = 250, kReach = 20;
    for (int s = 0; s < kScenes; ++s) {
        const auto triangles = awkward_scene(random);
        const RayCaster caster(triangles, cell(), Accelerator::embree);
        for (int i = 0; i < kRays; ++i) {
            const Vec3 d = slanting_direction(random);
            const Vec3 origin{
                random.between(-1, 2), random.between(-1, 2),
                d.z < 0 ? 0.7 : random.between(-0.7, 0.3)};
            const FirstHit expected =
                test::first_hit_among_copies(triangles, cell(), kReach, origin, d, 1e-6);
            const CastHit hit = caster.cast(caster.mesh().to_local(origin), d, kNoTriangle);
            hits += expected.found ? 1 : 0;
            if (expected.is_close_call) {
                ++close_calls;
                continue;
            }
            const bool same = (hit.end == RayEnd::hit) == expected.found &&
                              (!expected.found ||
                               (caster.source(hit.hit.triangle) == expected.triangle &&
                                std::abs(hit.hit.t / caster.mesh().scale - expected.t) < 1e-4));
            differences += same ? 0 : 1;
        }
    }
    EXPECT_EQ(differences, 0);
    EXPECT_GT(hits, kScenes * kRays / 10);
    EXPECT_LT(close_calls, kScenes * kRays / 50);
}

TEST_P(PeriodicScene, ComparisonWithCopiesNoticesAWrongPeriod) {
    Random random(62);
    const auto triangles = awkward_scene(random);
    const RayCaster caster(triangles, cell(), Accelerator::embree);
    Cell wrong = cell();
    wrong.size_x *= 1.01;
    wrong.size_y *= 1.01;
    int differences = 0;
    for (int i = 0; i < 300; ++i) {
        const Vec3 d = slanting_direction(random);
        const Vec3 origin{0.5, 0.5, d.z < 0 ? 0.7 : -0.7};
        const FirstHit expected =
            test::first_hit_among_copies(triangles, wrong, 10, origin, d, 1e-6);
        const CastHit hit = caster.cast(caster.mesh().to_local(origin), d, kNoTriangle);
        differences += expected.found && !expected.is_close_call &&
                               std::abs(hit.hit.t / caster.mesh().scale - expected.t) > 1e-4
                           ? 1
                           : 0;
    }
    EXPECT_GT(differences, 10);
}

TEST_P(PeriodicScene, EnginesAgreeOnRaysThatLeaveTriangles) {
    Random random(63);
    const auto triangles = awkward_scene(random);
    const RayCaster embree(triangles, cell(), Accelerator::embree);
    const RayCaster oracle(triangles, cell(), Accelerator::brute_force);
    int hits = 0, differences = 0;
    constexpr int kRays = 5000;
    for (int i = 0; i < kRays; ++i) {
        const std::uint32_t self = random.below(embree.mesh().triangle_count());
        const Vec3 origin = test::random_point_on(embree.mesh(), self, random);
        const Vec3 d = normalized(random.direction());
        const CastHit a = embree.cast(origin, d, self), b = oracle.cast(origin, d, self);
        hits += a.end == RayEnd::hit ? 1 : 0;
        // At a border both images of one triangle are right.
        const bool same =
            a.end == b.end && (a.end != RayEnd::hit ||
                               embree.source(a.hit.triangle) == oracle.source(b.hit.triangle));
        differences += same ? 0 : 1;
        EXPECT_EQ(embree.occluded(origin, d, self), a.end == RayEnd::hit);
    }
    EXPECT_GT(hits, kRays / 4);
    EXPECT_LE(differences, kRays / 1000);  // rays through a border
}

TEST_P(PeriodicScene, TheImageOfACellThatARayStartsInDoesNotMatter) {
    Random random(64);
    const RayCaster caster(awkward_scene(random), cell(), Accelerator::embree);
    const LocalMesh& mesh = caster.mesh();
    int differences = 0;
    for (int i = 0; i < 2000; ++i) {
        const std::uint32_t self = random.below(mesh.triangle_count());
        const Vec3 origin = test::random_point_on(mesh, self, random);
        const Vec3 d = normalized(random.direction());
        const double x = std::round(random.between(-50, 50)),
                     y = std::round(random.between(-50, 50));
        const Vec3 shift{
            cell().along_x ? x * cell().size_x : 0, cell().along_y ? y * cell().size_y : 0, 0};
        const CastHit here = caster.cast(origin, d, kNoTriangle);
        const CastHit there = caster.cast(origin + mesh.scale * shift, d, kNoTriangle);
        differences += here.end != there.end || here.hit.triangle != there.hit.triangle ? 1 : 0;
    }
    EXPECT_LE(differences, 20);  // rays that start on a triangle and leave it to chance
}

TEST_P(PeriodicScene, ATriangleOverABorderIsNotMetByItsOwnRays) {
    // Its images lie beside it in one plane: nothing can be met.
    const Vec3 corner{cell().low_x + 0.9 * cell().size_x, cell().low_y + 0.9 * cell().size_y, 0};
    const RayCaster caster(
        make_triangle(corner, corner + Vec3{0.3, 0.1, 0}, corner + Vec3{0.1, 0.3, 0}), cell(),
        Accelerator::embree);
    ASSERT_GT(caster.mesh().triangle_count(), 1U);
    Random random(65);
    for (int i = 0; i < 20000; ++i) {
        const std::uint32_t self = random.below(caster.mesh().triangle_count());
        const Vec3 origin = test::random_point_on(caster.mesh(), self, random);
        const Vec3 d = random.direction();
        const double slope = std::pow(10.0, -random.between(0, 5));
        const Vec3 grazing = normalized({d.x, d.y, d.z > 0 ? slope : -slope});
        ASSERT_EQ(caster.cast(origin, grazing, self).end, RayEnd::escaped);
        ASSERT_FALSE(caster.occluded(origin, grazing, self));
    }
}

TEST(Periodic, ABentLeafOverTheBorderIsMetInTheNextCell) {
    // The right half of a leaf, bent up, is seen from the left half across the border at x = 1.
    const std::vector<Triangle> leaf{
        {Vec3{0.8, 0.5, 0}, Vec3{1, 0.4, 0}, Vec3{1, 0.6, 0}},
        {Vec3{1, 0.4, 0}, Vec3{1.2, 0.5, 0.2}, Vec3{1, 0.6, 0}}};
    const RayCaster caster(leaf, {true, true, 0, 0, 1, 1}, Accelerator::embree);
    for (const double distance : {0.1, 0.01, 1e-3, 1e-4, 1e-5}) {
        const Vec3 origin = caster.mesh().to_local({1 - distance, 0.5, 0});
        // Any image of the first triangle that the origin lies on will do.
        std::uint32_t self = kNoTriangle;
        for (std::uint32_t i = 0; i < caster.mesh().triangle_count(); ++i) {
            const Vec3 from_corner = origin - caster.mesh().vertex(i, 0);
            if (caster.source(i) == 0 && from_corner.x > 0 && from_corner.x < 0.5) {
                self = i;
            }
        }
        const CastHit hit = caster.cast(origin, normalized({1, 0, 0.5}), self);
        ASSERT_EQ(hit.end, RayEnd::hit) << distance;
        EXPECT_EQ(caster.source(hit.hit.triangle), 1U);
        EXPECT_NEAR(hit.hit.t / caster.mesh().scale, distance * 2 * std::sqrt(1.25), 1e-5);
    }
}

class Horizontal : public ::testing::Test {
  protected:
    /// A wall across x in the middle of the cell, half as high as the pole that makes the scene's
    /// height.
    static std::vector<Triangle> wall_and_pole() {
        std::vector<Triangle> triangles =
            make_parallelogram({0.5, 0.2, 0}, {0, 0.2, 0}, {0, 0, 0.5});
        triangles.push_back({Vec3{0.1, 0.8, 0}, Vec3{0.1, 0.801, 0}, Vec3{0.1, 0.8, 1}});
        return triangles;
    }
    static RayEnd end(const RayCaster& caster, const Vec3& origin, const Vec3& direction) {
        return caster.cast(caster.mesh().to_local(origin), direction, kNoTriangle).end;
    }
};

TEST_F(Horizontal, RaysInTheLayerMeetSomethingOrAreLost) {
    const RayCaster caster(wall_and_pole(), {true, true, 0, 0, 1, 1}, Accelerator::embree);
    EXPECT_EQ(end(caster, {0.7, 0.3, 0.2}, {1, 0, 0}), RayEnd::hit);   // in the next cell
    EXPECT_EQ(end(caster, {0.7, 0.3, 0.7}, {1, 0, 0}), RayEnd::lost);  // over the wall, for ever
    EXPECT_EQ(end(caster, {0.7, 0.3, 0.2}, {0, 1, 0}), RayEnd::lost);
    EXPECT_FALSE(caster.occluded(caster.mesh().to_local({0.7, 0.3, 0.7}), {1, 0, 0}, kNoTriangle));
}

TEST_F(Horizontal, RaysAboveAndBelowTheLayerEscape) {
    const RayCaster caster(wall_and_pole(), {true, true, 0, 0, 1, 1}, Accelerator::embree);
    EXPECT_EQ(end(caster, {0.7, 0.3, 1.1}, {1, 0, 0}), RayEnd::escaped);
    EXPECT_EQ(end(caster, {0.7, 0.3, -0.1}, {0.6, 0.8, 0}), RayEnd::escaped);
}

TEST_F(Horizontal, RaysAcrossARowEscapeAndAlongItAreLost) {
    const RayCaster caster(wall_and_pole(), {true, false, 0, 0, 1, 1}, Accelerator::embree);
    EXPECT_EQ(end(caster, {0.7, 0.3, 0.7}, {0, 1, 0}), RayEnd::escaped);
    EXPECT_EQ(end(caster, {0.7, 0.3, 0.7}, {1, 0, 0}), RayEnd::lost);
    EXPECT_EQ(end(caster, {0.7, 0.9, 0.7}, {1, 0, 0}), RayEnd::escaped);  // beside the row
    EXPECT_EQ(end(caster, {0.7, -5, 0.2}, {0, 1, 0}), RayEnd::escaped);
    EXPECT_EQ(end(caster, {-20.3, 0.3, 0.2}, {1, 0, 0}), RayEnd::hit);
}

TEST_F(Horizontal, AlmostHorizontalRaysGoVeryFar) {
    const RayCaster caster(wall_and_pole(), {true, true, 0, 0, 1, 1}, Accelerator::embree);
    // Falls by one ten-thousandth per cell: reaches the wall's top, 0.2 lower, in the 2000th cell.
    const CastHit hit = caster.cast(
        caster.mesh().to_local({0.7, 0.3, 0.7}), normalized({1, 0, -1e-4}), kNoTriangle);
    ASSERT_EQ(hit.end, RayEnd::hit);
    EXPECT_NEAR(hit.hit.t / caster.mesh().scale, 2000, 1);
}

TEST(Periodic, APlateThatFillsTheCellIsAnInfinitePlane) {
    const RayCaster caster(
        make_parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), {true, true, 0, 0, 1, 1},
        Accelerator::embree);
    Random random(66);
    for (int i = 0; i < 20000; ++i) {
        const Vec3 origin{random.between(-3, 3), random.between(-3, 3), 0.5};
        const Vec3 d = normalized({random.between(-5, 5), random.between(-5, 5), -1});
        ASSERT_EQ(caster.cast(caster.mesh().to_local(origin), d, kNoTriangle).end, RayEnd::hit);
    }
}

}  // namespace

}  // namespace quasimc

#include "raster/line_hits.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "geometry_testing.h"
#include "support/random_leaves.h"

namespace quasimc {
namespace {

using test::kDown;
using test::kLeaf;

/// Each triangle is a patch.
LineTriangles whole(const LocalMesh& mesh) {
    const Patches patches(std::vector<std::uint8_t>(mesh.triangle_count(), 0));
    return line_triangles({&mesh, {}}, patches);
}

/// A horizontal square of the side 1 about the origin.
std::vector<Triangle> square_at(double height) {
    const Vec3 a{-.5, -.5, height}, b{.5, -.5, height}, c{.5, .5, height}, d{-.5, .5, height};
    return {{a, b, c}, {a, c, d}};
}

/// However few pixels there are, the parts of a leaf are met as often as they are seen large.
TEST(LineHits, MeasureEveryPatchWithoutBias) {
    const LocalMesh mesh = make_local_mesh({kLeaf});
    const Patches patches({2});
    constexpr int kShifts = 200;
    const Vec3 direction = normalized(Vec3{1, 2, -3});
    std::vector<double> areas(16);
    LineHitScratch scratch;
    for (int i = 0; i < kShifts; ++i) {
        for (int j = 0; j < kShifts; ++j) {
            const LineHits hits = find_line_hits(
                {&mesh, {}}, line_triangles({&mesh, {}}, patches),
                {direction, .123, (i + .5) / kShifts, (j + .5) / kShifts, .3}, scratch);
            hits.for_each_line([&](std::span<const LineHits::Hit> line) {
                for (const LineHits::Hit passed : line) {
                    areas.at(passed / 2) += hits.line_area();
                    EXPECT_EQ(passed % 2, 0U);  // light comes to the upper side
                }
            });
        }
    }
    const double expected = .5 * mesh.scale * mesh.scale * std::abs(direction.z) / 16;
    for (const double area : areas) {
        EXPECT_NEAR(area / (kShifts * kShifts), expected, 1e-3 * expected);
    }
}

/// Leaves stand over one another: along each line their numbers grow.
TEST(LineHits, PassSurfacesInTheirOrder) {
    std::vector<Triangle> leaves;
    for (int i = 0; i < 40; ++i) {
        const double z = -.02 * i;
        leaves.push_back({Vec3{.01 * i, 0, z}, Vec3{1, .3, z}, Vec3{0, 1, z}});
    }
    const LocalMesh mesh = make_local_mesh(leaves);
    LineHitScratch scratch;
    const LineHits hits = find_line_hits(
        {&mesh, {}}, whole(mesh), {normalized(Vec3{.1, .2, -1}), .3, .5, .5, 1e-4}, scratch);
    std::size_t longest = 0;
    hits.for_each_line([&](std::span<const LineHits::Hit> line) {
        longest = std::max(longest, line.size());
        for (std::size_t i = 1; i < line.size(); ++i) {
            EXPECT_LT(line[i - 1], line[i]);
        }
    });
    EXPECT_EQ(longest, 40U);
}

/// Each triangle is one patch.
TEST(LineHits, CountTheLinesThatPassEachTriangle) {
    const LocalMesh mesh = make_local_mesh(test::random_leaves(100, .3, 1, 7));
    LineHitScratch scratch;
    const LineHits hits = find_line_hits(
        {&mesh, {}}, whole(mesh), {normalized(Vec3{.3, .2, -1}), .3, .5, .5, 1e-3}, scratch);
    std::vector<std::uint32_t> passed(mesh.triangle_count());
    hits.for_each_line([&](std::span<const LineHits::Hit> line) {
        for (const LineHits::Hit patch : line) {
            ++passed.at(patch / 2);
        }
    });
    EXPECT_GT(hits.size(), 1000U);
    EXPECT_TRUE(
        std::equal(passed.begin(), passed.end(), hits.counts().begin(), hits.counts().end()));
}

/// Every line through the infinite stand meets squares that fill a cell once, from any direction
/// and for any number of lines.
TEST(LineHits, MeetEachLayerOfAnInfiniteStandOnce) {
    std::vector<Triangle> layers = square_at(.3);
    for (const Triangle& triangle : square_at(-.2)) {
        layers.push_back(triangle);
    }
    const LocalMesh mesh = make_local_mesh(layers);
    const Cell world{
        .along_x = true, .along_y = true, .low_x = -.5, .low_y = -.5, .size_x = 1, .size_y = 1};
    const Cell cell = local_cell(mesh, world);
    const LineTriangles triangles = whole(mesh);
    test::Random random(1);
    LineHitScratch scratch;
    std::size_t lines = 0;
    for (int i = 0; i < 2000; ++i) {
        Vec3 direction = random.direction();
        direction.z = std::max(std::abs(direction.z), 1e-4);
        direction = normalized(direction);
        const double line_area = cell.size_x * cell.size_y / (2 + 100 * random.uniform());
        const LineHits hits = find_line_hits(
            {&mesh, cell}, triangles,
            {direction, random.uniform(), random.uniform(), random.uniform(), line_area}, scratch);
        std::size_t own = 0;
        hits.for_each_line([&](std::span<const LineHits::Hit> line) {
            ++own;
            ASSERT_EQ(line.size(), 2U);
            EXPECT_GE(line[0] / 2, 2U);  // upwards: the lower square first
            EXPECT_LT(line[1] / 2, 2U);
            EXPECT_EQ(line[0] % 2, 1U);
        });
        // All lines together are the cell as it is seen.
        EXPECT_NEAR(
            static_cast<double>(own) * hits.line_area(), cell.size_x * cell.size_y * direction.z,
            1e-9);
        lines += own;
    }
    EXPECT_GT(lines, 10000U);
}

TEST(LineHits, MarkSensorsAndLeaveOutWhatHasNoPatches) {
    const LocalMesh mesh = make_local_mesh(
        {kLeaf,
         {Vec3{0, 0, -1}, Vec3{1, 0, -1}, Vec3{0, 1, -1}},
         {Vec3{0, 0, -2}, Vec3{1, 0, -2}, Vec3{0, 1, -2}}});
    const std::vector<VisibilityRole> roles{
        VisibilityRole::opaque, VisibilityRole::sensor, VisibilityRole::omitted};
    const Patches patches({0, 0, Patches::kNone});
    ProjectedScene scene{&mesh, {}};
    scene.roles = roles;
    LineHitScratch scratch;
    const LineHits hits =
        find_line_hits(scene, line_triangles(scene, patches), {kDown, .3, .5, .5, .01}, scratch);
    std::size_t lines = 0;
    hits.for_each_line([&](std::span<const LineHits::Hit> line) {
        ++lines;
        ASSERT_EQ(line.size(), 2U);
        EXPECT_EQ(line[0], 0U);
        EXPECT_EQ(line[1], LineHits::kSensor | 2U);
    });
    EXPECT_GT(lines, 5U);
    // A sensor that faces straight up sees nothing that comes slantwise.
    const std::vector<float> narrow{0, .9F, 0};
    const LineHits slanted = find_line_hits(
        scene, line_triangles(scene, patches, narrow),
        {normalized(Vec3{1, 0, -1}), .3, .5, .5, .01}, scratch);
    slanted.for_each_line([&](std::span<const LineHits::Hit> line) { EXPECT_EQ(line.size(), 1U); });
}

/// Where lines are many for what they meet, they are put in order otherwise.
TEST(LineHits, FindTheSameInAWideScene) {
    std::vector<Triangle> leaves = test::random_leaves(20, .02, .03, 4);
    leaves.push_back({Vec3{9, 9, 0}, Vec3{9.001, 9, 0}, Vec3{9, 9.001, 0}});
    const LocalMesh mesh = make_local_mesh(leaves);
    LineHitScratch scratch;
    const LineHits hits =
        find_line_hits({&mesh, {}}, whole(mesh), {kDown, .1, .5, .5, 1e-9}, scratch);
    std::size_t longest = 0, met = 0;
    double area = 0;
    hits.for_each_line([&](std::span<const LineHits::Hit> line) {
        longest = std::max(longest, line.size());
        met += line.size();
        area += hits.line_area() * static_cast<double>(line.size());
    });
    double expected = 0;
    for (std::uint32_t i = 0; i < mesh.triangle_count(); ++i) {
        expected += std::abs(mesh.across(i).z) / 2;
    }
    EXPECT_NEAR(area, expected, .02 * expected);
    EXPECT_GT(longest, 1U);
    EXPECT_EQ(met, hits.size());
}

}  // namespace
}  // namespace quasimc

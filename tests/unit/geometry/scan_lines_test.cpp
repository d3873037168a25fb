#include "raster/scan_lines.h"

#include <cmath>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "geometry/cast/intersector.h"
#include "geometry_testing.h"
#include "support/random_leaves.h"

namespace quasimc {
namespace {

using test::kDown;
using test::kLeaf;

/// Area of the beam that each triangle catches.
std::map<std::uint32_t, double> caught(
    const LocalMesh& mesh,
    const ScanLines::Spec& spec,
    std::span<const VisibilityRole> roles = {}) {
    const ScanLines lines({&mesh, {}, roles}, spec);
    LineScratch scratch;
    std::map<std::uint32_t, double> areas;
    for (std::uint32_t i = 0; i < ScanLines::strips(spec.lines); ++i) {
        const LineStrip strip(lines, i, scratch);
        strip.for_visible_segments([&](const LineStrip::Line& line) {
            for (const VisibleSegment& segment : line.segments) {
                areas[strip.triangles()[segment.surface].triangle] +=
                    segment.length() * lines.area();
            }
        });
    }
    return areas;
}

TEST(ScanLines, MeasureATriangleFromAllSides) {
    const LocalMesh mesh = make_local_mesh({kLeaf});
    const double area = .5 * mesh.scale * mesh.scale;
    for (const double rotation : {.03, .1, .37, .9}) {
        for (const Vec3& direction : {kDown, -kDown, normalized(Vec3{1, 2, -3})}) {
            const auto areas = caught(mesh, {direction, rotation, .3, 2000});
            ASSERT_EQ(areas.size(), 1U);
            EXPECT_NEAR(areas.at(0), area * std::abs(direction.z), 2e-5);
        }
    }
}

TEST(ScanLines, AreUnbiasedHoweverFewThereAre) {
    const LocalMesh mesh = make_local_mesh({kLeaf});
    constexpr int kShifts = 1000;
    double sum = 0;
    for (int i = 0; i < kShifts; ++i) {
        const double shift = (i + .5) / kShifts;
        const auto areas = caught(mesh, {kDown, .123, shift, 3});
        sum += areas.at(0) / kShifts;
    }
    EXPECT_NEAR(sum, .5 * mesh.scale * mesh.scale, 1e-6);
}

TEST(ScanLines, SeeLeavesThatPassThroughEachOther) {
    // A horizontal leaf, cut by one that rises through it along x = 1/2.
    const std::vector<Triangle> triangles{
        {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}},
        {Vec3{0, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}},
        {Vec3{0, 0, -.5}, Vec3{1, 0, .5}, Vec3{1, 1, .5}},
        {Vec3{0, 0, -.5}, Vec3{1, 1, .5}, Vec3{0, 1, -.5}}};
    const LocalMesh mesh = make_local_mesh(triangles);
    const auto areas = caught(mesh, {kDown, .2, .4, 4000});
    const double unit = mesh.scale * mesh.scale;
    EXPECT_NEAR(areas.at(0) + areas.at(1), .5 * unit, 1e-5);
    EXPECT_NEAR(areas.at(2) + areas.at(3), .5 * unit, 1e-5);
}

TEST(ScanLines, SeeThroughSensorsAndWhatSensorsSee) {
    const std::vector<Triangle> triangles{
        {Vec3{0, 0, 1}, Vec3{1, 0, 1}, Vec3{0, 1, 1}},
        kLeaf,
        {Vec3{0, 0, -1}, Vec3{1, 0, -1}, Vec3{0, 1, -1}}};
    const LocalMesh mesh = make_local_mesh(triangles);
    const std::vector<VisibilityRole> roles{
        VisibilityRole::sensor, VisibilityRole::opaque, VisibilityRole::sensor};
    const auto areas = caught(mesh, {kDown, .2, .4, 1000}, roles);
    const double area = .5 * mesh.scale * mesh.scale;
    EXPECT_NEAR(areas.at(0), area, 1e-6);
    EXPECT_NEAR(areas.at(1), area, 1e-6);
    EXPECT_EQ(areas.count(2), 0U);
}

/// Every point on a lit segment sees the light, and the segments of a line cover what rays hit.
TEST(ScanLines, AgreeWithRays) {
    const std::vector<Triangle> leaves = test::random_leaves(200, .3, 1, 7);
    const LocalMesh mesh = make_local_mesh(leaves);
    const auto engine = make_brute_force_intersector(mesh);
    const Vec3 direction = normalized(Vec3{.3, -.2, -1});
    const ScanLines::Spec spec{direction, .3, .7, 40};
    const ScanLines lines({&mesh, {}}, spec);
    LineScratch scratch;
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform;
    int samples = 0;
    int agreed = 0;
    const LineStrip strip(lines, 0, scratch);
    strip.for_visible_segments([&](const LineStrip::Line& line) {
        for (const VisibleSegment& segment : line.segments) {
            const auto [u, v] = strip.point(line, segment, uniform(random));
            const std::uint32_t triangle = strip.triangles()[segment.surface].triangle;
            const Ray ray{mesh.point(triangle, u, v) - 4 * direction, direction};
            ++samples;
            agreed += engine->closest(ray).triangle == triangle ? 1 : 0;
            EXPECT_GT(segment.length(), 0);
        }
    });
    EXPECT_GT(samples, 400);
    // Rays in single precision may miss a leaf by its very edge.
    EXPECT_GE(agreed, samples - samples / 200);
}

/// A strip does not depend on what its scratch was used for.
TEST(ScanLines, DoNotDependOnUsedScratch) {
    const LocalMesh many = make_local_mesh(test::random_leaves(300, .2, 1, 9));
    const LocalMesh one = make_local_mesh({kLeaf});
    const ScanLines::Spec spec{kDown, .3, .6, 3 * ScanLines::kStrip};
    const auto lengths_of = [](const ScanLines& lines, std::uint32_t i, LineScratch& scratch) {
        const LineStrip strip(lines, i, scratch);
        const auto visible = strip.for_visible_segments([](const LineStrip::Line&) {});
        std::map<std::uint32_t, double> lengths;
        for (std::size_t k = 0; k < visible.size(); ++k) {
            lengths[strip.triangles()[k].triangle] = visible[k].length;
        }
        return lengths;
    };
    const ScanLines lines({&many, {}}, spec);
    LineScratch fresh, used;
    const auto last = lengths_of(lines, 2, fresh);
    EXPECT_GT(last.size(), 50U);
    lengths_of(ScanLines({&one, {}}, spec), 1, used);
    for (const std::uint32_t strip : {0U, 1U}) {
        lengths_of(lines, strip, used);
    }
    EXPECT_EQ(lengths_of(lines, 2, used), last);
}

/// What is visible of triangles is what their segments sum up to; asked twice it is the same.
TEST(ScanLines, SumUpTheirSegments) {
    const LocalMesh mesh = make_local_mesh(test::random_leaves(100, .3, 1, 4));
    const ScanLines lines({&mesh, {}}, {kDown, .1, .2, 100});
    LineScratch scratch;
    const LineStrip strip(lines, 0, scratch);
    for (int i = 0; i < 2; ++i) {
        std::map<std::uint32_t, double> lengths;
        const auto visible = strip.for_visible_segments([&](const LineStrip::Line& line) {
            for (const VisibleSegment& segment : line.segments) {
                lengths[segment.surface] += segment.length();
            }
        });
        for (std::uint32_t k = 0; k < visible.size(); ++k) {
            EXPECT_DOUBLE_EQ(visible[k].length, lengths[k]);
        }
    }
}

TEST(ScanLines, ConvergeWithTheThirdPowerOfTheirNumber) {
    const std::vector<Triangle> leaves = test::random_leaves(60, .3, 1, 3);
    const LocalMesh mesh = make_local_mesh(leaves);
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> uniform;
    const auto variance = [&](std::uint32_t lines) {
        return test::variance_of_areas([&] {
            return caught(mesh, {kDown, uniform(random), uniform(random), lines});
        });
    };
    const double slope = std::log(variance(800) / variance(100)) / std::log(8.0);
    EXPECT_LT(slope, -2.5);
}

}  // namespace
}  // namespace quasimc

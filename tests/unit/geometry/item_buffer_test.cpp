#include "raster/item_buffer.h"

#include <algorithm>
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
std::map<std::uint32_t, double> caught(const ProjectedScene& scene, const ItemBuffer::View& spec) {
    ItemScratch scratch;
    const ItemBuffer buffer = draw(scene, spec, scratch);
    std::map<std::uint32_t, double> areas;
    for (const ItemBuffer::Item& item : buffer.items()) {
        areas[item.triangle] += item.pixels * buffer.pixel_area();
    }
    return areas;
}

TEST(ItemBuffer, MeasuresATriangleFromAllSides) {
    const LocalMesh mesh = make_local_mesh({kLeaf});
    const double area = .5 * mesh.scale * mesh.scale;
    for (const double rotation : {.03, .1, .37, .9}) {
        for (const Vec3& direction : {kDown, -kDown, normalized(Vec3{1, 2, -3})}) {
            ItemScratch scratch;
            const ItemBuffer buffer =
                draw({&mesh, {}}, {direction, rotation, .3, .6, 1e6}, scratch);
            ASSERT_EQ(buffer.items().size(), 1U);
            const ItemBuffer::Item& item = buffer.items()[0];
            EXPECT_NEAR(item.pixels * buffer.pixel_area(), area * std::abs(direction.z), 1e-4);
            EXPECT_NEAR(item.cosine, direction.z, 1e-6);
        }
    }
}

TEST(ItemBuffer, IsUnbiasedHoweverFewPixelsThereAre) {
    const LocalMesh mesh = make_local_mesh({kLeaf});
    constexpr int kShifts = 200;
    const ProjectedScene scene{&mesh, {}};
    ItemScratch scratch;
    double sum = 0;
    for (int i = 0; i < kShifts; ++i) {
        for (int j = 0; j < kShifts; ++j) {
            const ItemBuffer buffer =
                draw(scene, {kDown, .123, (i + .5) / kShifts, (j + .5) / kShifts, 3}, scratch);
            for (const ItemBuffer::Item& item : buffer.items()) {
                sum += item.pixels * buffer.pixel_area();
            }
        }
    }
    EXPECT_NEAR(sum / (kShifts * kShifts), .5 * mesh.scale * mesh.scale, 1e-4);
}

TEST(ItemBuffer, SeesThroughSensorsAndWhatSensorsSee) {
    const std::vector<Triangle> triangles{
        {Vec3{0, 0, 1}, Vec3{1, 0, 1}, Vec3{0, 1, 1}},
        kLeaf,
        {Vec3{0, 0, -1}, Vec3{1, 0, -1}, Vec3{0, 1, -1}}};
    const LocalMesh mesh = make_local_mesh(triangles);
    const std::vector<VisibilityRole> roles{
        VisibilityRole::sensor, VisibilityRole::opaque, VisibilityRole::sensor};
    const auto areas = caught({&mesh, {}, roles}, {kDown, .2, .4, .1, 1e6});
    const double area = .5 * mesh.scale * mesh.scale;
    EXPECT_NEAR(areas.at(0), area, 1e-4);
    EXPECT_NEAR(areas.at(1), area, 1e-4);
    EXPECT_EQ(areas.count(2), 0U);
}

TEST(ItemBuffer, SeesNothingEdgeOn) {
    const LocalMesh mesh = make_local_mesh({kLeaf});
    EXPECT_TRUE(caught({&mesh, {}}, {{1, 0, 0}, .2, .4, .1, 1000}).empty());
}

/// The same scratch serves scenes of different size one after the other.
TEST(ItemBuffer, DoesNotDependOnUsedScratch) {
    const LocalMesh many = make_local_mesh(test::random_leaves(50, .3, 1, 7));
    const LocalMesh one = make_local_mesh({kLeaf});
    ItemScratch scratch;
    EXPECT_GT(draw({&many, {}}, {kDown, .2, .4, .1, 1e4}, scratch).items().size(), 10U);
    const ItemBuffer buffer = draw({&one, {}}, {kDown, .2, .4, .1, 1e4}, scratch);
    ASSERT_EQ(buffer.items().size(), 1U);
    EXPECT_EQ(buffer.items()[0].triangle, 0U);
}

/// Of all pixels of a beam.
std::uint32_t columns_of(const ItemBuffer& buffer) {
    std::uint32_t columns = 0;
    buffer.for_each_run_of_rows(0, 1, [&](const ItemBuffer::RowRun& run) {
        columns = std::max(columns, run.x + run.count);
    });
    return columns;
}

/// Rows that are read a few at a time have all pixels together; runs end where rows do.
TEST(ItemBuffer, ListsRunsOfEachFewRows) {
    const LocalMesh mesh = make_local_mesh(test::random_leaves(50, .3, 1, 7));
    ItemScratch scratch;
    const ItemBuffer buffer =
        draw({&mesh, {}}, {normalized(Vec3{.3, -.2, -1}), .3, .7, .2, 3000}, scratch);
    const std::uint32_t columns = columns_of(buffer);
    std::map<std::uint32_t, std::uint32_t> all;
    buffer.for_each_run([&](const ItemBuffer::Run& run) {
        for (std::uint32_t i = run.first; i < run.first + run.count; ++i) {
            all[i] = run.id;
        }
    });
    constexpr std::uint32_t kOf = 3;
    std::map<std::uint32_t, std::uint32_t> by_rows;
    for (std::uint32_t first = 0; first < kOf; ++first) {
        buffer.for_each_run_of_rows(first, kOf, [&](const ItemBuffer::RowRun& run) {
            EXPECT_EQ(run.row % kOf, first);
            EXPECT_LE(run.x + run.count, columns);
            for (std::uint32_t x = run.x; x < run.x + run.count; ++x) {
                EXPECT_TRUE(by_rows.emplace(run.row * columns + x, run.id).second);
            }
        });
    }
    EXPECT_GT(all.size(), 2000U);
    EXPECT_EQ(by_rows, all);
}

/// Every pixel shows what a ray through it hits, and where.
TEST(ItemBuffer, AgreesWithRays) {
    const std::vector<Triangle> leaves = test::random_leaves(200, .3, 1, 7);
    const LocalMesh mesh = make_local_mesh(leaves);
    const auto engine = make_brute_force_intersector(mesh);
    const Vec3 direction = normalized(Vec3{.3, -.2, -1});
    ItemScratch scratch;
    const ItemBuffer buffer = draw({&mesh, {}}, {direction, .3, .7, .2, 3000, true}, scratch);
    std::map<std::uint32_t, std::uint32_t> triangle_of;
    for (const ItemBuffer::Item& item : buffer.items()) {
        triangle_of[item.id] = item.triangle;
    }
    int samples = 0;
    int agreed = 0;
    std::uint32_t next = 0;
    const std::uint32_t columns = columns_of(buffer);
    buffer.for_each_run([&](const ItemBuffer::Run& run) {
        EXPECT_EQ(run.first, next);
        next = run.first + run.count;
        for (std::uint32_t i = run.first; run.id > 0 && i < next; ++i) {
            const std::uint32_t triangle = triangle_of.at(run.id);
            const auto [u, v] = buffer.point(i);
            EXPECT_GT(u, -1e-6);
            EXPECT_GT(v, -1e-6);
            EXPECT_LT(u + v, 1 + 1e-6);
            const Point2 same = buffer.points(run.id).of(i % columns, i / columns);
            EXPECT_NEAR(same.s, u, 1e-6);
            EXPECT_NEAR(same.t, v, 1e-6);
            const Ray ray{mesh.point(triangle, u, v) - 4 * direction, direction};
            ++samples;
            agreed += engine->closest(ray).triangle == triangle ? 1 : 0;
        }
    });
    EXPECT_GT(samples, 1000);
    // Rays in single precision may miss a leaf by its very edge.
    EXPECT_GE(agreed, samples - samples / 200);
}

/// Two triangles that share a side leave no gap and do not overlap.
TEST(ItemBuffer, JoinsNeighbours) {
    const std::vector<Triangle> square{
        {Vec3{0, 0, 0}, Vec3{1, .3, 0}, Vec3{.7, 1.3, 0}},
        {Vec3{0, 0, 0}, Vec3{.7, 1.3, 0}, Vec3{-.3, 1, 0}}};
    const LocalMesh mesh = make_local_mesh(square);
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform;
    for (int i = 0; i < 50; ++i) {
        ItemScratch scratch;
        const ItemBuffer buffer = draw(
            {&mesh, {}}, {kDown, uniform(random), uniform(random), uniform(random), 1000}, scratch);
        const double area = 1.09 * mesh.scale * mesh.scale;
        double seen = 0;
        for (const ItemBuffer::Item& item : buffer.items()) {
            seen += item.pixels * buffer.pixel_area();
        }
        // Off by the pixels along the rim at most.
        EXPECT_NEAR(seen, area, .15 * area);
    }
}

TEST(ItemBuffer, ConvergesFasterThanRandomRays) {
    const std::vector<Triangle> leaves = test::random_leaves(60, .3, 1, 3);
    const LocalMesh mesh = make_local_mesh(leaves);
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> uniform;
    const auto variance = [&](double pixels) {
        return test::variance_of_areas([&] {
            return caught(
                {&mesh, {}}, {kDown, uniform(random), uniform(random), uniform(random), pixels});
        });
    };
    const double slope = std::log(variance(160000) / variance(2500)) / std::log(64.0);
    EXPECT_LT(slope, -1.3);
}

}  // namespace
}  // namespace quasimc

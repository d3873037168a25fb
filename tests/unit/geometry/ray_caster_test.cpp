#include "geometry/cast/ray_caster.h"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "geometry_testing.h"

namespace quasimc {

namespace {

using test::Random;

TEST(RayCaster, EnginesAgreeOnRaysThatLeaveTriangles) {
    Random random(41);
    const auto soup = test::random_soup(400, 0.15, random);
    const RayCaster embree(soup, Cell{}, Accelerator::embree),
        oracle(soup, Cell{}, Accelerator::brute_force);
    int hits = 0, differences = 0;
    constexpr int kRays = 10000;
    for (int i = 0; i < kRays; ++i) {
        const std::uint32_t self = random.below(400);
        const Vec3 origin = test::random_point_on(embree.mesh(), self, random);
        const Vec3 d = normalized(random.direction());
        const CastHit a = embree.cast(origin, d, self), b = oracle.cast(origin, d, self);
        hits += a.end == RayEnd::hit ? 1 : 0;
        differences += a.hit.triangle != b.hit.triangle ? 1 : 0;
        EXPECT_EQ(a.end == RayEnd::hit, a.hit.found());
        EXPECT_EQ(embree.occluded(origin, d, self), a.end == RayEnd::hit);
    }
    EXPECT_GT(hits, kRays / 4);
    EXPECT_LE(differences, kRays / 2000);  // rays through a border
}

TEST(RayCaster, InAnOpenSceneEveryTriangleIsItsOwnSource) {
    Random random(42);
    const RayCaster caster(test::random_soup(10, 0.2, random), Cell{}, Accelerator::brute_force);
    for (std::uint32_t i = 0; i < 10; ++i) {
        EXPECT_EQ(caster.source(i), i);
    }
}

TEST(RayCaster, SaysWhetherARayEscapes) {
    const RayCaster caster(
        {{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}}, Cell{}, Accelerator::embree);
    const Vec3 above = caster.mesh().to_local({0.2, 0.2, 1});
    EXPECT_EQ(caster.cast(above, {0, 0, -1}, kNoTriangle).end, RayEnd::hit);
    EXPECT_EQ(caster.cast(above, {0, 0, 1}, kNoTriangle).end, RayEnd::escaped);
    EXPECT_EQ(caster.cast(above, {1, 0, 0}, kNoTriangle).end, RayEnd::escaped);
}

/// A lamp next to a plate: light of one side meets it, of a lamp in its plane no light does.
TEST(RayCaster, TellsOnWhichSideOfAPlateALampIs) {
    const std::vector<Triangle> plate{{Vec3{-1, -1, .3}, Vec3{1, -1, .3}, Vec3{0, 1, .3}}};
    for (const Accelerator accelerator : {Accelerator::embree, Accelerator::brute_force}) {
        const RayCaster caster(plate, Cell{}, accelerator);
        Random random(44);
        for (const double gap : {-1e-3, -1e-5, -1e-6, -2e-7, 0.0, 2e-7, 1e-6, 1e-5, 1e-3}) {
            const Vec3 lamp = caster.mesh().to_local({.1, .1, .3}) + Vec3{0, 0, gap};
            for (int i = 0; i < 1000; ++i) {
                const Vec3 d = normalized(random.direction());
                const bool is_towards = gap * d.z < 0 && std::abs(d.z) > .1;
                const bool is_away = gap * d.z >= 0;
                const CastHit at = caster.cast_from_lamp(lamp, d);
                const Hit near = caster.hit_at_lamp(lamp, d, 1, kNoTriangle);
                EXPECT_FALSE(is_towards && at.end != RayEnd::hit) << gap << ' ' << d.z;
                EXPECT_FALSE(is_away && at.end == RayEnd::hit) << gap << ' ' << d.z;
                EXPECT_FALSE(is_towards && std::abs(gap) < 2e-6 && !near.found()) << gap;
                EXPECT_FALSE(is_away && near.found()) << gap << ' ' << d.z;
            }
        }
    }
}

TEST(RayCaster, TrianglesWithoutAreaAreNeverMet) {
    const Vec3 p{0, 0, 0}, q{1, 0, 0};
    const RayCaster caster(
        {{p, q, q}, {p, p, p}, {p, q, 0.5 * (p + q)}}, Cell{}, Accelerator::embree);
    Random random(43);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 d = random.direction();
        EXPECT_EQ(caster.cast(-2 * d, d, kNoTriangle).end, RayEnd::escaped);
    }
}

TEST(RayCaster, CanBeMoved) {
    RayCaster first({{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}}, Cell{}, Accelerator::embree);
    const RayCaster second = std::move(first);
    const Vec3 above = second.mesh().to_local({0.2, 0.2, 1});
    EXPECT_EQ(second.cast(above, {0, 0, -1}, kNoTriangle).end, RayEnd::hit);
}

TEST(RayCaster, ManyThreadsGetWhatOneGets) {
    Random random(45);
    const auto soup = test::random_soup(300, 0.2, random);
    const RayCaster caster(soup, {true, true, 0, 0, 1, 1}, Accelerator::embree);
    constexpr std::uint64_t kBlocks = 64;
    const auto cast_block = [&](std::uint64_t block) {
        Random rays(block);
        std::vector<std::uint32_t> met;
        for (int i = 0; i < 200; ++i) {
            const std::uint32_t self = rays.below(caster.mesh().triangle_count());
            const Vec3 origin = test::random_point_on(caster.mesh(), self, rays);
            met.push_back(caster.cast(origin, normalized(rays.direction()), self).hit.triangle);
        }
        return met;
    };
    std::vector<std::vector<std::uint32_t>> together(kBlocks);
    parallel_blocks(
        kBlocks, 4, [&](std::uint64_t block, unsigned) { together[block] = cast_block(block); });
    for (std::uint64_t block = 0; block < kBlocks; ++block) {
        EXPECT_EQ(together[block], cast_block(block));
    }
}

class Packets : public ::testing::TestWithParam<int> {
  protected:
    /// Open, or periodic along x, y, both.
    [[nodiscard]] static Cell cell() {
        Cell cell;
        cell.along_x = (GetParam() & 1) != 0;
        cell.along_y = (GetParam() & 2) != 0;
        return cell;
    }
};

INSTANTIATE_TEST_SUITE_P(Cells, Packets, ::testing::Range(0, 4));

/// Origins for a packet: near each other, before the scene.
std::array<Vec3, kPacket> origins_before(const Vec3& d, Random& random) {
    std::array<Vec3, kPacket> origins;
    const Vec3 from = random.point(-0.3, 0.3) - 2 * d;
    for (Vec3& origin : origins) {
        origin = test::rounded(from + random.point(-0.2, 0.2));
    }
    return origins;
}

TEST_P(Packets, MeetWhatSingleRaysMeet) {
    Random random(44);
    const RayCaster caster(test::random_soup(60, 0.15, random), cell(), Accelerator::embree);
    int hits = 0, differences = 0;
    for (int i = 0; i < 400; ++i) {
        Vec3 d = random.direction();
        d = test::rounded(normalized({d.x, d.y, -std::abs(d.z) - 0.1}));
        const auto origins = origins_before(d, random);
        Packet packet{};
        for (std::size_t k = 0; k < kPacket; ++k) {
            packet.set_origin(k, origins[k]);
            packet.set_direction(k, d);
        }
        const std::size_t count = 1 + random.below(kPacket);
        std::array<RayEnd, kPacket> ends{};
        caster.cast(packet, count, ends);
        for (std::size_t k = 0; k < count; ++k) {
            const CastHit single = caster.cast(origins[k], d, kNoTriangle);
            hits += single.end == RayEnd::hit ? 1 : 0;
            const bool same =
                ends[k] == single.end &&
                (single.end != RayEnd::hit || (packet.triangle[k] == single.hit.triangle &&
                                               std::abs(packet.t[k] - single.hit.t) < 1e-4F &&
                                               std::abs(packet.u[k] - single.hit.u) < 1e-3F &&
                                               packet.normal_z[k] == single.hit.normal[2]));
            differences += same ? 0 : 1;
        }
    }
    EXPECT_GT(hits, 500);
    EXPECT_LE(differences, 3);  // rays through a border
}

}  // namespace

}  // namespace quasimc

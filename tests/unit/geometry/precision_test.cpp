// Rounding: the rays of small leaves, of scenes in odd units and far from the origin.

#include <cmath>
#include <cstring>
#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "geometry/cast/ray_caster.h"
#include "geometry/shapes/shapes.h"
#include "geometry_testing.h"

namespace quasimc {

namespace {

using test::Random;

/// A leaf of two triangles that share an edge, bent along it by `fold` radians.
std::vector<Triangle> bent_leaf(const Vec3& center, const Frame& frame, double size, double fold) {
    const Vec3 half = 0.5 * size * frame.s;
    const Vec3 left = size * std::cos(fold) * frame.t + size * std::sin(fold) * frame.n;
    const Vec3 right = -size * frame.t;
    return {
        {center - half, center + half, center + left},
        {center + half, center - half, center + right}};
}

/// Leaves of `size` in the unit cube, every other one flat, the others bent by 20 degrees.
std::vector<Triangle> leaves(std::size_t count, double size, Random& random) {
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i < count; ++i) {
        const Frame frame = frame_about(normalized(random.direction()));
        const double fold = i % 2 == 0 ? 0 : std::numbers::pi / 9;
        for (const Triangle& t : bent_leaf(random.point(0, 1), frame, size, fold)) {
            triangles.push_back(t);
        }
    }
    return triangles;
}

struct ScatteredRay {
    std::uint32_t self = 0;
    Vec3 origin, direction;
};

ScatteredRay scattered_ray(const LocalMesh& mesh, Random& random) {
    const std::uint32_t self = random.below(mesh.triangle_count());
    const Vec3 origin = test::random_point_on(mesh, self, random);
    return {self, origin, normalized(random.direction())};
}

/// What the ray meets in double precision, whatever lies near its start but for the triangle
/// itself.
Hit exact_hit(const Intersector& oracle, const ScatteredRay& ray) {
    Ray rest{ray.origin, ray.direction, 1e-12F};
    Hit hit = oracle.closest(rest);
    while (hit.triangle == ray.self) {
        rest.near = std::nextafter(hit.t, 1.0F);
        hit = oracle.closest(rest);
    }
    return hit;
}

class Precision : public ::testing::Test {
  protected:
    static constexpr int kRays = 8000;

    /// The triangles, all moved and then resized.
    static std::vector<Triangle> moved(
        std::vector<Triangle> triangles, const Vec3& shift, double factor) {
        for (Triangle& t : triangles) {
            for (Vec3& corner : t) {
                corner = factor * (corner + shift);
            }
        }
        return triangles;
    }

    /// Whether the casters are made of the same bits and say the same of many rays.
    static ::testing::AssertionResult same_bits(const RayCaster& a, const RayCaster& b) {
        if (a.mesh().vertices != b.mesh().vertices) {
            return ::testing::AssertionFailure() << "the vertices differ";
        }
        Random random(31);
        for (int i = 0; i < kRays; ++i) {
            const ScatteredRay ray = scattered_ray(a.mesh(), random);
            const CastHit x = a.cast(ray.origin, ray.direction, ray.self);
            const CastHit y = b.cast(ray.origin, ray.direction, ray.self);
            if (x.end != y.end || std::memcmp(&x.hit, &y.hit, sizeof(Hit)) != 0) {
                return ::testing::AssertionFailure() << "ray " << i << " differs";
            }
        }
        return ::testing::AssertionSuccess();
    }
};

TEST_F(Precision, RaysScatteredByBentAndFlatLeavesMeetWhatTheyShould) {
    Random random(32);
    const RayCaster caster(leaves(1000, 0.005, random), Cell{}, Accelerator::embree);
    const auto oracle = make_brute_force_intersector(caster.mesh());
    int same = 0, self = 0, mate = 0;
    for (int i = 0; i < kRays; ++i) {
        const ScatteredRay ray = scattered_ray(caster.mesh(), random);
        const Hit expected = exact_hit(*oracle, ray);
        const Hit hit = caster.cast(ray.origin, ray.direction, ray.self).hit;
        same += hit.triangle == expected.triangle ? 1 : 0;
        self += hit.triangle == ray.self ? 1 : 0;
        // The other half of a flat leaf can't be seen.
        mate += hit.triangle == (ray.self ^ 1U) && ray.self % 4 < 2 ? 1 : 0;
    }
    EXPECT_GE(same, kRays - 1);
    EXPECT_EQ(self, 0);
    EXPECT_EQ(mate, 0);
}

TEST_F(Precision, WithoutCareHalfOfTheRaysMeetTheirOwnLeaf) {
    Random random(33);
    const LocalMesh mesh = make_local_mesh(leaves(500, 0.005, random));
    const auto embree = make_embree_intersector(mesh);
    int self = 0;
    for (int i = 0; i < kRays; ++i) {
        const ScatteredRay ray = scattered_ray(mesh, random);
        self += embree->closest({ray.origin, ray.direction}).triangle == ray.self ? 1 : 0;
    }
    EXPECT_GT(self, kRays / 4);
}

/// A triangle as long as the scene, its third corner next to the middle of the long side, and one
/// that makes the scene larger.
std::vector<Triangle> long_sliver() {
    return {
        Triangle{Vec3{-.4, .7, .1}, Vec3{.5, -.8, .1}, Vec3{.05, -.0501, .1}},
        Triangle{Vec3{-1, -1, -.9}, Vec3{1, -1, -1}, Vec3{0, 1, -1}}};
}

/// The distance of a hit point from the line of its ray.
double distance_from_ray(const RayCaster& caster, const Ray& ray, const Hit& hit) {
    const Vec3 point = caster.mesh().point(hit.triangle, hit.u, hit.v);
    return length(cross(point - ray.origin, ray.direction));
}

/// The hit point of the accelerator alone on a sliver may be wrong by 1e-4 of the scene.
TEST_F(Precision, RaysMeetLongSliversWhereTheyPassThem) {
    Random random(36);
    const RayCaster caster(long_sliver(), Cell{}, Accelerator::embree);
    const auto embree = make_embree_intersector(caster.mesh());
    double worst = 0;
    double worst_of_engine = 0;
    for (int i = 0; i < kRays; ++i) {
        const Vec3 aim = test::random_point_on(caster.mesh(), 0, random);
        Vec3 direction = normalized(random.direction());
        direction = normalized(Vec3{direction.x, direction.y, -std::abs(direction.z) - .2});
        const Ray ray{aim - .5 * direction, direction};
        const CastHit at = caster.cast(ray.origin, direction, kNoTriangle);
        if (at.end == RayEnd::hit && at.hit.triangle == 0) {
            worst = std::max(worst, distance_from_ray(caster, ray, at.hit));
            const Hit hit = embree->closest(ray);
            worst_of_engine = std::max(worst_of_engine, distance_from_ray(caster, ray, hit));
            EXPECT_TRUE(at.hit.u >= 0 && at.hit.v >= 0 && at.hit.u + at.hit.v <= 1 + 1e-6F);
        }
    }
    EXPECT_LT(worst, 5e-7);
    EXPECT_GT(worst_of_engine, 1e-5);  // what is avoided does happen
}

/// The same of packets, whose rays are kept in single precision.
TEST_F(Precision, PacketsMeetLongSliversWhereTheyPassThem) {
    Random random(37);
    const RayCaster caster(long_sliver(), Cell{}, Accelerator::embree);
    double worst = 0;
    int found = 0;
    for (int i = 0; i < kRays / 16; ++i) {
        Packet packet{};
        std::array<RayEnd, kPacket> ends{};
        for (std::size_t lane = 0; lane < kPacket; ++lane) {
            const Vec3 aim = test::random_point_on(caster.mesh(), 0, random);
            packet.set_direction(lane, normalized(Vec3{.3, .2, -1}));
            packet.set_origin(lane, aim - 2 * packet.direction(lane));
        }
        caster.cast(packet, kPacket, ends);
        for (std::size_t lane = 0; lane < kPacket; ++lane) {
            if (packet.triangle[lane] == 0) {
                ++found;
                const Ray ray{packet.origin(lane), packet.direction(lane)};
                worst = std::max(worst, distance_from_ray(caster, ray, packet.hit(lane)));
            }
        }
    }
    EXPECT_GT(found, kRays / 4);
    EXPECT_LT(worst, 5e-7);
}

TEST_F(Precision, AnOrganOfAHundredThousandthOfTheSceneDoesNotShadeItself) {
    Random random(34);
    auto triangles = bent_leaf({0.3, 0.4, 0.5}, frame_about(normalized(Vec3{1, 2, 3})), 1e-5, 0);
    for (const Triangle& far : make_parallelogram({-1, -1, -1}, {3, 0, 0}, {0, 0, 3})) {
        triangles.push_back(far);
    }
    const RayCaster caster(triangles, Cell{}, Accelerator::embree);
    const auto embree = make_embree_intersector(caster.mesh());
    int unaware = 0;
    for (int i = 0; i < 50000; ++i) {
        const std::uint32_t self = random.below(2);
        const Vec3 origin = test::random_point_on(caster.mesh(), self, random);
        const Vec3 d = normalized(random.direction());
        const std::uint32_t hit = caster.cast(origin, d, self).hit.triangle;
        EXPECT_TRUE(hit == kNoTriangle || hit > 1);
        EXPECT_EQ(caster.occluded(origin, d, self), hit != kNoTriangle);
        unaware += embree->closest({origin, d, 0x1p-22F}).triangle == 1 - self ? 1 : 0;
    }
    EXPECT_GT(unaware, 10);  // what is avoided does happen
}

RC_GTEST_PROP(RayCaster, GrazingRaysNeverMeetTheirOwnTriangle, ()) {
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    auto triangles = test::random_soup(1, 1, random);
    RC_PRE(area(triangles[0]) > 0.01);
    const Vec3 edge = normalized(triangles[0][1] - triangles[0][0]);
    const Vec3 normal = normalized(area_vector(triangles[0]));
    const RayCaster caster(triangles, Cell{}, Accelerator::embree);
    for (int i = 0; i < 100; ++i) {
        const double slope = std::pow(10.0, -random.between(0, 9));
        const Vec3 d = normalized(edge + (random.below(2) == 0 ? slope : -slope) * normal);
        const Vec3 origin = test::random_point_on(caster.mesh(), 0, random);
        RC_ASSERT(caster.cast(origin, d, 0).end == RayEnd::escaped);
        RC_ASSERT(!caster.occluded(origin, d, 0));
    }
}

TEST_F(Precision, ABendIsSeenFromVeryNear) {
    // From just beside the edge of a right angle, straight at its other side.
    const RayCaster caster(
        {{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}},
         {Vec3{0, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}},
        Cell{}, Accelerator::embree);
    for (const double distance : {1e-1, 1e-3, 1e-5, 2e-6}) {
        const Vec3 origin = caster.mesh().to_local({distance, 0.2, 0});
        const CastHit hit = caster.cast(origin, normalized(Vec3{-1, 0, 1e-3}), 0);
        EXPECT_EQ(hit.hit.triangle, 1U) << distance;
    }
}

TEST_F(Precision, UnitsThatArePowersOfTwoGiveTheSameBits) {
    Random random(35);
    const auto triangles = leaves(300, 0.02, random);
    const RayCaster meters(triangles, Cell{}, Accelerator::embree);
    for (const int exponent : {-40, -10, 10, 40}) {
        const double unit = std::ldexp(1.0, exponent);
        const RayCaster other(moved(triangles, {}, unit), Cell{}, Accelerator::embree);
        EXPECT_TRUE(same_bits(meters, other)) << exponent;
    }
}

TEST_F(Precision, APointOnTheMapGivesTheSameBits) {
    Random random(36);
    auto triangles = leaves(300, 0.02, random);
    for (Triangle& t : triangles) {
        for (Vec3& corner : t) {
            const auto exact = [](double x) { return std::round(x * 0x1p24) * 0x1p-24; };
            corner = {exact(corner.x), exact(corner.y), exact(corner.z)};  // so is the move
        }
    }
    const RayCaster here(triangles, Cell{}, Accelerator::embree);
    const RayCaster there(moved(triangles, {500000, 5400000, 300}, 1), Cell{}, Accelerator::embree);
    EXPECT_TRUE(same_bits(here, there));
}

TEST_F(Precision, ComparisonOfBitsNoticesTheLastOne) {
    Random random(37);
    auto triangles = leaves(300, 0.02, random);
    const RayCaster before(triangles, Cell{}, Accelerator::embree);
    triangles[7][0].x += 1e-7;
    EXPECT_FALSE(same_bits(before, RayCaster(triangles, Cell{}, Accelerator::embree)));
}

TEST_F(Precision, InMillimetersTheSameTrianglesAreMet) {
    Random random(38);
    const auto triangles = leaves(500, 0.02, random);
    const RayCaster meters(triangles, Cell{}, Accelerator::embree);
    const RayCaster other(
        moved(triangles, {500000.1, 3.3, 7.7}, 1000), Cell{}, Accelerator::embree);
    int differences = 0;
    for (int i = 0; i < kRays; ++i) {
        const ScatteredRay ray = scattered_ray(meters.mesh(), random);
        const Vec3 world = meters.mesh().origin + ray.origin / meters.mesh().scale;
        const Vec3 origin = other.mesh().to_local(1000 * (world + Vec3{500000.1, 3.3, 7.7}));
        const auto hit = meters.cast(ray.origin, ray.direction, ray.self).hit.triangle;
        differences += other.cast(origin, ray.direction, ray.self).hit.triangle != hit ? 1 : 0;
    }
    EXPECT_LE(differences, kRays / 2000);  // rays through a border
}

}  // namespace

}  // namespace quasimc

#include "geometry/cast/intersector.h"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include "geometry_testing.h"

namespace quasimc {

namespace {

using test::Random;

bool same_hit(const Hit& a, const Hit& b) {
    constexpr double kTolerance = 1e-5;
    return a.triangle == b.triangle &&
           (!a.found() || std::abs(a.t - b.t) < kTolerance * (1 + std::abs(b.t)));
}

/// What comes out of a comparison of two intersectors.
struct Comparison {
    int differences = 0;  ///< that rounding does not excuse
    int close_calls = 0;
    int hits = 0;
};

Ray random_ray(Random& random) {
    const Vec3 origin = test::rounded(random.point(-1.5, 1.5));
    const Vec3 target = random.point(-0.7, 0.7);
    Ray ray{origin, test::rounded(normalized(target - origin))};
    if (random.below(3) == 0) {
        ray.near = static_cast<float>(random.uniform());
        ray.far = ray.near + static_cast<float>(random.uniform());
    }
    return ray;
}

/// Compares closest hits along random rays. Rays through a border are left to chance only if they
/// differ.
Comparison compare(
    const Intersector& tested,
    const Intersector& oracle,
    const LocalMesh& mesh,
    int rays,
    Random& random) {
    Comparison result;
    for (int i = 0; i < rays; ++i) {
        const Ray ray = random_ray(random);
        const Hit hit = tested.closest(ray), expected = oracle.closest(ray);
        result.hits += expected.found() ? 1 : 0;
        if (!same_hit(hit, expected)) {
            const bool excused = test::is_close_call(mesh, ray);
            result.close_calls += excused ? 1 : 0;
            result.differences += excused ? 0 : 1;
        }
    }
    return result;
}

TEST(Embree, AgreesWithBruteForceOnRandomSoups) {
    Random random(11);
    for (const double size : {0.5, 0.1, 0.02}) {
        const LocalMesh mesh = make_local_mesh(test::random_soup(500, size, random));
        const auto embree = make_embree_intersector(mesh);
        const auto oracle = make_brute_force_intersector(mesh);
        constexpr int kRays = 15000;
        const Comparison result = compare(*embree, *oracle, mesh, kRays, random);
        EXPECT_EQ(result.differences, 0) << "size " << size;
        EXPECT_LT(result.close_calls, kRays / 1000) << "size " << size;
        EXPECT_GT(result.hits, kRays / 100) << "size " << size;
    }
}

TEST(Embree, ComparisonWithBruteForceNoticesAMissingTriangle) {
    Random random(12);
    auto soup = test::random_soup(200, 0.2, random);
    const LocalMesh mesh = make_local_mesh(soup);
    LocalMesh other = mesh;
    std::vector<float> numbers(mesh.vertices.begin(), mesh.vertices.end());
    for (std::size_t i = 9 * 100; i < 9 * 100 + 3; ++i) {  // one triangle loses its area
        numbers[i] = numbers[i + 3];
    }
    other.vertices = numbers;
    const auto embree = make_embree_intersector(other);
    const auto oracle = make_brute_force_intersector(mesh);
    EXPECT_GT(compare(*embree, *oracle, mesh, 5000, random).differences, 5);
}

RC_GTEST_PROP(Embree, MeetsATriangleWhereItIsAimedAt, ()) {
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const auto soup = test::random_soup(1, 1, random);
    const LocalMesh mesh = make_local_mesh(soup);
    const Vec3 target = mesh.point(0, 0.3, 0.3);
    const Vec3 origin = test::rounded(random.point(-3, 3));
    const Vec3 d = normalized(target - origin);
    RC_PRE(std::abs(dot(d, area_vector(soup[0]))) > 0.01 * length(area_vector(soup[0])));
    RC_PRE(area(soup[0]) > 0.01);
    for (const auto& engine : {make_embree_intersector(mesh), make_brute_force_intersector(mesh)}) {
        const Hit hit = engine->closest({origin, d});
        RC_ASSERT(hit.triangle == 0U);
        RC_ASSERT(length(mesh.point(0, hit.u, hit.v) - target) < 1e-4);
        RC_ASSERT(std::abs(hit.t - length(target - origin)) < 1e-4);
    }
}

TEST(Embree, GivesTheAreaVectorAsNormal) {
    Random random(13);
    const LocalMesh mesh = make_local_mesh(test::random_soup(50, 0.3, random));
    for (const auto& engine : {make_embree_intersector(mesh), make_brute_force_intersector(mesh)}) {
        int hits = 0;
        for (int i = 0; i < 2000; ++i) {
            const Hit hit = engine->closest(random_ray(random));
            if (!hit.found()) {
                continue;
            }
            ++hits;
            const Vec3 expected = area_vector(
                {mesh.vertex(hit.triangle, 0), mesh.vertex(hit.triangle, 1),
                 mesh.vertex(hit.triangle, 2)});
            const Vec3 normal{hit.normal[0], hit.normal[1], hit.normal[2]};
            EXPECT_LT(length(normal - expected), 1e-6);
        }
        EXPECT_GT(hits, 100);
    }
}

Packet packet_of(const std::array<Ray, kPacket>& rays) {
    Packet packet{};
    for (std::size_t i = 0; i < kPacket; ++i) {
        const Ray& ray = rays[i];
        packet.set_origin(i, ray.origin);
        packet.set_direction(i, ray.direction);
        packet.near[i] = ray.near;
        packet.far[i] = ray.far;
    }
    return packet;
}

TEST(Embree, PacketsMeetWhatSingleRaysMeet) {
    Random random(14);
    const LocalMesh mesh = make_local_mesh(test::random_soup(300, 0.2, random));
    const auto embree = make_embree_intersector(mesh);
    const auto oracle = make_brute_force_intersector(mesh);
    int hits = 0, close_calls = 0;
    for (int i = 0; i < 500; ++i) {
        std::array<Ray, kPacket> rays;
        const Vec3 d = random.direction(), from = random.point(-1, 1) - 3 * d;
        for (Ray& ray : rays) {
            ray = {test::rounded(from + random.point(-0.1, 0.1)), d};
        }
        Packet packet = packet_of(rays), same = packet;
        embree->closest(packet);
        oracle->closest(same);
        for (std::size_t k = 0; k < kPacket; ++k) {
            const Hit single = embree->closest(rays[k]);
            hits += single.found() ? 1 : 0;
            EXPECT_TRUE(same_hit(same.hit(k), oracle->closest(rays[k])));
            if (!same_hit(packet.hit(k), single) || !same_hit(single, same.hit(k))) {
                EXPECT_TRUE(test::is_close_call(mesh, rays[k]));
                ++close_calls;
            }
        }
    }
    EXPECT_GT(hits, 2000);
    EXPECT_LT(close_calls, 20);
}

TEST(Embree, IdleLanesOfAPacketMeetNothing) {
    const LocalMesh mesh = make_local_mesh({{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}});
    std::array<Ray, kPacket> rays;
    rays.fill({mesh.to_local({0.2, 0.2, 1}), {0, 0, -1}});
    for (std::size_t i = 1; i < kPacket; i += 2) {
        rays[i].far = -1;
    }
    for (const auto& engine : {make_embree_intersector(mesh), make_brute_force_intersector(mesh)}) {
        Packet packet = packet_of(rays);
        engine->closest(packet);
        for (std::size_t i = 0; i < kPacket; ++i) {
            EXPECT_EQ(packet.hit(i).found(), i % 2 == 0);
        }
    }
}

TEST(Embree, OcclusionIsThatThereIsAHitOnAnotherTriangle) {
    Random random(15);
    const LocalMesh mesh = make_local_mesh(test::random_soup(400, 0.15, random));
    const auto embree = make_embree_intersector(mesh);
    const auto oracle = make_brute_force_intersector(mesh);
    int occluded = 0, differences = 0;
    constexpr int kRays = 10000;
    for (int i = 0; i < kRays; ++i) {
        const std::uint32_t self = random.below(mesh.triangle_count());
        Ray ray{test::random_point_on(mesh, self, random), random.direction()};
        ray.near = 0x1p-22F;
        const bool expected = oracle->occluded(ray, self);
        occluded += expected ? 1 : 0;
        differences += embree->occluded(ray, self) != expected ? 1 : 0;
    }
    EXPECT_GT(occluded, kRays / 10);
    EXPECT_LT(occluded, kRays * 9 / 10);
    EXPECT_LE(differences, kRays / 5000);  // rays through a border
}

TEST(Embree, OcclusionLooksBehindTheExceptedTriangle) {
    const LocalMesh mesh = make_local_mesh(
        {{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}},
         {Vec3{0, 0, 1}, Vec3{1, 0, 1}, Vec3{0, 1, 1}}});
    const Ray up{mesh.to_local({0.2, 0.2, -1}), {0, 0, 1}};
    Ray short_ray = up;
    short_ray.far = static_cast<float>(1.5 * mesh.scale);
    for (const auto& engine : {make_embree_intersector(mesh), make_brute_force_intersector(mesh)}) {
        EXPECT_TRUE(engine->occluded(up, kNoTriangle));
        EXPECT_TRUE(engine->occluded(up, 0));
        EXPECT_TRUE(engine->occluded(short_ray, 1));
        EXPECT_FALSE(engine->occluded(short_ray, 0));
    }
}

TEST(Embree, HitsCountBeyondNearAndUpToFar) {
    const LocalMesh mesh = make_local_mesh(
        {{Vec3{-2, -2, 0}, Vec3{2, -2, 0}, Vec3{0, 2, 0}},
         {Vec3{-2, -2, 1}, Vec3{2, -2, 1}, Vec3{0, 2, 1}}});
    const auto distance = static_cast<float>(mesh.scale);
    Ray ray{mesh.to_local({0, 0, -1}), {0, 0, 1}};
    for (const auto& engine : {make_embree_intersector(mesh), make_brute_force_intersector(mesh)}) {
        ray.near = distance;
        ray.far = std::numeric_limits<float>::infinity();
        EXPECT_EQ(engine->closest(ray).triangle, 1U);
        ray.near = 0;
        ray.far = 0.999F * distance;
        EXPECT_FALSE(engine->closest(ray).found());
        EXPECT_FALSE(engine->occluded(ray, kNoTriangle));
    }
}

TEST(Embree, BuildsTheSameTreeEveryTime) {
    Random random(16);
    auto soup = test::random_soup(20000, 0.05, random);
    const auto twins = soup;
    soup.insert(soup.end(), twins.begin(), twins.end());  // every hit is a tie
    const LocalMesh mesh = make_local_mesh(soup);
    const auto first = make_embree_intersector(mesh), second = make_embree_intersector(mesh);
    for (int i = 0; i < 5000; ++i) {
        const Ray ray = random_ray(random);
        const Hit a = first->closest(ray), b = second->closest(ray);
        ASSERT_EQ(std::memcmp(&a, &b, sizeof(Hit)), 0);
    }
}

#if defined(__SSE__)
TEST(Embree, LeavesTheFloatingPointSettingsAlone) {
    const unsigned before = _mm_getcsr();
    const LocalMesh mesh = make_local_mesh({{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}});
    const auto embree = make_embree_intersector(mesh);
    EXPECT_TRUE(embree->closest({mesh.to_local({0.2, 0.2, 1}), {0, 0, -1}}).found());
    constexpr unsigned kSettings = 0xFFC0;  // without the flags of what has happened
    EXPECT_EQ(_mm_getcsr() & kSettings, before & kSettings);
}
#endif

}  // namespace

}  // namespace quasimc

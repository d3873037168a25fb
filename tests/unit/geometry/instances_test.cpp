#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "geometry/cast/ray_caster.h"
#include "geometry/mesh/outline.h"
#include "geometry/scene_geometry.h"
#include "geometry_testing.h"

namespace quasimc {

namespace {

using test::Random;

/// Turned at will, scaled from 0.05 to 0.5, mirrored at times, moved within the unit cube.
Affine random_transform(Random& random) {
    const Frame frame = frame_about(normalized(random.direction()));
    const double size = random.between(0.05, 0.5);
    const double mirror = random.below(2) == 0 ? 1 : -1;
    return {{size * frame.s, size * frame.t, mirror * size * frame.n}, random.point(0, 1)};
}

/// A few loose triangles, and copies of two meshes.
std::shared_ptr<const SceneGeometry> random_scene(std::size_t copies, Random& random) {
    const std::array meshes{
        std::make_shared<const Mesh>(test::random_soup(40, 0.3, random)),
        std::make_shared<const Mesh>(test::random_soup(25, 0.6, random))};
    std::vector<Instance> instances;
    for (std::size_t i = 0; i < copies; ++i) {
        instances.push_back({meshes[i % 2], random_transform(random)});
    }
    return std::make_shared<const SceneGeometry>(
        Mesh(test::random_soup(30, 0.2, random)), std::move(instances));
}

std::vector<Triangle> flat(const SceneGeometry& geometry) {
    return {geometry.begin(), geometry.end()};
}

TEST(Mesh, StoresACornerOfTheTriangleBeforeOnce) {
    const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{1, 1, 0}, d{0, 1, 0};
    const Mesh mesh(std::vector<Triangle>{{a, b, c}, {a, c, d}, {Vec3{5, 5, 5}, Vec3{6, 5, 5}, b}});
    EXPECT_EQ(mesh.vertices.size(), 7U);
    EXPECT_EQ(mesh.faces[1], (Face{0, 2, 3}));
    EXPECT_EQ(mesh[2][2], b);
}

TEST(Mesh, KeepsTheSignsOfZeros) {
    const Vec3 b{1, 0, 0}, c{1, 1, 0};
    const Mesh mesh(std::vector<Triangle>{{Vec3{0, 0, 0}, b, c}, {Vec3{-0.0, 0, 0}, b, c}});
    EXPECT_EQ(mesh.vertices.size(), 4U);
    EXPECT_TRUE(std::signbit(mesh[1][0].x));
}

TEST(Mesh, OrdersVerticesAsFacesNameThem) {
    const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{1, 1, 0}, d{0, 1, 0}, unused{9, 9, 9};
    Mesh mesh({a, unused, b, c, d}, {{4, 3, 0}, {3, 2, 0}});
    order_vertices(mesh);
    EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{d, c, a, b}));
    EXPECT_EQ(mesh.faces, (std::vector<Face>{{0, 1, 2}, {1, 3, 2}}));
}

RC_GTEST_PROP(RangeIndex, FindsTheRangeOfEveryNumber, ()) {
    const auto sizes = *rc::gen::nonEmpty(
        rc::gen::container<std::vector<std::uint32_t>>(rc::gen::inRange<std::uint32_t>(1, 40)));
    std::vector<std::uint32_t> first;
    std::uint32_t next = *rc::gen::inRange<std::uint32_t>(0, 1000);
    for (const std::uint32_t size : sizes) {
        first.push_back(next);
        next += size;
    }
    const RangeIndex index(first, next);
    for (std::size_t range = 0; range < sizes.size(); ++range) {
        RC_ASSERT(index.count(range) == sizes[range]);
        for (std::uint32_t i = 0; i < sizes[range]; ++i) {
            RC_ASSERT(index.find(first[range] + i) == range);
        }
    }
}

TEST(RangeIndex, FindsRangesOfVeryDifferentSizes) {
    const RangeIndex index({7, 8, 9, 4000000000U, 4000000001U}, 4000000002U);
    EXPECT_EQ(index.find(7), 0U);
    EXPECT_EQ(index.find(9), 2U);
    EXPECT_EQ(index.find(3999999999U), 2U);
    EXPECT_EQ(index.find(4000000000U), 3U);
    EXPECT_EQ(index.find(4000000001U), 4U);
}

TEST(SceneGeometry, CountsTheTrianglesOfInstancesAfterItsOwn) {
    Random random(1);
    const auto scene = random_scene(3, random);
    ASSERT_EQ(scene->size(), 30U + 40 + 25 + 40);
    const Instance& last = scene->instances()[2];
    EXPECT_EQ((*scene)[29], scene->mesh()[29]);
    EXPECT_EQ((*scene)[95 + 7], last.triangle(7));
    EXPECT_EQ((*scene)[95 + 7][1], last.transform.point((*last.mesh)[7][1]));
}

TEST(SceneGeometry, BoundsHoldEveryCorner) {
    Random random(2);
    const auto scene = random_scene(12, random);
    Bounds expected;
    for (const Triangle& t : flat(*scene)) {
        for (const Vec3& corner : t) {
            expected.add(corner);
        }
    }
    const Bounds bounds = bounds_of(*scene);
    EXPECT_LT(length(bounds.low - expected.low), 1e-14);
    EXPECT_LT(length(bounds.high - expected.high), 1e-14);
}

TEST(LocalMesh, PlacesInstancesToSinglePrecision) {
    Random random(3);
    const auto scene = random_scene(10, random);
    const LocalMesh mesh = make_local_mesh(scene);
    const LocalMesh flattened = make_local_mesh(flat(*scene));
    ASSERT_EQ(mesh.triangle_count(), flattened.triangle_count());
    double worst = 0;
    for (std::uint32_t i = 0; i < mesh.triangle_count(); ++i) {
        for (int corner = 0; corner < 3; ++corner) {
            const Vec3 there = flattened.to_world(flattened.vertex(i, corner));
            worst = std::max(worst, length(mesh.to_world(mesh.vertex(i, corner)) - there));
        }
    }
    EXPECT_LT(worst * mesh.scale, 0x1p-21);
    EXPECT_GT(worst, 0);
}

TEST(LocalMesh, BoundsOfInstancesAreThoseOfTheirCorners) {
    Random random(4);
    const LocalMesh mesh = make_local_mesh(random_scene(10, random));
    Bounds expected;
    for (std::uint32_t i = 0; i < mesh.triangle_count(); ++i) {
        for (int corner = 0; corner < 3; ++corner) {
            expected.add(mesh.vertex(i, corner));
        }
    }
    EXPECT_EQ(mesh.bounds.low, expected.low);
    EXPECT_EQ(mesh.bounds.high, expected.high);
}

TEST(OutlinePoints, OfInstancesReachAsFarAsTheirCorners) {
    Random random(5);
    const LocalMesh mesh = make_local_mesh(random_scene(10, random));
    const std::vector<Vec3> outline = outline_points(mesh);
    for (int k = 0; k < 100; ++k) {
        const Vec3 d = random.direction();
        double of_outline = -2, of_corners = -2;
        for (const Vec3& p : outline) {
            of_outline = std::max(of_outline, dot(d, p));
        }
        for (std::uint32_t i = 0; i < mesh.triangle_count(); ++i) {
            for (int corner = 0; corner < 3; ++corner) {
                of_corners = std::max(of_corners, dot(d, mesh.vertex(i, corner)));
            }
        }
        EXPECT_EQ(of_outline, of_corners);
    }
}

/// Rays from far and near, alone and in packets: how often two engines differ without being excused
/// by rounding.
struct CopyComparison {
    int hits = 0, instance_hits = 0, differences = 0, close_calls = 0;

    void add(const LocalMesh& mesh, const Ray& ray, const Hit& hit, const Hit& expected) {
        hits += expected.found() ? 1 : 0;
        instance_hits += expected.found() && expected.triangle >= mesh.faces.size() ? 1 : 0;
        const auto to_vector = [](const Hit& h) {
            return Vec3{h.normal[0], h.normal[1], h.normal[2]};
        };
        const bool same = hit.triangle == expected.triangle &&
                          (!hit.found() || (std::abs(hit.t - expected.t) < 2e-5 &&
                                            length(to_vector(hit) - to_vector(expected)) <
                                                1e-5 * length(to_vector(expected)) + 1e-7));
        if (!same) {
            (test::is_close_call(mesh, ray) ? close_calls : differences) += 1;
        }
    }
};

Ray random_ray_at_copies(Random& random) {
    const Vec3 origin = test::rounded(random.point(-1.5, 1.5));
    return {origin, test::rounded(normalized(random.point(-0.7, 0.7) - origin))};
}

TEST(Instances, EmbreeAgreesWithBruteForceOnSingleRays) {
    Random random(6);
    const LocalMesh mesh = make_local_mesh(random_scene(20, random));
    const auto embree = make_embree_intersector(mesh);
    const auto oracle = make_brute_force_intersector(mesh);
    constexpr int kRays = 20000;
    CopyComparison comparison;
    for (int i = 0; i < kRays; ++i) {
        const Ray ray = random_ray_at_copies(random);
        comparison.add(mesh, ray, embree->closest(ray), oracle->closest(ray));
    }
    EXPECT_EQ(comparison.differences, 0);
    EXPECT_LT(comparison.close_calls, kRays / 200);
    EXPECT_GT(comparison.instance_hits, kRays / 5);
    EXPECT_GT(comparison.hits - comparison.instance_hits, kRays / 100);
}

TEST(Instances, TheComparisonNoticesACopyThatIsElsewhere) {
    Random random(7);
    const LocalMesh mesh = make_local_mesh(random_scene(20, random));
    LocalMesh moved = mesh;
    moved.instances[3].matrix[9] += 0.01F;
    const auto embree = make_embree_intersector(moved);
    const auto oracle = make_brute_force_intersector(mesh);
    CopyComparison comparison;
    for (int i = 0; i < 5000; ++i) {
        const Ray ray = random_ray_at_copies(random);
        comparison.add(mesh, ray, embree->closest(ray), oracle->closest(ray));
    }
    EXPECT_GT(comparison.differences, 5);
}

TEST(Instances, PacketsMeetWhatSingleRaysMeet) {
    Random random(8);
    const LocalMesh mesh = make_local_mesh(random_scene(20, random));
    const auto embree = make_embree_intersector(mesh);
    const auto oracle = make_brute_force_intersector(mesh);
    CopyComparison comparison;
    for (int k = 0; k < 300; ++k) {
        Packet packet{};
        const Vec3 d = test::rounded(random.direction());
        const Vec3 from = test::rounded(-1.5 * d);
        for (std::size_t i = 0; i < kPacket; ++i) {
            const Vec3 p = test::rounded(from + random.point(-0.5, 0.5));
            packet.set_origin(i, p);
            packet.set_direction(i, d);
            packet.near[i] = 0;
            packet.far[i] = i < 12 ? INFINITY : -1;  // four are idle
        }
        embree->closest(packet);
        for (std::size_t i = 0; i < 12; ++i) {
            const Ray ray{packet.origin(i), d};
            comparison.add(mesh, ray, packet.hit(i), oracle->closest(ray));
        }
        for (std::size_t i = 12; i < kPacket; ++i) {
            EXPECT_EQ(packet.triangle[i], kNoTriangle);
        }
    }
    EXPECT_EQ(comparison.differences, 0);
    EXPECT_GT(comparison.instance_hits, 500);
}

TEST(Instances, RaysThatLeaveTheirTrianglesMeetWhatTheOracleMeets) {
    Random random(9);
    const auto scene = random_scene(20, random);
    const RayCaster embree(scene, Cell{}, Accelerator::embree);
    const RayCaster oracle(scene, Cell{}, Accelerator::brute_force);
    int hits = 0, differences = 0, self_hits = 0, blocked = 0;
    constexpr int kRays = 20000;
    for (int i = 0; i < kRays; ++i) {
        const std::uint32_t self = random.below(embree.mesh().triangle_count());
        const Vec3 origin = test::random_point_on(embree.mesh(), self, random);
        const Vec3 d = normalized(random.direction());
        const CastHit a = embree.cast(origin, d, self), b = oracle.cast(origin, d, self);
        hits += a.end == RayEnd::hit ? 1 : 0;
        self_hits += a.hit.triangle == self ? 1 : 0;
        differences += a.hit.triangle != b.hit.triangle ? 1 : 0;
        blocked += embree.occluded(origin, d, self) != (a.end == RayEnd::hit) ? 1 : 0;
    }
    EXPECT_EQ(self_hits, 0);
    EXPECT_GT(hits, kRays / 4);
    EXPECT_LE(differences, kRays / 2000);  // rays through a border
    EXPECT_LE(blocked, kRays / 2000);
}

/// Copies of a hundredth of the scene, as plants of a large stand have.
TEST(Instances, SmallCopiesFarFromTheMiddleKeepTheirLightApart) {
    Random random(10);
    const auto plant = std::make_shared<const Mesh>(test::random_soup(60, 0.1, random));
    std::vector<Instance> instances;
    for (int i = 0; i < 100; ++i) {
        Affine a = random_transform(random);
        a.shift = random.point(0, 10);
        instances.push_back({plant, a});
    }
    const auto scene = std::make_shared<const SceneGeometry>(Mesh(), std::move(instances));
    const RayCaster embree(scene, Cell{}, Accelerator::embree);
    const RayCaster oracle(scene, Cell{}, Accelerator::brute_force);
    const RayCaster flattened(flat(*scene), Cell{}, Accelerator::embree);
    int self_hits = 0, differences = 0, flat_differences = 0, hits = 0;
    constexpr int kRays = 4000;
    for (int i = 0; i < kRays; ++i) {
        const std::uint32_t self = random.below(embree.mesh().triangle_count());
        const Vec3 origin = test::random_point_on(embree.mesh(), self, random);
        const Vec3 d = normalized(random.direction());
        const CastHit hit = embree.cast(origin, d, self);
        const std::uint32_t expected = oracle.cast(origin, d, self).hit.triangle;
        hits += hit.hit.found() ? 1 : 0;
        self_hits += hit.hit.triangle == self ? 1 : 0;
        differences += hit.hit.triangle != expected ? 1 : 0;
        flat_differences += flattened.cast(origin, d, self).hit.triangle != expected ? 1 : 0;
    }
    EXPECT_EQ(self_hits, 0);
    EXPECT_GT(hits, kRays / 20);
    // No worse than the same triangles without instances.
    EXPECT_LE(differences, flat_differences + kRays / 200);
}

TEST(Instances, InAPeriodicSceneMeetWhatTheFlattenedSceneMeets) {
    Random random(11);
    const auto plant = std::make_shared<const Mesh>(test::random_soup(40, 0.2, random));
    std::vector<Instance> instances;
    for (int i = 0; i < 30; ++i) {
        Affine a = random_transform(random);
        a.shift = random.point(-2, 3);  // in all cells, over some borders
        instances.push_back({plant, a});
    }
    const auto scene = std::make_shared<const SceneGeometry>(
        Mesh(test::random_soup(30, 0.2, random)), std::move(instances));
    const Cell cell{true, true, 0, 0, 1.5, 1.2};
    const RayCaster caster(scene, cell, Accelerator::embree);
    const RayCaster flattened(flat(*scene), cell, Accelerator::embree);
    ASSERT_GT(caster.mesh().instances.size(), 3U);
    ASSERT_LT(caster.mesh().instances.size(), 30U);
    int hits = 0, differences = 0;
    constexpr int kRays = 4000;
    for (int i = 0; i < kRays; ++i) {
        const Vec3 world = random.point(0, 1) + Vec3{0, 0, 5};
        const Vec3 d = normalized(random.direction() - Vec3{0, 0, 1.2});
        const CastHit a = caster.cast(caster.mesh().to_local(world), d, kNoTriangle);
        const CastHit b = flattened.cast(flattened.mesh().to_local(world), d, kNoTriangle);
        hits += a.end == RayEnd::hit ? 1 : 0;
        const bool same =
            a.end == b.end && (a.end != RayEnd::hit ||
                               caster.source(a.hit.triangle) == flattened.source(b.hit.triangle));
        differences += same ? 0 : 1;
    }
    EXPECT_GT(hits, kRays / 4);
    EXPECT_LE(differences, kRays / 500);  // rays through a border
}

}  // namespace

}  // namespace quasimc

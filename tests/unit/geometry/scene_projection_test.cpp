#include "raster/scene_projection.h"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "geometry/cast/ray_caster.h"
#include "geometry/shapes/shapes.h"
#include "geometry_testing.h"

namespace quasimc {

namespace {

using test::Random;
using test::reach;
using test::vertices;

const std::vector<Vec3> beams{
    {0, 0, -1},
    {0, 0, 1},
    {1, 0, 0},
    {0, -1, 0},
    normalized(Vec3{0.3, 0.2, -1}),
    normalized(Vec3{-1, 0.1, -0.2}),
    normalized(Vec3{0.1, 1, 0.05})};

/// The points of a window for a lattice of n points.
std::vector<Vec3> lattice_points(const BeamCrossSection& window, int n) {
    std::vector<Vec3> points;
    for (int i = 0; i < n; ++i) {
        points.push_back(window.point((i + 0.5) / n, std::fmod(i * 0.6180339887498949 + 0.3, 1.0)));
    }
    return points;
}

/// The area of the scene seen along a beam, by the fraction of the window's rays that meet it;
/// square local units.
double seen_area(const BeamCrossSection& window, const RayCaster& caster, const Vec3& d, int rays) {
    int hits = 0;
    for (const Vec3& p : lattice_points(window, rays)) {
        hits += caster.cast(p, d, kNoTriangle).end == RayEnd::hit ? 1 : 0;
    }
    return window.area() * hits / rays;
}

bool is_outside(const Bounds& box, const Vec3& p) {
    return p.x < box.low.x || p.x > box.high.x || p.y < box.low.y || p.y > box.high.y ||
           p.z < box.low.z || p.z > box.high.z;
}

Bounds mesh_bounds(const LocalMesh& mesh) {
    Bounds bounds;
    for (const Vec3& p : vertices(mesh)) {
        bounds.add(p);
    }
    return bounds;
}

class OpenWindow : public ::testing::TestWithParam<StartArea> {};

INSTANTIATE_TEST_SUITE_P(
    Shapes,
    OpenWindow,
    ::testing::Values(StartArea::silhouette, StartArea::bounding_sphere),
    [](const auto& tested) {
        return tested.param == StartArea::silhouette ? "Silhouette" : "Sphere";
    });

TEST_P(OpenWindow, ShowsABallAsADisc) {
    const RayCaster caster(make_sphere({5, 6, 7}, 0.5, 5), Cell{}, Accelerator::embree);
    const SceneProjection projection(caster.mesh(), Cell{}, GetParam());
    const double expected = std::numbers::pi * 0.25;
    for (const Vec3& d : beams) {
        const auto window = projection.cross_section(d);
        EXPECT_GE(window->area(), 0.999 * expected / projection.world_area());
        const double seen = seen_area(*window, caster, d, 20000) * projection.world_area();
        EXPECT_NEAR(seen, expected, 2e-3);
    }
}

TEST_P(OpenWindow, ShowsAPlateAsItsProjection) {
    const RayCaster caster(
        make_parallelogram({0, 0, 0}, {1, 0, 0}, {0.5, 1.5, 0}), Cell{}, Accelerator::embree);
    const SceneProjection projection(caster.mesh(), Cell{}, GetParam());
    for (const Vec3& d : beams) {
        const auto window = projection.cross_section(d);
        const double seen = seen_area(*window, caster, d, 20000) * projection.world_area();
        EXPECT_NEAR(seen, 1.5 * std::abs(d.z), 0.03);
    }
}

/// Points along the border of a window.
std::vector<Vec3> border_points(const BeamCrossSection& window) {
    std::vector<Vec3> points;
    constexpr int kSteps = 4000;
    for (int i = 0; i <= kSteps; ++i) {
        const double u = static_cast<double>(i) / kSteps;
        points.push_back(window.point(u, 0));
        points.push_back(window.point(u, 1));
        points.push_back(window.point(0, u));
        points.push_back(window.point(1, u));
    }
    return points;
}

TEST_P(OpenWindow, NoRayThatMeetsTheScenePassesBesideIt) {
    Random random(81);
    const LocalMesh mesh = make_local_mesh(test::random_soup(200, 0.3, random));
    const SceneProjection projection(mesh, Cell{}, GetParam());
    const std::vector<Vec3> scene = vertices(mesh);
    for (const Vec3& d : beams) {
        const std::vector<Vec3> border = border_points(*projection.cross_section(d));
        const Frame frame = frame_about(-d);
        for (int k = 0; k < 64; ++k) {
            const double angle = 2 * std::numbers::pi * k / 64;
            const Vec3 across = std::cos(angle) * frame.s + std::sin(angle) * frame.t;
            EXPECT_GT(reach(border, across), reach(scene, across) - 1e-3);  // it has steps
        }
    }
}

TEST_P(OpenWindow, PointsLieBeforeTheScene) {
    Random random(82);
    const LocalMesh mesh = make_local_mesh(test::random_soup(50, 0.3, random));
    const SceneProjection projection(mesh, Cell{}, GetParam());
    for (const Vec3& d : beams) {
        const double nearest = -reach(vertices(mesh), -d);
        for (const Vec3& p : lattice_points(*projection.cross_section(d), 1000)) {
            EXPECT_LT(dot(p, d), nearest);
            EXPECT_LT(length(p), 3);
        }
    }
}

TEST_P(OpenWindow, SeveralPointsAtOnceAreThoseOneByOne) {
    Random random(83);
    const LocalMesh mesh = make_local_mesh(test::random_soup(50, 0.3, random));
    const auto window = SceneProjection(mesh, Cell{}, GetParam()).cross_section(beams[4]);
    std::array<double, 100> u0{}, u1{};
    std::array<Vec3, 100> points{};
    for (std::size_t i = 0; i < 100; ++i) {
        u0[i] = random.uniform();
        u1[i] = random.uniform();
    }
    window->points(u0, u1, points);
    for (std::size_t i = 0; i < 100; ++i) {
        EXPECT_EQ(points[i], window->point(u0[i], u1[i]));
    }
}

TEST(SilhouetteCrossSection, MissesFewRaysOfAConvexBody) {
    const RayCaster caster(make_sphere({}, 1, 5), Cell{}, Accelerator::embree);
    const SceneProjection projection(caster.mesh(), Cell{}, StartArea::silhouette);
    const auto window = projection.cross_section(beams[4]);
    EXPECT_GT(seen_area(*window, caster, beams[4], 10000), 0.998 * window->area());
}

TEST(SilhouetteCrossSection, OfASceneSeenEdgeOnHasNoArea) {
    const LocalMesh plate = make_local_mesh(make_parallelogram({3, 3, 3}, {1, 0, 0}, {0, 1, 0}));
    const SceneProjection projection(plate, Cell{}, StartArea::silhouette);
    for (const Vec3& d : {Vec3{1, 0, 0}, normalized(Vec3{0.3, 0.7, 0})}) {
        const auto window = projection.cross_section(d);
        ASSERT_NE(window, nullptr);
        EXPECT_EQ(window->area(), 0);
        EXPECT_LT(length(window->point(0.3, 0.7)), 3);
    }
}

TEST(SilhouetteCrossSection, OfABeamAlongAnAxisRunsAlongTheOthers) {
    const LocalMesh plate = make_local_mesh(make_parallelogram({0, 0, 0}, {2, 0, 0}, {0, 2, 0}));
    const auto window =
        SceneProjection(plate, Cell{}, StartArea::silhouette).cross_section({0, 0, -1});
    EXPECT_NEAR(window->area(), 4, 1e-5);
    EXPECT_NEAR(window->point(0.25, 0.75).x, -0.5, 1e-5);
    EXPECT_NEAR(window->point(0.25, 0.75).y, 0.5, 1e-5);
}

TEST(SphereWindow, IsTheDiscAcrossTheBoundingSphere) {
    const LocalMesh plate = make_local_mesh(make_parallelogram({0, 0, 0}, {2, 0, 0}, {0, 2, 0}));
    const auto window =
        SceneProjection(plate, Cell{}, StartArea::bounding_sphere).cross_section(beams[4]);
    EXPECT_NEAR(window->area(), 2 * std::numbers::pi, 1e-4);
    // Rings of equal area hold equal numbers of points.
    std::array<int, 4> ring{};
    const Vec3 center = window->point(0.5, 0.5);
    for (const Vec3& p : lattice_points(*window, 40000)) {
        const Vec3 from = p - center;
        EXPECT_NEAR(dot(from, beams[4]), 0, 1e-12);
        ++ring[static_cast<std::size_t>(std::min(3.0, 4 * dot(from, from) / 2.00001))];
    }
    for (const int count : ring) {
        EXPECT_NEAR(count, 10000, 50);
    }
}

/// A plate that fills the cell of a layer or a row is seen as a plane or an infinite strip, in
/// closed form.
struct Periodic {
    Cell cell;
    double (*expected)(const Vec3& d);
};

TEST(PeriodicWindow, ShowsAPlateThatFillsTheCellAsAPlaneOrAStrip) {
    const std::array<Periodic, 3> kinds{{
        {{true, true, 0, 0, 1, 1}, [](const Vec3& d) { return std::abs(d.z); }},
        {{true, false, 0, 0, 1, 1}, [](const Vec3& d) { return std::abs(d.z); }},
        {{false, true, 0, 0, 1, 1}, [](const Vec3& d) { return std::abs(d.z); }},
    }};
    // With a pole, so that the scene is as high as wide.
    auto triangles = make_parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    triangles.push_back({Vec3{0.5, 0.5, 0}, Vec3{0.5, 0.5, 1}, Vec3{0.5, 0.5 + 1e-9, 1}});
    for (const Periodic& kind : kinds) {
        const RayCaster caster(triangles, kind.cell, Accelerator::embree);
        const SceneProjection projection(caster.mesh(), kind.cell, StartArea::silhouette);
        for (const Vec3& d : beams) {
            const auto window = projection.cross_section(d);
            if (window == nullptr) {
                continue;
            }
            const double seen = seen_area(*window, caster, d, 20000) * projection.world_area();
            EXPECT_NEAR(seen, kind.expected(d), 2e-3 * window->area() * projection.world_area());
        }
    }
}

TEST(PeriodicWindow, RaysSeeABallInEveryCell) {
    // Balls far enough apart not to hide each other: one disc per cell, whatever is periodic.
    const auto ball = make_sphere({0.5, 0.5, 0.5}, 0.1, 4);
    for (int axes = 1; axes < 4; ++axes) {
        const Cell cell{(axes & 1) != 0, (axes & 2) != 0, -0.3, -0.2, 2, 2};
        const RayCaster caster(ball, cell, Accelerator::embree);
        const SceneProjection projection(caster.mesh(), cell, StartArea::silhouette);
        for (const Vec3& d : {normalized(Vec3{0.3, 0.2, -1}), normalized(Vec3{0.5, -0.6, 0.7})}) {
            const auto window = projection.cross_section(d);
            const double seen = seen_area(*window, caster, d, 200000) * projection.world_area();
            EXPECT_NEAR(seen, std::numbers::pi * 0.01, 1e-3);
        }
    }
}

TEST(PeriodicWindow, IsNoneForBeamsThatNeverMeetTheScene) {
    const LocalMesh mesh = make_local_mesh(make_sphere({0.5, 0.5, 0.5}, 0.1, 1));
    const auto window = [&](const Cell& cell, const Vec3& d) {
        return SceneProjection(mesh, cell, StartArea::silhouette).cross_section(d);
    };
    EXPECT_EQ(window({true, true, 0, 0, 1, 1}, {1, 0, 0}), nullptr);
    EXPECT_EQ(window({true, true, 0, 0, 1, 1}, {0.6, 0.8, 1e-17}), nullptr);
    EXPECT_NE(window({true, true, 0, 0, 1, 1}, {0, 0, 1}), nullptr);
    EXPECT_EQ(window({true, false, 0, 0, 1, 1}, {-1, 0, 0}), nullptr);
    EXPECT_NE(window({true, false, 0, 0, 1, 1}, {0, 1, 0}), nullptr);
    EXPECT_EQ(window({false, true, 0, 0, 1, 1}, {0, 1, 0}), nullptr);
    EXPECT_NE(window({false, true, 0, 0, 1, 1}, {1, 0, 0}), nullptr);
    EXPECT_NE(window({}, {1, 0, 0}), nullptr);
}

TEST(PeriodicWindow, NothingLiesBeforeItsPoints) {
    Random random(84);
    for (int axes = 1; axes < 4; ++axes) {
        const Cell cell{(axes & 1) != 0, (axes & 2) != 0, 0, 0, 1, 1};
        const RayCaster caster(test::random_soup(20, 0.2, random), cell, Accelerator::brute_force);
        const SceneProjection projection(caster.mesh(), cell, StartArea::silhouette);
        for (const Vec3& d : beams) {
            const auto window = projection.cross_section(d);
            const auto points =
                window == nullptr ? std::vector<Vec3>{} : lattice_points(*window, 200);
            for (const Vec3& p : points) {
                EXPECT_LT(length(p), 10);
                EXPECT_EQ(caster.cast(p, -d, kNoTriangle).end, RayEnd::escaped);
            }
        }
    }
}

TEST(EntryBox, HoldsTheSceneAndKnowsItsFaces) {
    Random random(85);
    const LocalMesh mesh = make_local_mesh(test::random_soup(50, 0.3, random));
    const EntryBox box = SceneProjection(mesh, Cell{}, StartArea::silhouette).entry_box();
    const Bounds scene = mesh_bounds(mesh);
    EXPECT_TRUE(is_outside(scene, box.bounds.low) && is_outside(scene, box.bounds.high));
    const Vec3 size = box.bounds.size();
    EXPECT_LT(length(size - scene.size()), 1e-5);
    EXPECT_EQ(box.face_area, (Vec3{size.y * size.z, size.x * size.z, size.x * size.y}));
    EXPECT_DOUBLE_EQ(box.projected_area({0, 0, -1}), size.x * size.y);
    EXPECT_DOUBLE_EQ(
        box.projected_area({0.6, 0, -0.8}), 0.6 * size.y * size.z + 0.8 * size.x * size.y);
}

TEST(EntryBox, HasNoFacesAcrossPeriodicAxes) {
    Random random(86);
    const Cell cell{true, true, 1, 2, 3, 4};
    const RayCaster caster(test::random_soup(50, 0.3, random), cell, Accelerator::brute_force);
    const LocalMesh& mesh = caster.mesh();
    const EntryBox box = SceneProjection(mesh, cell, StartArea::silhouette).entry_box();
    EXPECT_EQ(box.face_area.x, 0);
    EXPECT_EQ(box.face_area.y, 0);
    EXPECT_NEAR(box.face_area.z, 12 * mesh.scale * mesh.scale, 1e-12);
    EXPECT_LT(
        length(
            box.bounds.low - mesh.to_local({1, 2, box.bounds.low.z / mesh.scale + mesh.origin.z})),
        1e-12);
    const Cell row{true, false, 1, 2, 3, 4};
    const EntryBox row_box = SceneProjection(mesh, row, StartArea::silhouette).entry_box();
    EXPECT_EQ(row_box.face_area.x, 0);
    EXPECT_GT(row_box.face_area.y, 0);
    EXPECT_GT(row_box.face_area.z, 0);
}

}  // namespace

}  // namespace quasimc

// Closed bodies: spheres, and the light on convex organs.

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "geometry/shapes/shapes.h"
#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

class Solids : public BothWays {};

TEST_P(Solids, ASphereInABeamReceivesAQuarterOfItOnAverage) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("sphere", "black", make_sphere({0, 0, 0}, 1, 5)));
    const Scene scene = std::move(builder).build();
    const Result result = trace(scene, {sun(30, {1})}, 1 << 15);
    EXPECT_TRUE(holds(
        {"sphere in a beam, mean over its surface", .25, 1e-3},
        result.at(0, Quantity::incident_upper, 0)));
    // No light gets inside, except rays within a rounding error of an edge
    // (docs/theory/geometry.md).
    EXPECT_LT(result.at(0, Quantity::incident_lower, 0).mean, 1e-6);
}

/// Half of the sky's light, averaged over the whole outside of a convex body, or over both sides of
/// a leaf, in any orientation (Cauchy 1841).
TEST_P(Solids, AConvexOrganReceivesHalfOfTheSkyOnAverage) {
    struct Shape {
        std::string words;
        std::vector<Triangle> triangles;
        bool flat;
    };
    const Vec3 axis = normalized({.3, -.5, .7});
    const std::vector<Shape> shapes{
        {"leaf", make_triangle({0, 0, 0}, {1, .2, .4}, {-.3, .9, .1}), true},
        {"upright leaf", make_triangle({0, 0, 0}, {1, .2, 0}, {.3, .1, 1}), true},
        {"rhombus", make_rhombus({0, 0, 0}, {1, 0, .5}, {-.5, 0, 1}, .4), true},
        {"disk", make_disk({0, 0, 0}, axis, 1, 32), true},
        {"sphere", make_sphere({0, 0, 0}, 1, 3), false},
        {"cylinder", make_cylinder({0, 0, 0}, 2 * axis, .2, .2, 24, true), false},
        {"cone", make_cylinder({0, 0, 0}, axis, .5, 0, 24, true), false},
    };
    const auto family = static_cast<unsigned>(shapes.size());
    for (const Shape& shape : shapes) {
        SceneBuilder builder = make_builder();
        builder.add_material(diffuse("black", 0, 0));
        builder.add_organ(organ("organ", "black", shape.triangles));
        const Scene scene = std::move(builder).build();
        const Result result = trace(scene, {sky({1})}, from_sources() ? 1 << 15 : 1 << 13);
        // All light on the organ, both sides of it, is direct.
        EXPECT_TRUE(holds(
            {"convex organ under a uniform sky, " + shape.words, shape.flat ? 1 : .5, 5e-3, family},
            result.at(0, Quantity::incident_direct, 0)));
    }
}

/// A sphere that transmits light inwards at every point and reflects it inside: the first bounce
/// and all later ones deliver 1/(1 - rho) times the light of the first.
Scene make_integrating_sphere(double rho) {
    SceneBuilder builder = make_builder();
    const SideOptics outside{.transmittance = 1, .transmission_model = "mirror"};
    const SideOptics inside{.reflectance = rho};
    builder.add_material({"one-way", {outside}, {inside}});
    builder.add_organ(organ("sphere", "one-way", make_sphere({0, 0, 0}, 1, 2)));
    return std::move(builder).build();
}

/// The number of paths; fewer for more bounces.
std::uint64_t paths_for(double rho) {
    return rho > .9 ? 1U << 10U : 1U << 11U;
}

TEST_P(Solids, AnIntegratingSphereMultipliesTheLightOfTheSunByOneOverOneLessRho) {
    for (const double rho : {.5, .8, .98}) {
        const Result result = trace(make_integrating_sphere(rho), {sun(20, {1})}, paths_for(rho));
        const double first = result.at(0, Quantity::incident_upper, 0).mean;
        const Estimate& inside = result.at(0, Quantity::incident_lower, 0);
        const double gain = 1 / (1 - rho);
        EXPECT_TRUE(holds(
            {fmt::format("integrating sphere, sun, rho {}", rho), gain, .05 * gain, 3},
            Measured{inside.mean / first, inside.standard_error / first, kReplicates}));
    }
}

TEST_P(Solids, AnIntegratingSphereMultipliesTheLightOfTheSkyByOneOverOneLessRho) {
    // Backwards, a path grows by 1 + rho at every bounce: beyond rho = 0.618 its variance is
    // infinite. No such sheet exists in nature.
    for (const double rho : {.5, .8, .98}) {
        if (rho > .5 && !from_sources()) {
            continue;
        }
        const Result result = trace(make_integrating_sphere(rho), {sky({1})}, paths_for(rho));
        const double gain = 1 / (1 - rho);
        const Estimate& inside = result.at(0, Quantity::incident_lower, 0);
        EXPECT_TRUE(holds(
            {fmt::format("integrating sphere, sky, rho {}", rho), gain, .05 * gain, 3},
            Measured{2 * inside.mean, 2 * inside.standard_error, kReplicates}));
    }
}

/// A hollow sphere lit through a hole: light from the wall reaches the hole with the probability f
/// = its part of the sphere, so the wall receives 1/(1 - rho (1 - f)) of the first bounce.
TEST_P(Solids, AHoleInAnIntegratingSphereLetsItsShareOut) {
    constexpr double kRho = .9;
    constexpr double kHoleDepth = .1;  // of the cap cut off; f = depth / (2 R)
    std::vector<Triangle> wall;
    double hole = 0;
    for (const Triangle& t : make_sphere({0, 0, 0}, 1, 5)) {
        const double middle = (t[0].z + t[1].z + t[2].z) / 3;
        if (middle < 1 - kHoleDepth) {
            wall.push_back(t);
        } else {
            hole += area(t);
        }
    }
    SceneBuilder builder = make_builder();
    const SideOptics inside{.reflectance = kRho};
    builder.add_material({"wall", {SideOptics{}}, {inside}});
    builder.add_organ(organ("wall", "wall", wall));
    const Scene scene = std::move(builder).build();
    const Result result = trace(scene, {sun(0, {1})}, 1 << 14);

    const double wall_area = scene.organs()[0].area;
    const double f = hole / (hole + wall_area);
    // All light that enters falls on the lower, inner side; the part through the hole is direct.
    double hole_seen_from_above = 0;
    for (const Triangle& t : wall) {
        hole_seen_from_above -= .5 * area_vector(t).z;
    }
    const double expected = hole_seen_from_above / (1 - kRho * (1 - f)) / wall_area;
    EXPECT_TRUE(holds(
        {"hollow sphere with a hole, rho .9, E inside", expected, .02 * expected},
        result.at(0, Quantity::incident_lower, 0)));
}

QUASIMC_BOTH_WAYS(Solids);

}  // namespace
}  // namespace quasimc::test

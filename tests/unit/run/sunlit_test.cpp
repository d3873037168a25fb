// The sunlit fraction of the area against geometry.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "geometry/shapes/shapes.h"
#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

/// A leaf of 1 x 1 at height 0, a cover of some material at height 1.
Scene make_covered_leaf(const std::string& cover, const std::vector<Triangle>& triangles) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .4, .4));
    builder.add_material(net("net", {.5}));
    builder.add_material(sensor("sensor"));
    builder.add_organ(organ("leaf", "leaf", floor_of(0, 1, 0, 1, 0)));
    builder.add_organ(organ("cover", cover, triangles));
    return std::move(builder).build();
}

class Sunlit : public BothWays {
  protected:
    [[nodiscard]] Estimate fraction(const Scene& scene, const Sources& sources) const {
        return trace(scene, sources, 1 << 12).sunlit_fraction[0];
    }
};

TEST_P(Sunlit, ALeafHalfInTheShadeIsHalfSunlit) {
    const Scene scene = make_covered_leaf("leaf", floor_of(.5, 2, -1, 2, 1));
    EXPECT_TRUE(agrees(measured(fraction(scene, {sun(0, {1})}), kReplicates), .5, .02));
}

/// The shadow is displaced sideways by the height of the cover.
TEST_P(Sunlit, TheShadowOfALowSunFallsAside) {
    const Scene scene = make_covered_leaf("leaf", floor_of(-1, -.7, -1, 2, 1));
    EXPECT_TRUE(agrees(measured(fraction(scene, {sun(45, {1})}), kReplicates), .7, .02));
}

TEST_P(Sunlit, ALeafIsSunlitOnEitherSideHoweverItIsTurned) {
    for (const Vec3& tip : {Vec3{0, 1, 0}, {.3, .8, .9}, {.2, .1, -1}, {.7, 0, .7}}) {
        SceneBuilder builder = make_builder();
        builder.add_material(diffuse("leaf", .4, .4));
        builder.add_organ(organ("leaf", "leaf", make_triangle({0, 0, 0}, {1, .2, .1}, tip)));
        const Estimate lit = fraction(std::move(builder).build(), {sun(20, {1})});
        EXPECT_TRUE(agrees(measured(lit, kReplicates), 1, .05, sidak_level(kLevel, 4)));
    }
}

TEST_P(Sunlit, LightThroughAnotherLeafIsNoSunlight) {
    const Scene scene = make_covered_leaf("net", floor_of(-1, 2, -1, 2, 1));
    EXPECT_EQ(fraction(scene, {sun(0, {1})}).mean, 0);
}

TEST_P(Sunlit, SensorsCastNoShadow) {
    const Scene scene = make_covered_leaf("sensor", floor_of(-1, 2, -1, 2, 1));
    EXPECT_TRUE(agrees(measured(fraction(scene, {sun(0, {1})}), kReplicates), 1, .02));
}

TEST_P(Sunlit, TheSkyIsNoSun) {
    const Scene scene = make_covered_leaf("leaf", floor_of(.5, 2, -1, 2, 1));
    EXPECT_TRUE(agrees(measured(fraction(scene, {sun(0, {1}), sky({9})}), kReplicates), .5, .05));
    EXPECT_TRUE(trace(scene, {sky({1})}, 64).sunlit_fraction.empty());
}

/// Each of two suns counts by its irradiance: 0.7 of the leaf sees the one, all of it the other.
TEST_P(Sunlit, SeveralSunsCountByTheirIrradiance) {
    const Scene scene = make_covered_leaf("leaf", floor_of(.5, .8, -1, 2, 1));
    // Overhead: shadow from 0.5 to 0.8. At 45 degrees it falls beyond the leaf.
    const double expected = (3 * .7 + 1 * 1) / 4;
    EXPECT_TRUE(
        agrees(measured(fraction(scene, {sun(0, {3}), sun(45, {1})}), kReplicates), expected, .03));
}

TEST_P(Sunlit, ASphereIsSunlitOnOneHalf) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("skin", .4, 0));
    builder.add_organ(organ("sphere", "skin", make_sphere({0, 0, 0}, 1, 4)));
    const Estimate lit = fraction(std::move(builder).build(), {sun(20, {1})});
    EXPECT_TRUE(agrees(measured(lit, kReplicates), .5, .03));
}

QUASIMC_BOTH_WAYS(Sunlit);

/// One path of a sun that is sampled once in a hundred times represents a hundred.
TEST(SunlitBound, CountsHowSeldomTheSunIsPicked) {
    const auto bound = [](double sky_irradiance) {
        SceneBuilder builder = make_builder();
        builder.add_material(diffuse("leaf", 0, 0));
        builder.add_organ(organ("roof", "leaf", floor_of(0, 1, 0, 1, 1)));
        builder.add_organ(organ("below", "leaf", floor_of(.45, .55, .45, .55, 0)));
        Sources sources{sun(0, {1})};
        if (sky_irradiance > 0) {
            sources.push_back(sky({sky_irradiance}));
        }
        const Result result =
            run(std::move(builder).build(), sources, spec_of(Method::light_tracing, 8192));
        EXPECT_EQ(result.sunlit_fraction[1].mean, 0);
        return result.sunlit_fraction[1].ci95_high;
    };
    EXPECT_GT(bound(0), 0);
    EXPECT_GT(bound(100), 50 * bound(0));
}

}  // namespace
}  // namespace quasimc::test

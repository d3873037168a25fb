// Coverage of the 95 % intervals for a narrow part of the sky, against exact values. Directions
// that are evenly distributed in elevation fall into a cone about the zenith equally often in
// nearly every replicate: the few exceptions decide the mean, and most runs have none of them.

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "statistical/scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

constexpr int kNarrowSeeds = 500, kManyNarrowSeeds = 2000;

/// Half-angle of a narrow sensor's view.
constexpr double kHalfView = 25;

Scene make_sensor_over_leaves() {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", 0, 0));
    builder.add_material(sensor("sensor"));
    OrganSpec eye = organ("eye", "sensor", floor_of(.2, .8, .2, .8, 1.1));
    eye.field_of_view_deg = kHalfView;
    builder.add_organ(eye);
    add_leaves(builder, random_leaves(200, .1, 1, 3));
    return std::move(builder).build();
}

/// Coverage for the upper side of the first organ, and the scatter of its errors in units of their
/// standard errors.
void expect_covered(const Scene& scene, std::uint64_t paths, double truth, int seeds) {
    RunSpec spec;
    spec.method = Method::first_hits;
    spec.threads = 1;
    spec.paths = paths;
    int right = 0;
    double squares = 0;
    double variances = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
        spec.seed = static_cast<std::uint64_t>(seed);
        const Estimate seen = run(scene, {sky({1})}, spec).at(0, Quantity::incident_upper, 0);
        right += seen.ci95_low <= truth && truth <= seen.ci95_high ? 1 : 0;
        squares += std::pow(seen.mean - truth, 2);
        variances += std::pow(seen.standard_error, 2);
    }
    const double part = right / static_cast<double>(seeds);
    EXPECT_TRUE(agrees(measured_fraction(right, seeds, .95), .95, .06)) << paths << " paths";
    if (seeds >= kManyNarrowSeeds) {
        EXPECT_GT(part, .93) << "of " << paths << " paths";
        EXPECT_LT(part, .97) << "of " << paths << " paths";
    }
    EXPECT_NEAR(squares / variances, 1, .3);
    // The test is meaningful: the errors are not those of thousands of directions.
    EXPECT_GT(variances / seeds, std::pow(1e-3 * truth, 2));
    ::testing::Test::RecordProperty("coverage", std::to_string(part));
}

class NarrowViews : public ::testing::TestWithParam<int> {};

TEST_P(NarrowViews, OfASensorAreCoveredAsPromised) {
    const double truth = std::pow(std::sin(kHalfView * std::numbers::pi / 180), 2);
    const Scene scene = make_sensor_over_leaves();
    // About 64, 72 and 128 directions: 6, 6.7 and 12 of them in the cone.
    expect_covered(scene, 14553, truth, GetParam());
    if (GetParam() >= kManyNarrowSeeds) {
        expect_covered(scene, 16384, truth, GetParam());
        expect_covered(scene, 29106, truth, GetParam());
    }
}

TEST_P(NarrowViews, OfALeafInATubeAreCoveredAsPromised) {
    expect_covered(black_tube(1.5), 4096, tube_view_factor(1.5), GetParam());
    if (GetParam() >= kManyNarrowSeeds) {
        expect_covered(black_tube(3), 4096, tube_view_factor(3), GetParam());
    }
}

/// A sensor over a leaf, on a slope.
Scene make_sensor(double half_view_deg, double slope = 0, double side = 1) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .1, 0));
    builder.add_material(sensor("sensor"));
    std::vector<Triangle> plate = floor_of(0, side, 0, side, 1);
    for (Triangle& triangle : plate) {
        for (Vec3& corner : triangle) {
            corner.z += slope * corner.x;
        }
    }
    OrganSpec eye = organ("eye", "sensor", plate);
    eye.field_of_view_deg = half_view_deg;
    builder.add_organ(eye);
    OrganSpec leaf = organ("leaf", "leaf", floor_of(-2, 2, -2, 2, 0));
    leaf.measured = false;
    builder.add_organ(leaf);
    return std::move(builder).build();
}

Estimate seen_from_organs(
    const Scene& scene, const Sources& sources, std::uint64_t paths, std::uint64_t seed = 1) {
    RunSpec spec = spec_of(Method::from_organs, paths);
    spec.seed = seed;
    return run(scene, sources, spec).at(0, Quantity::incident_upper, 0);
}

TEST(NarrowViewsFromOrgans, ShowAnEvenSkyWithoutNoise) {
    for (const double half : {.1, 1.0, 20.0, 60.0}) {
        const double truth = std::pow(std::sin(half * std::numbers::pi / 180), 2);
        const Estimate seen = seen_from_organs(make_sensor(half), {sky({1})}, 256);
        EXPECT_NEAR(seen.mean, truth, 1e-5 * truth) << half;
        // One more contribution of scattered light is possible.
        EXPECT_LT(seen.standard_error, 3e-4 * truth) << half;
    }
}

TEST(NarrowViewsFromOrgans, OfAnOvercastSkyAreCoveredAsPromised) {
    constexpr int kSeeds = 300;
    const Scene scene = make_sensor(20);
    const double c = std::cos(20 * std::numbers::pi / 180);
    const double truth = ((1 - c * c) / 2 + 2 * (1 - c * c * c) / 3) / (7.0 / 6);
    const Sources sources{make_sky("cie_overcast", cie_overcast_shape(), {1.0})};
    int right = 0;
    for (int seed = 1; seed <= kSeeds; ++seed) {
        const Estimate seen =
            seen_from_organs(scene, sources, 256, static_cast<std::uint64_t>(seed));
        right += seen.ci95_low <= truth && truth <= seen.ci95_high ? 1 : 0;
    }
    // With 300 at 95 % fewer than 271 occur once in 600.
    EXPECT_GE(right, 271);
}

TEST(NarrowViewsFromOrgans, OfASlopeAreThoseOfLightTracing) {
    for (const double half : {30.0, 80.0}) {
        const Scene scene = make_sensor(half, .7);
        const Sources sources{make_sky("cie_overcast", cie_overcast_shape(), {1.0})};
        const Estimate own = seen_from_organs(scene, sources, 1U << 14U);
        const Estimate other = run(scene, sources, spec_of(Method::light_tracing, 1U << 18U))
                                   .at(0, Quantity::incident_upper, 0);
        const double error = std::hypot(own.standard_error, other.standard_error);
        EXPECT_NEAR(own.mean, other.mean, 4.5 * error) << half;
        EXPECT_LT(error, .01 * other.mean) << half;
    }
}

/// Light passes a sensor undisturbed: no light subpath has to connect to it.
TEST(NarrowViewsFromOrgans, ASmallSensorKnowsTheSunAsALeafDoes) {
    const Estimate seen = seen_from_organs(make_sensor(90, 0, .01), {sun(0, {1})}, 1024);
    EXPECT_NEAR(seen.mean, 1, 1e-3);
    EXPECT_LT(seen.standard_error, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Ordinary, NarrowViews, ::testing::Values(kNarrowSeeds));
INSTANTIATE_TEST_SUITE_P(Long, NarrowViews, ::testing::Values(kManyNarrowSeeds));

TEST(Tube, HasTheKnownViewFactor) {
    EXPECT_NEAR(tube_view_factor(1), .19982, 1e-5);
}

}  // namespace
}  // namespace quasimc::test

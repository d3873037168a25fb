// How often the 95 % intervals of what sees a narrow part of the sky hold the truth, which is known
// exactly. Directions that are spread evenly in elevation fall into a cone about the zenith as many
// times in nearly every replicate: the few in which they don't decide the mean, and most runs do
// not see them.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "statistical/scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

constexpr int kNarrowSeeds = 500, kManyNarrowSeeds = 2000;

/// Half of the angle that a narrow sensor sees.
constexpr double kHalfView = 25;

Scene make_sensor_over_leaves() {
    SceneBuilder builder = make_builder();
    builder.add_material(matt("leaf", 0, 0));
    builder.add_material(sensor("sensor"));
    OrganSpec eye = organ("eye", "sensor", floor_of(.2, .8, .2, .8, 1.1));
    eye.field_of_view_deg = kHalfView;
    builder.add_organ(eye);
    for (const Triangle& t : random_leaves(200, .1, 1, 3)) {
        builder.add_organ(organ("", "leaf", {t}));
    }
    return std::move(builder).build();
}

/// A leaf of 1 x 1 at the bottom of a black tube.
Scene make_tube(double height) {
    SceneBuilder builder = make_builder();
    builder.add_material(matt("black", 0, 0));
    builder.add_organ(organ("leaf", "black", floor_of(0, 1, 0, 1, 0)));
    const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    std::vector<Triangle> walls;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 up{0, 0, height};
        const Vec3& a = corners[i];
        const Vec3& b = corners[(i + 1) % 4];
        walls.push_back({a, b, b + up});
        walls.push_back({a, b + up, a + up});
    }
    builder.add_organ(organ("tube", "black", walls));
    return std::move(builder).build();
}

/// The view factor of a square of side 1 to the same one at `height` over it (Howell, Menguc and
/// Siegel, A Catalog of Radiation Heat Transfer Configuration Factors, C-11).
double view_factor(double height) {
    const double x = 1 / height;
    const double root = std::sqrt(1 + x * x);
    return 2 / (std::numbers::pi * x * x) *
           (std::log((1 + x * x) / std::sqrt(1 + 2 * x * x)) + 2 * x * root * std::atan(x / root) -
            2 * x * std::atan(x));
}

/// Coverage of what falls on the upper side of the first organ, and the scatter of its errors in
/// units of their standard errors.
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
        right += seen.low <= truth && truth <= seen.high ? 1 : 0;
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
    // It could tell: the errors are not those of thousands of directions.
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
    for (const double height : {1.5, 3.0}) {
        expect_covered(make_tube(height), 4096, view_factor(height), GetParam());
    }
}

INSTANTIATE_TEST_SUITE_P(Ordinary, NarrowViews, ::testing::Values(kNarrowSeeds));
INSTANTIATE_TEST_SUITE_P(Long, NarrowViews, ::testing::Values(kManyNarrowSeeds));

TEST(Tube, HasTheKnownViewFactor) {
    EXPECT_NEAR(view_factor(1), .19982, 1e-5);
}

}  // namespace
}  // namespace quasimc::test

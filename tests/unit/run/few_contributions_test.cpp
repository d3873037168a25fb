// Coverage of the 95 % intervals of first_hits with few contributions: along few of the directions
// of a sky, on few of the scan lines, by few of the paths. Contributions of the sun must not hide
// that the sky has none.

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "statistical/scenes.h"
#include "sums/statistics.h"
#include "transport/sky_directions.h"

namespace quasimc::test {
namespace {

constexpr int kFewFindsSeeds = 200, kManyFindsSeeds = 1000;

struct Asked {
    Quantity quantity = Quantity::incident_upper;
    std::size_t organ = 0;
    std::uint64_t paths = 4096;
    int seeds = kFewFindsSeeds;
    Method method = Method::first_hits;
};

/// Fraction of the runs whose interval contains the truth.
/// @param read  reads a value of a result
template <typename Read>
double coverage_of(
    const Scene& scene,
    const Sources& sources,
    double truth,
    const Asked& asked,
    const Read& read) {
    constexpr double kRounding = 1e-12;  // of limits that equal the truth
    RunSpec spec;
    spec.method = asked.method;
    spec.threads = 1;
    spec.paths = asked.paths;
    int right = 0;
    for (int seed = 1; seed <= asked.seeds; ++seed) {
        spec.seed = static_cast<std::uint64_t>(seed);
        const Estimate e = read(run(scene, sources, spec));
        EXPECT_GE(e.ci95_low, 0);
        right += e.ci95_low <= truth && truth <= e.ci95_high + kRounding * truth ? 1 : 0;
    }
    return right / static_cast<double>(asked.seeds);
}

double coverage_of(const Scene& scene, const Sources& sources, double truth, const Asked& asked) {
    return coverage_of(scene, sources, truth, asked, [&](const Result& result) {
        return result.at(asked.organ, asked.quantity, 0);
    });
}

class FewFinds : public ::testing::TestWithParam<int> {
  protected:
    /// With 200 at 95 % one in a million has less than 0.87, with 1000 less than 0.914.
    static double least() { return GetParam() >= kManyFindsSeeds ? .93 : .9; }
    static void note(const std::string& what, double part) {
        ::testing::Test::RecordProperty(what, std::to_string(part));
    }
};

TEST_P(FewFinds, OfALeafThatFewDirectionsReachHold) {
    for (const double height : {5.0, 20.0}) {
        const Scene scene = black_tube(height);
        const double part = coverage_of(
            scene, {sky({1})}, tube_view_factor(height), {.paths = 1024, .seeds = GetParam()});
        EXPECT_GE(part, least()) << height;
        note("tube" + std::to_string(height), part);
    }
    const double part = coverage_of(
        black_tube(10), {sky({1})}, tube_view_factor(10), {.paths = 8192, .seeds = GetParam()});
    EXPECT_GE(part, least());
    note("many paths", part);
}

TEST_P(FewFinds, OfALeafInTheSunHoldWhatTheSkyAdds) {
    for (const double height : {10.0, 20.0}) {
        const double part = coverage_of(
            black_tube(height), {sun(0, {.001}), sky({1})}, .001 + tube_view_factor(height),
            {.paths = 1024, .seeds = GetParam()});
        EXPECT_GE(part, least()) << height;
        note("sun and sky" + std::to_string(height), part);
    }
}

/// A needle so small that most scan lines miss it.
TEST_P(FewFinds, OfANeedleThatFewLinesMeetHold) {
    for (const double width : {1e-4, 1e-3, 1e-2}) {
        SceneBuilder builder = make_builder();
        builder.add_material(diffuse("black", 0, 0));
        builder.add_organ(organ("needle", "black", floor_of(.3, .6, .4, .4 + width, .5)));
        builder.add_organ(organ("floor", "black", floor_of(0, 1, 0, 1, 0)));
        const Scene scene = std::move(builder).build();
        const double part =
            coverage_of(scene, {sun(0, {1})}, 1, {.paths = 1024, .seeds = GetParam()});
        EXPECT_GE(part, least()) << width;
        note("needle" + std::to_string(width), part);
    }
}

/// A leaf in an infinite stand with a low sun, sampled by paths from the source, and a high one,
/// sampled by lines: the contributions of lines must not hide that no path has delivered light of
/// the low sun.
TEST_P(FewFinds, OfALowSunBesideAHighOneHold) {
    constexpr double kHigh = 80, kLow = 1;
    for (const double width : {1e-4, 1e-3, 5e-3}) {
        SceneBuilder builder = make_builder();
        builder.add_material(diffuse("black", 0, 0));
        builder.add_organ(
            organ("needle", "black", floor_of(.3, .3 + 20 * width, .4, .4 + width, .2)));
        builder.add_organ(organ("floor", "black", floor_of(0, .7, 0, 2, 0)));
        builder.set_cell({.along_x = true, .along_y = true, .size_x = .7, .size_y = 2});
        const Scene scene = std::move(builder).build();
        const Sources suns{sun(90 - kHigh, {.9}), sun(90 - kLow, {.5})};
        const double truth = .9 * std::sin(kHigh * std::numbers::pi / 180) +
                             .5 * std::sin(kLow * std::numbers::pi / 180);
        const double part = coverage_of(scene, suns, truth, {.paths = 1024, .seeds = GetParam()});
        EXPECT_GE(part, least()) << width;
        note("low sun" + std::to_string(width), part);
        const double sunlit = coverage_of(
            scene, suns, 1, {.paths = 1024, .seeds = GetParam()},
            [](const Result& result) { return result.sunlit_fraction[0]; });
        EXPECT_GE(sunlit, least()) << width;
    }
}

/// With 20.04 expected paths of a sun nearly every replicate has 20, and few have 21.
TEST_P(FewFinds, OfASunThatGetsTheSameNumberOfPathsHold) {
    for (const double expected : {5.03, 20.04, 20.97}) {
        SceneBuilder builder = make_builder();
        builder.add_material(diffuse("black", 0, 0));
        builder.add_organ(organ("roof", "black", floor_of(0, 1, 0, 1, 1)));
        builder.add_organ(organ("floor", "black", floor_of(0, 1, 0, 1, 0)));
        constexpr double kPaths = 256;
        const double below = expected / kPaths;
        const Sources suns{
            sun(0, {1 - below}), make_directional_source("below", {0, 0, 1}, {below})};
        const double part = coverage_of(
            std::move(builder).build(), suns, below,
            {.quantity = Quantity::incident_direct,
             .organ = 1,
             .paths = 256,
             .seeds = GetParam(),
             .method = Method::light_tracing});
        EXPECT_GE(part, least()) << expected;
        note("expected" + std::to_string(expected), part);
    }
}

/// A steep leaf with the same small number of paths of a high sun in all replicates. The many paths
/// of the low sun, which the leaf faces, must not hide it, whether both have the same spectrum or
/// not.
TEST_P(FewFinds, OfASteepLeafInALowSunAndAHighOneHold) {
    for (const auto& [low, height] : {std::pair{.8, 37.5}, {.9, 37.5}, {.8, 56.}, {.9, 56.}}) {
        SceneBuilder builder = make_builder(2);
        builder.add_material(diffuse("black", 0, 0, 2));
        const Vec3 base{0, 0, 0}, tip{1, 0, height};
        const Vec3 right{.5, -.5, height / 2}, left{.5, .5, height / 2};
        builder.add_organ(organ("leaf", "black", {{base, right, tip}, {base, tip, left}}));
        const Sources suns{sun(80, {1.8 - low, low}), sun(0, {.4, .4})};
        const double part = coverage_of(
            std::move(builder).build(), suns, 1,
            {.paths = 256, .seeds = GetParam(), .method = Method::light_tracing},
            [](const Result& result) { return result.sunlit_fraction[0]; });
        EXPECT_GE(part, least()) << height;
        note("height" + std::to_string(height) + "_" + std::to_string(low), part);
    }
}

/// Each of the few paths inside a bright hollow body hits it repeatedly.
TEST_P(FewFinds, InsideOfAHollowOrganHold) {
    constexpr double kSide = .03, kInto = .2, kBright = .9;
    const Vec3 a{.5, .5, .5}, b{.5 + kSide, .5, .5}, c{.5, .5 + kSide, .5};
    const Vec3 top{.5 + kSide / 4, .5 + kSide / 4, .5 + kSide};
    const std::vector<Triangle> body{{a, c, b}, {a, b, top}, {b, c, top}, {c, a, top}};
    MaterialSpec bright = diffuse("bright", 0, kInto);
    bright.lower = {{kBright, 0}};
    SceneBuilder builder = make_builder();
    builder.add_material(std::move(bright));
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("body", "bright", body));
    builder.add_organ(organ("floor", "black", floor_of(0, 1, 0, 1, 0)));
    const Scene scene = std::move(builder).build();
    const double truth = kInto * kSide * kSide / 2 / (1 - kBright) / area(body);
    for (const Method method : {Method::light_tracing, Method::first_hits}) {
        const double part = coverage_of(
            scene, {sun(0, {1})}, truth,
            {.quantity = Quantity::incident_lower,
             .paths = 8192,
             .seeds = GetParam(),
             .method = method});
        EXPECT_GE(part, least());
        note("inside" + std::to_string(static_cast<int>(method)), part);
    }
}

/// Ground in the shadow of a needle that few paths of few replicates hit: all others have equal
/// light, except for the directions of the sun's disk, but not all that is possible.
TEST_P(FewFinds, OfTheGroundBelowANeedleHold) {
    constexpr double kShadow = 4e-5;
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("needle", "black", floor_of(.3, .7, .4, .4 + kShadow / .4, .2)));
    builder.set_ground(ground("black"));
    builder.set_cell({.along_x = true, .along_y = true, .size_x = 1, .size_y = 1});
    const Sources disk{make_sun_disk("sun", {.6, 0, .8}, solar_radius_deg(1), {1})};
    const double sunlit = coverage_of(
        std::move(builder).build(), disk, 1 - kShadow,
        {.paths = 1024, .seeds = GetParam(), .method = Method::light_tracing},
        [](const Result& result) { return result.sunlit_fraction[1]; });
    EXPECT_GE(sunlit, least());
    note("ground", sunlit);
}

/// A vertical sensor with a narrow top, where alone the sun is in view: nearly all replicates have
/// nine points there, 8.97 are expected.
TEST_P(FewFinds, OfPointsOnTheTopOfASensorHold) {
    constexpr double kPaths = 1024, kOnTop = 8.97, kZenith = 5;
    constexpr double kWidth = kOnTop / (kPaths - kOnTop);
    SceneBuilder builder = make_builder();
    builder.add_material(sensor("sensor"));
    std::vector<Triangle> sides = floor_of(0, kWidth, 0, 1, 1);
    for (const Triangle& t : make_parallelogram({0, 0, 0}, {0, 0, 1}, {0, 1, 0})) {
        sides.push_back(t);
    }
    OrganSpec upright = organ("upright", "sensor", sides);
    upright.field_of_view_deg = 40;
    builder.add_organ(std::move(upright));
    const double truth = std::cos(kZenith * std::numbers::pi / 180) * kWidth / (1 + kWidth);
    const double part = coverage_of(
        std::move(builder).build(), {sun(kZenith, {1})}, truth,
        {.quantity = Quantity::incident_direct,
         .paths = 1024,
         .seeds = GetParam(),
         .method = Method::from_organs});
    EXPECT_GE(part, least());
    note("top", part);
}

/// A small vertical leaf over infinite glossy ground, which reflects much of a sky's light at
/// grazing angles: each factor of the angle contributes equally.
TEST_P(FewFinds, OfALeafUprightOverShinyGroundHold) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    MaterialSpec shiny = diffuse("shiny", 0, 0);
    shiny.upper = {{.5, 0, "phong", {{"exponent", 154}}}};
    builder.add_material(shiny);
    builder.add_organ(
        organ("upright", "black", make_parallelogram({.5, .4, .3}, {0, .2, 0}, {0, 0, .2})));
    builder.set_cell({.along_x = true, .along_y = true, .size_x = 4, .size_y = 4});
    builder.set_ground(ground("shiny"));
    const Scene scene = std::move(builder).build();
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.paths = 1 << 18;
    constexpr auto kAsked = Quantity::incident_scattered;
    const double truth = run(scene, {sky({1})}, spec).at(0, kAsked, 0).mean;
    const double part = coverage_of(
        scene, {sky({1})}, truth,
        {.quantity = kAsked, .paths = 1024, .seeds = GetParam(), .method = Method::from_organs});
    EXPECT_GE(part, least());
    note("upright", part);
}

/// A small leaf under a bright floor, lit by light from the floor alone.
TEST_P(FewFinds, OfALeafThatFewScatteredPathsMeetHold) {
    for (const double size : {.01, .03, .06, .1}) {
        SceneBuilder builder = make_builder();
        builder.add_material(diffuse("floor", .4, 0));
        builder.add_material(diffuse("black", 0, 0));
        builder.add_organ(organ("leaf", "black", floor_of(.5, .5 + size, .5, .5 + size, .5)));
        builder.add_organ(organ("floor", "floor", floor_of(0, 1, 0, 1, 0)));
        const Scene scene = std::move(builder).build();
        RunSpec fine = spec_of(Method::from_organs, 1 << 15);
        const double truth =
            run(scene, {sun(0, {1})}, fine).at(0, Quantity::incident_lower, 0).mean;
        const double part = coverage_of(
            scene, {sun(0, {1})}, truth,
            {.quantity = Quantity::incident_lower, .paths = 1024, .seeds = GetParam()});
        EXPECT_GE(part, least()) << size;
        note("scattered" + std::to_string(size), part);
    }
}

/// A lattice of the golden ratio alone falls into a cone about the zenith so evenly that 92 % of
/// the intervals contain the expected number.
TEST(ManyDirections, FallIntoNarrowConesAsIntervalsPromise) {
    constexpr int kRuns = 2000;
    constexpr std::uint32_t kDirections = 1024;
    constexpr double kExpected = 6;
    std::mt19937_64 bits(1);
    std::uniform_real_distribution<double> uniform;
    int right = 0;
    for (int run = 0; run < kRuns; ++run) {
        std::array<double, 8> counts{};
        for (double& count : counts) {
            const std::array<double, 3> placing{uniform(bits), uniform(bits), uniform(bits)};
            for (std::uint32_t i = 0; i < kDirections; ++i) {
                const double height = hemisphere_lattice(i, kDirections, placing)[0];
                count += height > 1 - kExpected / kDirections ? 1 : 0;
            }
        }
        const Estimate e = estimate_mean(counts);
        right += e.ci95_low <= kExpected && kExpected <= e.ci95_high ? 1 : 0;
    }
    EXPECT_GT(right, .932 * kRuns) << right;
    EXPECT_LT(right, .97 * kRuns) << right;
    RecordProperty("coverage", std::to_string(right));
}

INSTANTIATE_TEST_SUITE_P(Ordinary, FewFinds, ::testing::Values(kFewFindsSeeds));
INSTANTIATE_TEST_SUITE_P(Long, FewFinds, ::testing::Values(kManyFindsSeeds));

/// Three contributions are the upper bound of none, also on a leaf at grazing incidence.
TEST(SunlitBound, OfASteepLeafIsOfItsOwnContributions) {
    double of_one = std::numeric_limits<double>::infinity();
    double of_none = 0;
    for (std::uint64_t seed = 1; seed <= 24; ++seed) {
        SceneBuilder builder = make_builder(1);
        builder.add_material(diffuse("leaf", 0, 0));
        builder.add_organ(organ("floor", "leaf", floor_of(-1, 1, -1, 1, 0)));
        builder.add_organ(
            organ("steep", "leaf", {make_triangle({-.5, 0, .5}, {.5, 0, .5}, {0, .1, 1.49})}));
        // So large that the upper bound of none is less than all of the leaf.
        builder.add_organ(organ("roof", "leaf", floor_of(-.6, .2, -1, 1, 2)));
        RunSpec spec = spec_of(Method::light_tracing, 64);
        spec.replicates = 4;
        spec.seed = seed;
        const Estimate lit =
            run(std::move(builder).build(), {sun(0, {1})}, spec).sunlit_fraction[1];
        if (lit.mean > 0) {
            of_one = std::min(of_one, lit.mean);
        } else {
            of_none = lit.ci95_high;
        }
    }
    ASSERT_TRUE(std::isfinite(of_one));
    EXPECT_NEAR(of_none, 3 * of_one, .01 * of_none);
}

/// A wall under a sun in the zenith receives nothing, and one contribution of it can't light more
/// than the wall.
TEST(SunlitBound, OfAGroupWithAWallIsThatOfItsLeaves) {
    SceneBuilder builder = make_builder(1);
    builder.add_material(diffuse("leaf", .3, .3));
    builder.add_organ(
        organ("wall", "leaf", {make_triangle({.1, -.4, 0}, {.1, .4, 0}, {.1, 0, .5})}));
    builder.add_organ(organ("leaf", "leaf", floor_of(.2, .7, -.1, .1, .3)));
    const Scene scene = std::move(builder).build();
    for (const Method method : {Method::light_tracing, Method::first_hits, Method::ray_bundles}) {
        const Result result = run(scene, {sun(0, {1})}, spec_of(method, 4096));
        EXPECT_LT(result.groups.sunlit_fraction[0].standard_error, .01);
    }
}

/// No light gets into a closed organ that transmits none, and none into a sphere of a sensor stays
/// there. A path inside would hit them again and again.
TEST(ScatteredBound, OfClosedOrgansIsThatOfTheirOutsides) {
    const Vec3 a{.5, .5, .5}, b{.6, .5, .5}, c{.5, .6, .5}, top{.52, .52, .6};
    const std::vector<Triangle> body{{a, c, b}, {a, b, top}, {b, c, top}, {c, a, top}};
    for (const bool is_sensor : {false, true}) {
        SceneBuilder builder = make_builder(1);
        builder.add_material(is_sensor ? sensor("white") : diffuse("white", 1, 0));
        builder.add_material(diffuse("leaf", .4, .4));
        builder.add_organ(organ("body", "white", body));
        builder.add_organ(organ("leaf", "leaf", floor_of(.3, .8, .3, .8, .4)));
        const Scene scene = std::move(builder).build();
        for (const Method method : {Method::light_tracing, Method::first_hits}) {
            const Estimate scattered = run(scene, {sun(0, {1})}, spec_of(method, 1024))
                                           .at(0, Quantity::incident_scattered, 0);
            EXPECT_GT(scattered.standard_error, 0);
            EXPECT_LT(scattered.standard_error, .5 * scattered.mean) << is_sensor;
        }
    }
}

}  // namespace
}  // namespace quasimc::test

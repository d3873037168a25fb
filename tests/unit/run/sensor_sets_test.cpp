// Sensors that are no organs: points, arrays, averages, spheres.

#include <cmath>
#include <numbers>
#include <stop_token>
#include <string>

#include <gtest/gtest.h>

#include "quasimc/series.h"
#include "results/evaluate.h"
#include "run/zero_result.h"
#include "statistical/scenes.h"
#include "support/listening.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

constexpr double kPi = std::numbers::pi;

SensorSet set_at(const std::string& name, const std::vector<Vec3>& positions) {
    SensorSet set{.name = name};
    for (const Vec3& p : positions) {
        set.points.push_back({.position = p});
    }
    return set;
}

SensorSet set_facing(const std::string& name, const Vec3& position, const Vec3& facing) {
    SensorSet set{.name = name};
    set.points.push_back({.position = position, .facing = facing});
    return set;
}

/// A ground that reflects a part of the light, and a black square of side 2 at height 1 above its
/// middle.
SceneBuilder square_above_ground(double reflectance = 0) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    builder.add_material(diffuse("soil", reflectance, 0));
    builder.add_organ(organ("square", "black", floor_of(-1, 1, -1, 1, 1)));
    GroundSpec soil = ground("soil");
    soil.extent = {{-50, -50, 50, 50}};
    builder.set_ground(soil);
    return builder;
}

/// The part of the light of a uniform sky that the square takes from the point below its middle
/// (Howell's catalogue, B-4).
double view_of_square() {
    const double root = std::sqrt(2.0);
    return 4 * std::atan(1 / root) / (kPi * root);
}

/// Random leaves in an infinite stand above a ground.
SceneBuilder infinite_stand() {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .3, .2));
    builder.add_material(diffuse("soil", .2, 0));
    builder.add_material(sensor("sensor"));
    builder.set_cell({.along_x = true, .along_y = true, .size_x = 1, .size_y = 1});
    add_leaves(builder, random_leaves(30, .2, .4, 5));
    builder.set_ground(ground("soil"));
    return builder;
}

SensorSet averaged_grid(std::size_t side, double height) {
    SensorSet set{.name = "grid", .is_averaged = true};
    for (std::size_t i = 0; i < side * side; ++i) {
        const std::size_t row = i / side;
        const auto x = static_cast<double>(i % side), y = static_cast<double>(row);
        const auto n = static_cast<double>(side);
        set.points.push_back({.position = {(x + .5) / n, (y + .5) / n, height}});
    }
    return set;
}

RunSpec spec_for_sensors(std::uint64_t paths = 1U << 12U) {
    RunSpec spec = spec_of(Method::light_tracing, paths);
    spec.replicates = 8;
    return spec;
}

void expect_holds(const Estimate& estimate, double expected, double resolution = .02) {
    EXPECT_NEAR(estimate.mean, expected, 6 * estimate.standard_error + 1e-9);
    EXPECT_LE(estimate.standard_error, resolution * expected);
}

/// The light of the first band on the upper side.
Estimate upper(const Result& result, std::size_t sensor) {
    return result.sensors->at(sensor, Quantity::incident_upper, 0);
}
Estimate lower(const Result& result, std::size_t sensor) {
    return result.sensors->at(sensor, Quantity::incident_lower, 0);
}

TEST(SensorSets, SeeTheSkyByTheCosineOfTheirFacing) {
    SceneBuilder builder = square_above_ground();
    const Vec3 high{20, 20, 2};
    builder.add_sensors(set_facing("up", high, {}));
    builder.add_sensors(set_facing("down", high, {0, 0, -3}));
    builder.add_sensors(set_facing("wall", high, {0, 2, 0}));
    SensorSet narrow = set_facing("narrow", high, {0, 0, 1});
    narrow.field_of_view_deg = 30;
    builder.add_sensors(narrow);
    SensorSet ball = set_facing("ball", high, {});
    ball.receiver = Receiver::sphere;
    builder.add_sensors(ball);
    const Result result = run(std::move(builder).build(), {sky({1})}, spec_for_sensors());
    ASSERT_TRUE(result.sensors);
    expect_holds(upper(result, 0), 1);
    EXPECT_EQ(lower(result, 0).mean, 0);
    expect_holds(lower(result, 1), 1);
    expect_holds(upper(result, 2), .5);
    expect_holds(lower(result, 2), .5);
    expect_holds(upper(result, 3), .25);
    expect_holds(upper(result, 4), 2);
    EXPECT_EQ(lower(result, 4).mean, 0);
}

TEST(SensorSets, SeeTheSkyPastASurface) {
    SceneBuilder builder = square_above_ground();
    builder.add_sensors(set_at("below", {{0, 0, 0}}));
    const Result result = run(std::move(builder).build(), {sky({1})}, spec_for_sensors());
    expect_holds(upper(result, 0), 1 - view_of_square());
}

TEST(SensorSets, SeeTheSunWhereItShines) {
    SceneBuilder builder = square_above_ground();
    builder.add_sensors(set_at("points", {{0, 0, .5}, {10, 10, 0}}));
    SensorSet ball = set_at("ball", {{10, 10, .1}});
    ball.receiver = Receiver::sphere;
    builder.add_sensors(ball);
    const Result result = run(std::move(builder).build(), {sun(30, {1})}, spec_for_sensors());
    EXPECT_EQ(upper(result, 0).mean, 0);
    EXPECT_EQ(result.sensors->sunlit_fraction[0].mean, 0);
    EXPECT_NEAR(upper(result, 1).mean, std::cos(kPi / 6), 1e-6);
    EXPECT_NEAR(result.sensors->sunlit_fraction[1].mean, 1, 1e-6);
    EXPECT_NEAR(upper(result, 2).mean, 1, 1e-6);
}

/// An infinite plane that reflects one half: the light from below does not depend on the height,
/// nor does the position matter by how many cells it is outside.
TEST(SensorSets, SeeTheInfiniteStand) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("soil", .5, 0));
    builder.set_cell({.along_x = true, .along_y = true, .size_x = 1, .size_y = 2});
    builder.add_organ(organ("plane", "soil", floor_of(0, 1, 0, 2, 0)));
    builder.add_sensors(set_at("points", {{.5, .5, 0}, {.2, 1, 3}, {-7.3, 25.1, .7}}));
    SensorSet ball = set_at("ball", {{.5, .5, 1}});
    ball.receiver = Receiver::sphere;
    builder.add_sensors(ball);
    const Result result = run(std::move(builder).build(), {sky({1})}, spec_for_sensors());
    for (std::size_t i = 0; i < 3; ++i) {
        expect_holds(upper(result, i), 1);
        expect_holds(lower(result, i), .5);
    }
    expect_holds(upper(result, 3), 2 * 1.5);
}

/// The mean of points over the cell is the light on a transparent organ that fills it, by another
/// method.
TEST(SensorSets, OfAStandAgreeWithATransparentOrgan) {
    SceneBuilder builder = infinite_stand();
    builder.add_organ(organ("plane", "sensor", floor_of(0, 1, 0, 1, .1)));
    builder.add_sensors(averaged_grid(40, .1));
    RunSpec spec = spec_for_sensors(1U << 16U);
    const Result result = run(std::move(builder).build(), {sun(40, {1}), sky({.3})}, spec);
    const std::size_t plane = result.names->organ_index("plane");
    for (const Quantity q :
         {Quantity::incident_upper, Quantity::incident_lower, Quantity::incident_direct,
          Quantity::incident_scattered}) {
        const Estimate on_organ = result.at(plane, q, 0);
        const Estimate on_points = result.sensors->at(0, q, 0);
        EXPECT_LT(on_points.standard_error, .02 * on_points.mean);
        // The points are 1600; the tolerance allows for the edges of shadows between them.
        EXPECT_NEAR(
            on_points.mean, on_organ.mean,
            5 * std::hypot(on_points.standard_error, on_organ.standard_error) +
                .01 * on_organ.mean);
    }
}

std::shared_ptr<const Source> lamp_at(const Vec3& position) {
    LampSpec spec;
    spec.name = "lamp";
    spec.position = position;
    spec.flux = {1};
    return make_lamp(std::move(spec));
}

TEST(SensorSets, SeeALampByTheSquareOfItsDistance) {
    SceneBuilder builder = square_above_ground();
    builder.add_sensors(set_at("points", {{3, 0, 1}, {3, 0, 1.99}, {3, 3, .5}}));
    const Result result = run(std::move(builder).build(), {lamp_at({3, 0, 2})}, spec_for_sensors());
    EXPECT_NEAR(upper(result, 0).mean, 1 / (4 * kPi), 1e-6);
    EXPECT_NEAR(upper(result, 1).mean, 1 / (4 * kPi * 1e-4), .01);
    EXPECT_NEAR(upper(result, 2).mean, 1.5 / (4 * kPi * std::pow(11.25, 1.5)), 1e-6);
}

/// Light that a ground scatters close below a lamp, on a disk beside it.
TEST(SensorSets, ReceiveScatteredLightOfANearLamp) {
    SceneBuilder builder = square_above_ground(.8);
    builder.add_material(sensor("sensor"));
    builder.add_organ(organ("plane", "sensor", floor_of(5.1, 5.5, -.2, .2, .2)));
    SensorSet grid{.name = "grid", .is_averaged = true};
    for (int i = 0; i < 64; ++i) {
        const int row = i / 8;
        grid.points.push_back({.position = {5.125 + .05 * (i % 8), -.175 + .05 * row, .2}});
    }
    builder.add_sensors(grid);
    RunSpec spec = spec_for_sensors(1U << 15U);
    const Result result = run(std::move(builder).build(), {lamp_at({5, 0, .1})}, spec);
    const std::size_t plane = result.names->organ_index("plane");
    const Estimate on_organ = result.at(plane, Quantity::incident_lower, 0);
    const Estimate on_points = lower(result, 0);
    EXPECT_LT(on_organ.standard_error, .02 * on_organ.mean);
    EXPECT_NEAR(
        on_points.mean, on_organ.mean,
        5 * std::hypot(on_points.standard_error, on_organ.standard_error) + .01 * on_organ.mean);
}

TEST(SensorSets, AverageThePoints) {
    const std::vector<Vec3> line{{-1.5, 0, 0}, {-.5, 0, 0}, {.5, 0, 0}, {1.5, 0, 0}};
    SceneBuilder builder = square_above_ground();
    builder.add_sensors(set_at("points", line));
    SensorSet mean = set_at("mean", line);
    mean.is_averaged = true;
    builder.add_sensors(mean);
    const Result result = run(std::move(builder).build(), {sky({1})}, spec_for_sensors(1U << 14U));
    double sum = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        sum += upper(result, i).mean / static_cast<double>(line.size());
    }
    ASSERT_EQ(result.sensors->organs(), line.size() + 1);
    EXPECT_EQ(result.sensors->names->organs()[4].name, "mean");
    expect_holds(upper(result, 4), sum, .01);
}

bool have_equal_bits(const std::vector<Estimate>& a, const std::vector<Estimate>& b) {
    return a.size() == b.size() &&
           std::equal(a.begin(), a.end(), b.begin(), [](const Estimate& x, const Estimate& y) {
               const bool same_error =
                   x.standard_error == y.standard_error ||
                   (std::isnan(x.standard_error) && std::isnan(y.standard_error));
               return x.mean == y.mean && same_error;
           });
}

class SensorSetsOfMethods : public ::testing::TestWithParam<Method> {};

TEST_P(SensorSetsOfMethods, ChangeNoBitOfTheOrgans) {
    RunSpec spec = spec_of(GetParam(), 1U << 12U);
    spec.layers = 2;
    const Sources sources{sun(40, {1}), sky({.3})};
    const Result without = run(infinite_stand().build(), sources, spec);
    SceneBuilder builder = infinite_stand();
    builder.add_sensors(averaged_grid(4, .1));
    builder.add_sensors(set_at("points", {{.5, .5, .1}, {.5, .5, 10}}));
    const Result with = run(std::move(builder).build(), sources, spec);
    EXPECT_FALSE(without.sensors);
    ASSERT_TRUE(with.sensors);
    EXPECT_EQ(with.sensors->organs(), 3U);
    EXPECT_TRUE(have_equal_bits(with.values, without.values));
    EXPECT_TRUE(have_equal_bits(with.groups.values, without.groups.values));
    EXPECT_EQ(with.budget[0].escaped.mean, without.budget[0].escaped.mean);
    EXPECT_EQ(with.chosen.method, without.chosen.method);
}

INSTANTIATE_TEST_SUITE_P(
    All,
    SensorSetsOfMethods,
    ::testing::Values(
        Method::light_tracing,
        Method::from_organs,
        Method::first_hits,
        Method::ray_bundles,
        Method::automatic),
    [](const auto& method) {
        return method.param == Method::automatic ? std::string("automatic") : name_of(method);
    });

TEST(SensorSets, DoNotDependOnThreads) {
    SceneBuilder builder = infinite_stand();
    builder.add_sensors(averaged_grid(4, .1));
    builder.add_sensors(set_at("points", {{.5, .5, .1}, {.2, .5, .2}, {.7, .1, .4}}));
    const Scene scene = std::move(builder).build();
    RunSpec spec = spec_for_sensors();
    spec.threads = 1;
    const Result one = run(scene, {sun(40, {1}), sky({.3})}, spec);
    spec.threads = 3;
    const Result three = run(scene, {sun(40, {1}), sky({.3})}, spec);
    EXPECT_TRUE(have_equal_bits(one.sensors->values, three.sensors->values));
}

/// 95 % intervals of the light below the square, whose truth is known.
TEST(SensorSets, HaveIntervalsThatHoldTheTruth) {
    SceneBuilder builder = square_above_ground();
    builder.add_sensors(set_at("below", {{0, 0, 0}}));
    const Scene scene = std::move(builder).build();
    RunSpec spec = spec_for_sensors(256);
    spec.threads = 1;
    const int seeds = 400;
    int held = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
        spec.seed = static_cast<std::uint64_t>(seed);
        const Estimate e = upper(run(scene, {sky({1})}, spec), 0);
        const double truth = 1 - view_of_square();
        held += e.ci95_low <= truth && truth <= e.ci95_high ? 1 : 0;
    }
    // Five standard deviations of a binomial of 0.95.
    EXPECT_NEAR(static_cast<double>(held) / seeds, .95, 5 * std::sqrt(.95 * .05 / seeds));
}

TEST(SensorSets, ReachATargetOfTheirOwn) {
    SceneBuilder builder = infinite_stand();
    builder.add_sensors(set_at("points", {{.5, .5, .1}, {.2, .5, .2}, {.7, .1, .4}}));
    const Scene scene = std::move(builder).build();
    RunSpec spec = spec_for_sensors(1024);
    spec.target = TargetScope::sensors;
    spec.target_error = .01;
    spec.target_fraction = 1;
    const Result result = run(scene, {sky({1})}, spec);
    EXPECT_EQ(result.stop, StopReason::target_reached);
    EXPECT_EQ(result.fraction_at_target, 1);
    EXPECT_EQ(result.paths, 1024U);  // the target is none of the organs
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LE(upper(result, i).standard_error, .02 * upper(result, i).mean);
    }
}

TEST(SensorSets, AddUpByOrigin) {
    SceneBuilder builder = infinite_stand();
    builder.add_sensors(set_at("points", {{.5, .5, .1}, {.2, .5, .2}}));
    RunSpec spec = spec_for_sensors();
    spec.origins = {"sun", "sky"};
    const Result result = run(std::move(builder).build(), {sun(40, {1}), sky({.3})}, spec);
    const Result& sensors = *result.sensors;
    ASSERT_EQ(sensors.origins.size(), 2U);
    for (std::size_t i = 0; i < sensors.values.size(); ++i) {
        const double sum =
            sensors.origins[0].light.values[i].mean + sensors.origins[1].light.values[i].mean;
        EXPECT_NEAR(sum, sensors.values[i].mean, 1e-12);
    }
}

/// Two times of a day, the second half as bright, and a night.
/// Sunlit and shaded parts are those of organs.
TEST(SensorSets, HaveNoLightOfParts) {
    SceneBuilder builder = square_above_ground();
    builder.add_sensors(set_facing("up", {20, 20, 2}, {}));
    const Scene scene = std::move(builder).build();
    RunSpec spec = spec_for_sensors(64);
    const Sources lights{sun(30, {1}), sky({1})};
    const Result together = run(scene, lights, spec);
    spec.sun_shade = SunShade::apart;
    const Result apart = run(scene, lights, spec);
    EXPECT_FALSE(apart.sun_shade.empty());
    EXPECT_TRUE(apart.sensors->sun_shade.empty());
    EXPECT_EQ(upper(apart, 0).mean, upper(together, 0).mean);
    EXPECT_TRUE(zero_result(scene, spec).sensors->sun_shade.empty());
}

TEST(SensorSets, AreSummedOverDays) {
    SceneBuilder builder = infinite_stand();
    builder.add_sensors(set_at("points", {{.5, .5, .1}, {.2, .5, 2}}));
    const Scene scene = std::move(builder).build();
    const std::vector<TimeStep> steps{
        {.name = "a", .sources = {sky({1})}, .directional_key = "sky", .seconds = 3600},
        {.name = "b", .sources = {sky({.5})}, .directional_key = "sky", .seconds = 1800},
        {.name = "night", .sources = {}, .directional_key = "", .seconds = 600}};
    std::vector<Estimate> found;
    Listening listening;
    listening.time_step = [&](std::size_t, const Result& result, std::size_t) {
        found.push_back(upper(result, 1));
    };
    const SeriesSummary summary =
        run_series(scene, steps, spec_for_sensors(), {.listeners = {&listening}});
    ASSERT_EQ(found.size(), 3U);
    const Estimate first = found[0];
    expect_holds(first, 1);
    EXPECT_NEAR(found[1].mean, .5 * first.mean, 1e-12);
    EXPECT_EQ(found[2].mean, 0);
    ASSERT_TRUE(summary.total.sensors);
    EXPECT_NEAR(
        summary.total.sensors->at(1, Quantity::incident_upper, 0).mean,
        first.mean * (3600 + .5 * 1800), 1e-8);
}

/// Stops a run when the light on organs is complete.
class StoppingAfterOrgans final : public RunListener {
  public:
    void on_last_round(const RunSoFar& /*run*/) override { source_.request_stop(); }
    [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

  private:
    std::stop_source source_;
};

TEST(SensorSets, AreAbsentIfTheRunIsStoppedBeforeThem) {
    SceneBuilder builder = infinite_stand();
    builder.add_sensors(set_at("points", {{.5, .5, .1}, {.2, .5, 2}}));
    const Scene scene = std::move(builder).build();
    StoppingAfterOrgans stopping;
    const Result result =
        run(scene, {sky({1})}, spec_for_sensors(),
            {.stop = stopping.token(), .listeners = {&stopping}});
    EXPECT_EQ(result.sensors, nullptr);
    EXPECT_EQ(result.stop, StopReason::interrupted);
    EXPECT_GT(result.at(0, Quantity::absorbed_flux, 0).mean, 0) << "the organs are complete";
}

/// A sum needs the sensors of all of its times.
TEST(SensorSets, AreAbsentInTheSumOfASeriesThatIsStoppedBeforeThem) {
    SceneBuilder builder = infinite_stand();
    builder.add_sensors(set_at("points", {{.5, .5, .1}, {.2, .5, 2}}));
    const Scene scene = std::move(builder).build();
    const std::vector<TimeStep> steps{
        {.name = "night", .sources = {}, .directional_key = "", .seconds = 600},
        {.name = "day", .sources = {sky({1})}, .directional_key = "sky", .seconds = 3600}};
    StoppingAfterOrgans stopping;
    Listening listening;
    const SeriesSummary summary = run_series(
        scene, steps, spec_for_sensors(),
        {.stop = stopping.token(), .listeners = {&stopping, &listening}});
    EXPECT_EQ(summary.completed, 2U);
    EXPECT_EQ(summary.without_sensors, 1U);
    EXPECT_EQ(summary.total.sensors, nullptr);
    EXPECT_GT(summary.total.at(0, Quantity::absorbed_flux, 0).mean, 0);
}

std::string faults_of_sensors(const Scene& scene, const Sources& sources) {
    try {
        static_cast<void>(run(scene, sources, spec_for_sensors()));
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(SensorSets, AreRefusedWherePathsFromPointsMissLight) {
    SceneBuilder in_cell = infinite_stand();
    in_cell.add_sensors(set_at("bench", {{.5, .5, .1}}));
    EXPECT_NE(
        faults_of_sensors(std::move(in_cell).build(), {lamp_at({.5, .5, 3})})
            .find("repeats with the cell"),
        std::string::npos);

    SceneBuilder below_glass = square_above_ground();
    MaterialSpec glass = sensor("glass");
    for (std::vector<SideOptics>* side : {&glass.upper, &glass.lower}) {
        side->front().transmittance = .8;
    }
    below_glass.add_material(glass);
    below_glass.add_organ(organ("roof", "glass", floor_of(-9, 9, -9, 9, 5)));
    below_glass.add_sensors(set_at("bench", {{3, 3, .1}}));
    const Scene scene = std::move(below_glass).build();
    EXPECT_NE(
        faults_of_sensors(scene, {sun(30, {1})}).find("by the mirror 'glass'"), std::string::npos);
    const Result below_sky = run(scene, {sky({1})}, spec_for_sensors());
    EXPECT_LT(upper(below_sky, 0).mean, 1);  // light of a sky is found
}

TEST(SensorSets, HaveNamesOfTheirOwnAndPositions) {
    SceneBuilder builder = square_above_ground();
    builder.add_sensors(set_at("bench", {{0, 0, std::nan("")}, {1, 1, 1}}));
    builder.add_sensors(set_at("bench", {}));
    try {
        static_cast<void>(std::move(builder).build());
        FAIL();
    } catch (const InputError& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("1 of 2 points have no position (first: 1)"), std::string::npos);
        EXPECT_NE(text.find("it has no points"), std::string::npos);
        EXPECT_NE(text.find("other sensors have this name"), std::string::npos);
    }
}

}  // namespace
}  // namespace quasimc::test

// Cases where paths from organs rarely reach the light: narrow lobes, lamps close to surfaces,
// grazing suns. Against closed forms, or against light tracing.

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/vec3.h"
#include "geometry/shapes/shapes.h"
#include "quasimc/source.h"
#include "statistical/scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

using std::numbers::pi;

MaterialSpec glossy(const std::string& model, double exponent) {
    SideOptics side{.reflectance = .6};
    side.reflection_model = model;
    side.reflection_parameters = {{"exponent", exponent}};
    return {"glossy", {side}, {side}};
}

/// A glossy floor and a black wall beside it, which the light of a western sun reaches by way of
/// the floor alone: its lower side faces the floor.
Scene make_glossy_corner(const MaterialSpec& material) {
    SceneBuilder builder = make_builder();
    builder.add_material(material);
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("floor", "glossy", floor_of(-1, 1, -1, 1, 0)));
    builder.add_organ(
        organ("leaf", "black", make_parallelogram({1, -.5, .2}, {-.3, 0, .3}, {0, 1, 0})));
    return std::move(builder).build();
}

std::shared_ptr<const Source> lamp_at(
    const Vec3& position, const Opening& opening, const Pattern& pattern, const Vec3& aim) {
    LampSpec spec;
    spec.name = "lamp";
    spec.position = position;
    spec.axes = lamp_axes(aim, {1, 0, 0});
    spec.opening = opening;
    spec.pattern = pattern;
    spec.flux = {1};
    return make_lamp(std::move(spec));
}

struct Light {
    std::string name;
    std::shared_ptr<const Source> source;
};

std::vector<Light> lights_for_gloss() {
    const double x = std::sin(pi / 4);
    return {
        {"sun", sun(45, {1})},
        {"sun disk", make_sun_disk("sun", {-x, 0, x}, .27, {1})},
        {"sky", sky({1})},
        {"point lamp", lamp_at({-1, 0, 1.5}, {}, isotropic_pattern(), {0, 0, -1})},
        {"panel", lamp_at(
                      {-1, 0, 1.5}, {.kind = Opening::Kind::rectangle, .length = .4, .width = .4},
                      cosine_pattern(), {1, 0, -1})}};
}

/// The light from the floor to the leaf agrees with light tracing.
TEST(NarrowLobes, GiveTheSameFromOrgansAndSources) {
    for (const auto& [model, exponent] :
         {std::pair{"phong", 40.0}, std::pair{"phong", 100.0}, std::pair{"phong", 1e4},
          std::pair{"blinn_phong", 300.0}, std::pair{"blinn_phong", 1e6}}) {
        const Scene scene = make_glossy_corner(glossy(model, exponent));
        for (const Light& light : lights_for_gloss()) {
            const auto incident = [&](Method method, std::uint64_t paths) {
                const Result result = run(scene, {light.source}, spec_of(method, paths));
                return measured(result.at(1, Quantity::incident_scattered, 0), kReplicates);
            };
            const Measured truth = incident(Method::light_tracing, 1 << 13);
            EXPECT_TRUE(
                agrees(incident(Method::from_organs, 1 << 13), truth, .3 * truth.mean, kLevel / 25))
                << model << ' ' << exponent << ' ' << light.name;
        }
    }
}

/// A disk of radius 1 that faces down to a black one, a metre below. @param rho  of the upper one
Scene make_two_disks(double rho) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("housing", rho, 0));
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("housing", "housing", make_disk({0, 0, 1}, {0, 0, -1}, 1, 512)));
    builder.add_organ(organ("disk", "black", make_disk({0, 0, 0}, {0, 0, 1}, 1, 512)));
    return std::move(builder).build();
}

/// Fraction of the light of a small flat spot in the middle of the upper disk that falls on the
/// lower one: sin^2 of 45 degrees.
constexpr double kScattered = .5;

class LampsAtSurfaces : public ::testing::TestWithParam<Method> {
  protected:
    /// Light absorbed by the lower disk.
    [[nodiscard]] Estimate absorbed(double rho, const std::shared_ptr<const Source>& lamp) const {
        return run(make_two_disks(rho), {lamp}, spec_of(GetParam(), 1 << 13))
            .at(1, Quantity::absorbed_flux, 0);
    }
};

/// Half of the light falls on the housing right beside the lamp.
TEST_P(LampsAtSurfaces, APointJustBelowItsHousingLightsItAndTheRest) {
    for (const double gap : {1e-3, 1e-4, 1e-5, 1e-6, 3e-7, 1e-7}) {
        // The light that passes the rim of the housing, and where light falls on it.
        const double up = .5 * (1 - gap / std::hypot(gap, 1));
        const double expected =
            .5 * (1 - (1 - gap) / std::hypot(1 - gap, 1)) + .8 * up * kScattered;
        EXPECT_TRUE(holds(
            {fmt::format("a point lamp {} below a grey disk: light on the disk below", gap),
             expected, .004, 12},
            absorbed(.8, lamp_at({0, 0, 1 - gap}, {}, isotropic_pattern(), {0, 0, -1}))));
    }
}

/// A light-emitting diode in the plane of its housing shines away from it, unhindered.
TEST_P(LampsAtSurfaces, ADiskInThePlaneOfItsHousingShinesAway) {
    const Opening opening{.kind = Opening::Kind::disk, .radius = .01};
    const Opening square{.kind = Opening::Kind::rectangle, .length = .01, .width = .01};
    for (const double gap : {0.0, 1e-7, 1e-6}) {
        for (const Opening& led : {opening, square}) {
            EXPECT_TRUE(holds(
                {fmt::format("a small flat lamp {} below its housing", gap), kScattered, .003, 12},
                absorbed(.8, lamp_at({0, 0, 1 - gap}, led, cosine_pattern(), {0, 0, -1}))));
        }
    }
}

/// A disk close to its housing, and facing it, lights a spot of its own size.
TEST_P(LampsAtSurfaces, ADiskThatShinesAtItsHousingLightsASpot) {
    const Opening opening{.kind = Opening::Kind::disk, .radius = .01};
    const Opening square{.kind = Opening::Kind::rectangle, .length = .01, .width = .01};
    for (const double gap : {1e-6, 1e-4}) {
        for (const Opening& led : {opening, square}) {
            EXPECT_TRUE(holds(
                {fmt::format("a small flat lamp that shines at its housing, {} below it", gap),
                 .8 * kScattered, .005, 8},
                absorbed(.8, lamp_at({0, 0, 1 - gap}, led, cosine_pattern(), {0, 0, 1}))));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    BothWays,
    LampsAtSurfaces,
    ::testing::Values(Method::light_tracing, Method::from_organs),
    name_of);

/// A floor, a wall beside it and a leaf above.
Scene make_corner_with_leaf() {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .3, .3));
    builder.add_organ(organ("floor", "leaf", floor_of(0, 1, 0, 1, 0)));
    builder.add_organ(organ("wall", "leaf", make_parallelogram({0, 0, 0}, {0, 0, 1}, {0, 1, 0})));
    builder.add_organ(
        organ("leaf", "leaf", {{Vec3{.43, .48, .92}, {.85, .65, .83}, {.61, .39, .87}}}));
    return std::move(builder).build();
}

/// A long lamp lights nearby surfaces brightly, and paths from organs rarely sample them.
TEST(LampsNextToSurfaces, IntervalsHoldTheLightThatIsScatteredNextToThem) {
    const Scene scene = make_corner_with_leaf();
    const Opening line{.kind = Opening::Kind::line, .length = .78};
    const Opening panel{.kind = Opening::Kind::rectangle, .length = .3, .width = .2};
    const std::vector<Light> lamps{
        {"line", lamp_at({.5, .45, .001}, line, tube_pattern(), normalized(Vec3{.6, .5, 0}))},
        {"panel", lamp_at({.5, .5, 1e-4}, panel, cosine_pattern(), {0, 0, -1})}};
    for (const Light& lamp : lamps) {
        const Result truth = run(scene, {lamp.source}, spec_of(Method::light_tracing, 1 << 14));
        int right = 0;
        int all = 0;
        for (int seed = 1; seed <= 20; ++seed) {
            RunSpec spec;
            spec.method = Method::from_organs;
            spec.threads = 1;
            spec.seed = static_cast<std::uint64_t>(seed);
            spec.paths = 512 * scene.organs().size();
            const Result result = run(scene, {lamp.source}, spec);
            for (std::size_t i = 0; i < scene.organs().size(); ++i, ++all) {
                const Estimate& e = result.at(i, Quantity::incident_scattered, 0);
                const Estimate& exact = truth.at(i, Quantity::incident_scattered, 0);
                right += e.ci95_low <= exact.ci95_high && exact.ci95_low <= e.ci95_high ? 1 : 0;
            }
        }
        EXPECT_GE(right, .93 * all) << lamp.name << ' ' << right << " of " << all;
        RecordProperty("next_to_a_" + lamp.name, std::to_string(right));
    }
}

/// The number of intervals of 100 seeds that contain the true light on a floor of 1 x 1.
int intervals_right(const Sources& lamp) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("floor", "black", floor_of(0, 1, 0, 1, 0)));
    const Scene scene = std::move(builder).build();
    const double truth = run(scene, lamp, spec_of(Method::light_tracing, 1 << 14))
                             .at(0, Quantity::incident_upper, 0)
                             .mean;
    int right = 0;
    for (int seed = 1; seed <= 100; ++seed) {
        RunSpec spec;
        spec.method = Method::from_organs;
        spec.threads = 1;
        spec.seed = static_cast<std::uint64_t>(seed);
        spec.paths = 256;
        const Estimate e = run(scene, lamp, spec).at(0, Quantity::incident_upper, 0);
        right += e.ci95_low <= truth && truth <= e.ci95_high ? 1 : 0;
    }
    return right;
}

/// The irradiance below a line grows as 1 / distance: few of the points of a floor lie in the
/// bright strip next to it.
TEST(LampsNextToSurfaces, IntervalsHoldTheLightOfALineNextToThem) {
    const Opening line{.kind = Opening::Kind::line, .length = .7};
    const Sources lamp{lamp_at({.5, .5, 1e-4}, line, tube_pattern(), normalized(Vec3{.6, .5, 0}))};
    EXPECT_GE(intervals_right(lamp), 90);
}

/// Nor do many lie below a panel that is small beside the floor, however bounded its irradiance.
TEST(LampsNextToSurfaces, IntervalsHoldTheLightOfASmallPanelNextToThem) {
    const Opening panel{.kind = Opening::Kind::rectangle, .length = .004, .width = .004};
    for (const double height : {5e-3, 1e-2, .05, .3}) {
        const Sources lamp{lamp_at({.5, .5, height}, panel, cosine_pattern(), {0, 0, -1})};
        EXPECT_GE(intervals_right(lamp), 90) << height;
    }
}

/// A panel exactly in the plane of a surface lights only one side.
TEST(LampsNextToSurfaces, APanelInThePlaneOfASurfaceDoesNotLightIt) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .3, .3));
    builder.add_organ(organ("ceiling", "leaf", floor_of(0, 1, 0, 1, 0)));
    builder.add_organ(organ("leaf", "leaf", {{Vec3{0, .3, -.3}, {.5, .3, -.35}, {.3, .6, -.3}}}));
    const Scene scene = std::move(builder).build();
    const Opening panel{.kind = Opening::Kind::rectangle, .length = .3, .width = .2};
    const Sources lamp{lamp_at({.5, .5, 0}, panel, cosine_pattern(), {0, 0, -1})};
    const Result truth = run(scene, lamp, spec_of(Method::light_tracing, 1 << 14));
    const Result result = run(scene, lamp, spec_of(Method::from_organs, 1 << 13));
    EXPECT_EQ(result.at(0, Quantity::incident_direct, 0).mean, 0);
    for (const Quantity quantity : {Quantity::incident_upper, Quantity::incident_scattered}) {
        const Measured expected = measured(truth.at(1, quantity, 0), kReplicates);
        EXPECT_TRUE(agrees(
            measured(result.at(1, quantity, 0), kReplicates), expected, .5 * expected.mean,
            kLevel / 2));
    }
}

/// A leaf of a square metre with a point lamp close above its centre: its share of the solid angle.
TEST(LampsNearOrgans, APointLampGivesItsShareAtAnyDistance) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("leaf", "black", floor_of(-.5, .5, -.5, .5, 0)));
    const Scene scene = std::move(builder).build();
    for (const double d : {1e-4, 1e-3, .01, .1, .3, 1.0}) {
        const double expected = std::atan(.25 / (d * std::sqrt(.5 + d * d))) / pi;
        const auto lamp = lamp_at({.013, .008, d}, {}, isotropic_pattern(), {0, 0, -1});
        const Result result = run(scene, {lamp}, spec_of(Method::from_organs, 1 << 13));
        if (d < .02) {
            EXPECT_TRUE(holds(
                {fmt::format("a point lamp {} above a leaf", d), expected, .01 * expected, 6},
                result.at(0, Quantity::absorbed_flux, 0)));
        }
    }
}

/// Leaves, some of them measured, and lamps among them, some close to leaves.
TEST(LampsNearOrgans, LampsAmongLeavesGiveTheSameFromOrgansAndSources) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .4, .3));
    const std::vector<Triangle> leaves = random_leaves(40, .3, 1, 3);
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        OrganSpec leaf = organ("", "leaf", {leaves[i]});
        leaf.measured = i < 3;
        builder.add_organ(leaf);
    }
    const Scene scene = std::move(builder).build();
    Sources lamps;
    for (std::size_t i = 0; i < 8; ++i) {
        const Triangle& t = leaves[i];
        const Vec3 middle = (t[0] + t[1] + t[2]) / 3.0;
        const Vec3 up = normalized(cross(t[1] - t[0], t[2] - t[0]));
        lamps.push_back(lamp_at(
            middle + std::pow(10.0, -1 - .5 * static_cast<double>(i)) * up, {}, isotropic_pattern(),
            {0, 0, -1}));
    }
    const Result truth = run(scene, lamps, spec_of(Method::light_tracing, 1 << 15));
    const Result result = run(scene, lamps, spec_of(Method::from_organs, 1 << 13));
    for (std::size_t i = 0; i < 3; ++i) {
        for (const Quantity quantity :
             {Quantity::incident_upper, Quantity::incident_lower, Quantity::incident_scattered}) {
            const Measured expected = measured(truth.at(i, quantity, 0), kReplicates);
            EXPECT_TRUE(agrees(
                measured(result.at(i, quantity, 0), kReplicates), expected, .35 * expected.mean,
                kLevel / 9))
                << i << ' ' << quantity_table()[static_cast<std::size_t>(quantity)].name;
        }
    }
}

/// A sun that grazes infinite rows lights few spots of most leaves: the intervals contain the
/// truth.
TEST(GrazingSuns, IntervalsHoldTheFewSpotsThatAreLit) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .1, .1));
    add_leaves(builder, random_leaves(60, .35, 1, 3));
    builder.set_cell({.along_x = true, .along_y = true, .size_x = 1, .size_y = 1});
    const Scene scene = std::move(builder).build();
    const Sources light{sun(84, {1})};
    RunSpec fine = spec_of(Method::first_hits, 1 << 15);
    const Result truth = run(scene, light, fine);
    int right = 0;
    int all = 0;
    for (int seed = 1; seed <= 20; ++seed) {
        RunSpec spec;
        spec.method = Method::from_organs;
        spec.threads = 1;
        spec.seed = static_cast<std::uint64_t>(seed);
        spec.paths = 16 * scene.organs().size();
        const Result result = run(scene, light, spec);
        for (std::size_t i = 0; i < scene.organs().size(); ++i, ++all) {
            const Estimate& e = result.at(i, Quantity::incident_direct, 0);
            const Estimate& exact = truth.at(i, Quantity::incident_direct, 0);
            right += e.ci95_low <= exact.ci95_high && exact.ci95_low <= e.ci95_high ? 1 : 0;
        }
    }
    EXPECT_GE(right, .93 * all) << right << " of " << all;
}

}  // namespace
}  // namespace quasimc::test

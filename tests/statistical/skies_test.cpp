// Whole runs under every kind of sky: plates, canopies, and both directions of tracing.

#include "support/skies.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "geometry/shapes/shapes.h"
#include "statistical/canopies.h"
#include "statistical/comparison.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

Scene one_plate(std::vector<Triangle> triangles) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("plate", "black", std::move(triangles)));
    return std::move(builder).build();
}

class UnderSkies : public BothWays {
  protected:
    static constexpr std::size_t kWays = 3;

    /// Whether a sky is in the third that the ordinary run covers with this method: the three
    /// methods together cover all.
    [[nodiscard]] static bool is_in_ordinary_run(std::size_t sky) {
        return sky % kWays == static_cast<std::size_t>(GetParam()) % kWays;
    }

    /// Compares the requested irradiance, to 1e-4, by tracing; by pixels to 1e-2.
    void expect_irradiance_on_a_plate(bool in_ordinary_run) const {
        const Scene scene = one_plate(floor_of(0, 1, 0, 1, 0));
        const auto skies = sample_of_skies({1});
        for (std::size_t i = 0; i < skies.size(); ++i) {
            if (is_in_ordinary_run(i) != in_ordinary_run) {
                continue;
            }
            const Source& sky = *skies[i];
            const Result result = trace(scene, {skies[i]}, 1 << 16);
            EXPECT_TRUE(holds(
                {"horizontal plate, " + sky.name(), sky.horizontal_irradiance(),
                 resolution(1e-4, 1e-2), static_cast<unsigned>(skies.size())},
                result.at(0, Quantity::incident_upper, 0)));
            EXPECT_EQ(result.at(0, Quantity::incident_lower, 0).mean, 0);
        }
    }
};

class UnderTheOtherSkies : public UnderSkies {};

TEST_P(UnderSkies, AHorizontalPlateReceivesTheIrradianceAskedFor) {
    expect_irradiance_on_a_plate(true);
}

TEST_P(UnderTheOtherSkies, AHorizontalPlateReceivesTheIrradianceAskedFor) {
    expect_irradiance_on_a_plate(false);
}

/// 3/14 + 4/(7 pi) of the horizontal irradiance.
TEST_P(UnderSkies, AVerticalPlateReceivesItsShareOfTheOvercastSky) {
    const Scene scene = one_plate(make_parallelogram({0, 0, 0}, {.6, .8, 0}, {0, 0, 1}));
    const auto sky = make_sky("overcast", cie_overcast_shape(), {1});
    const Result result = trace(scene, {sky}, 1 << 15);
    for (const Quantity side : {Quantity::incident_upper, Quantity::incident_lower}) {
        EXPECT_TRUE(holds(
            {fmt::format(
                 "vertical plate, overcast sky, {} side",
                 side == Quantity::incident_upper ? "one" : "other"),
             .396177, resolution(2e-3, 5e-3), 2},
            result.at(0, side, 0)));
    }
}

TEST_P(UnderSkies, BlackLeavesTakeTheOvercastSkysLightByBeersLaw) {
    const auto sky = make_sky("overcast", cie_overcast_shape(), {1});
    const CanopySpec spec{
        .leaf_area_index = 1, .leaf = diffuse("leaf", 0, 0), .soil = diffuse("soil", 0, 0)};
    // With few directions all leaves of a canopy get the same ones.
    const std::uint64_t paths = GetParam() == Method::first_hits ? 1 << 15 : 1 << 13;
    const auto numbers = [&](std::uint64_t seed) {
        const Result result = trace_once(make_canopy(spec, seed), {sky}, GetParam(), paths, seed);
        return std::vector<double>{
            result.at(kCanopy, Quantity::absorbed_flux, 0).mean / kCellArea,
            result.at(kSoil, Quantity::incident_upper, 0).mean};
    };
    const std::vector<Measured> m = over_seeds(64, numbers);
    EXPECT_TRUE(holds({"black canopy LAI 1, overcast sky, absorbed", 1 - .473220, .01, 2}, m[0]));
    EXPECT_TRUE(holds({"black canopy LAI 1, overcast sky, on the soil", .473220, 8e-3, 2}, m[1]));
}

/// A sun disk of 5 degrees at the edge of a roof: the lit part of the ground has a soft border, and
/// as much of it is sunlit as under a point.
TEST_P(UnderSkies, TheSunsDiskLightsAsMuchGroundAsAPointWould) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("floor", "black", floor_of(-2, 2, -2, 2, 0)));
    builder.add_organ(organ("roof", "black", floor_of(-1, 1, -1, 1, 1)));
    const Scene scene = std::move(builder).build();
    const auto disk = make_sun_disk("sun", sun_at(75), 5, {1});
    const Result result = trace(scene, {disk}, 1 << 15);
    const double lit = 1 - 4.0 / 16;
    EXPECT_TRUE(holds(
        {"floor under a roof, disk of the sun, sunlit", lit, 2e-3, 2}, result.sunlit_fraction[0]));
    EXPECT_TRUE(holds(
        {"floor under a roof, disk of the sun, irradiance",
         lit * std::sin(75 * std::numbers::pi / 180), 2e-3, 2},
        result.at(0, Quantity::incident_upper, 0)));
}

QUASIMC_BOTH_WAYS(UnderSkies);
QUASIMC_BOTH_WAYS_LONG(UnderTheOtherSkies);

/// Thirty glossy leaves, some of them mirrors on one side, above a ground.
Scene make_stand_under_skies(const Cell& cell) {
    SceneBuilder builder = make_builder(2);
    MaterialSpec leaf = diffuse("leaf", .3, .2, 2);
    leaf.upper[0].reflection_model = "phong";
    leaf.upper[0].reflection_parameters["exponent"] = 8;
    for (SideOptics& side : leaf.lower) {
        side.reflection_model = "mirror";
    }
    builder.add_material(leaf);
    builder.add_material(diffuse("soil", .3, 0, 2));
    add_leaves(builder, random_leaves(30, .35, 1, 7));
    GroundSpec soil = ground("soil");
    soil.height = -.2;
    builder.set_ground(soil);
    builder.set_cell(cell);
    return std::move(builder).build();
}

class BothWaysUnderSkies : public ::testing::TestWithParam<bool> {};

TEST_P(BothWaysUnderSkies, GiveTheSameLightOnEveryOrgan) {
    const Cell layer{.along_x = true, .along_y = true, .size_x = .8, .size_y = 1.1};
    const Scene scene = make_stand_under_skies(GetParam() ? layer : Cell{});
    const auto skies = sample_of_skies({1, .7});
    Comparison comparison(static_cast<unsigned>(skies.size()));
    RunSpec spec = spec_of(Method::light_tracing, 1 << 12);
    for (const auto& sky : skies) {
        SCOPED_TRACE(sky->name());
        ++spec.seed;
        spec.method = Method::light_tracing;
        const Result forward = run(scene, {sky}, spec);
        spec.seed += 1000;
        spec.method = Method::from_organs;
        const Result backward = run(scene, {sky}, spec);
        EXPECT_TRUE(comparison.totals_agree(forward, backward));
        EXPECT_TRUE(comparison.organs_agree(forward, backward));
    }
    EXPECT_TRUE(comparison.are_sharp(.1, .8));
    EXPECT_TRUE(comparison.scatter_is_that_of_errors(1));
}

INSTANTIATE_TEST_SUITE_P(Scenes, BothWaysUnderSkies, ::testing::Bool(), [](const auto& scene) {
    return scene.param ? "Periodic" : "Open";
});

}  // namespace
}  // namespace quasimc::test

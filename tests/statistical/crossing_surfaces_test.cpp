// Ray bundles where surfaces cross: leaves that begin inside a stem, extend below the ground, or
// cross each other; against light tracing.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "statistical/bundle_checks.h"
#include "statistical/scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

/// PAR and NIR.
MaterialSpec of_two_bands(std::string name, double dark, double bright, double passes) {
    MaterialSpec material = diffuse(std::move(name), dark, 0, 2);
    for (SideOptics* side : {&material.upper[1], &material.lower[1]}) {
        side->reflectance = bright;
        side->transmittance = passes;
    }
    return material;
}

SceneBuilder builder_of_plants() {
    SceneBuilder builder = make_builder(2);
    builder.add_material(of_two_bands("leaf", .1, .46, .42));
    builder.add_material(of_two_bands("stem", .1, .6, 0));
    builder.add_material(of_two_bands("soil", .15, .3, 0));
    return builder;
}

/// A closed upright cylinder.
std::vector<Triangle> stem_at(double x, double y, double low, double high, double radius) {
    return make_cylinder({x, y, low}, {0, 0, high - low}, radius, radius, 8, true);
}

/// A leaf that begins on the axis of its stem and rises away from it.
std::vector<Triangle> leaf_from(const Vec3& base, double turn, double length, double width) {
    const double angle = 2 * std::numbers::pi * turn;
    const Vec3 along{length * std::cos(angle), length * std::sin(angle), .3 * length};
    const Vec3 across{-width * std::sin(angle), width * std::cos(angle), 0};
    return make_parallelogram(base - .5 * across, along, across);
}

/// Eight leaves that begin on the axis of a closed stem.
Scene leaves_in_a_stem() {
    SceneBuilder builder = builder_of_plants();
    builder.add_organ(organ("stem", "stem", stem_at(0, 0, 0, 1, .05)));
    for (int i = 0; i < 8; ++i) {
        builder.add_organ(organ(
            fmt::format("leaf {}", i), "leaf", leaf_from({0, 0, .2 + .09 * i}, .38 * i, .5, .12)));
    }
    return std::move(builder).build();
}

/// Leaves and a stem that extend below the ground.
Scene leaves_through_the_ground() {
    SceneBuilder builder = builder_of_plants();
    builder.add_organ(organ("stem", "stem", stem_at(.5, .5, -.2, .6, .06)));
    for (const Triangle& triangle : random_leaves(12, .5, 1, 4)) {
        std::vector<Triangle> leaf{triangle};
        for (Vec3& corner : leaf[0]) {
            corner.z = .5 * corner.z - .03;
        }
        builder.add_organ(organ("", "leaf", leaf));
    }
    GroundSpec soil = ground("soil");
    soil.extent = std::array<double, 4>{-.5, -.5, 1.5, 1.5};
    builder.set_ground(soil);
    return std::move(builder).build();
}

/// Two plates that cross, one of them as far as its middle.
Scene crossed_plates() {
    SceneBuilder builder = builder_of_plants();
    builder.add_organ(organ("level", "leaf", floor_of(-1, 1, -1, 1, 0)));
    builder.add_organ(
        organ("through", "stem", make_parallelogram({-.3, -1.2, -.7}, {0, 2.4, 0}, {.4, 0, 1.3})));
    builder.add_organ(organ(
        "half through", "stem", make_parallelogram({.45, -.2, -.7}, {0, 2.4, 0}, {.1, 0, 1.3})));
    return std::move(builder).build();
}

/// An infinite stand of stems, one of them on the corner of the cell, with leaves that begin in
/// them and extend over the border, down to the ground and through each other.
Scene stems_on_the_border() {
    SceneBuilder builder = builder_of_plants();
    constexpr std::pair<double, double> kPoints[]{{0, 0}, {.5, 1.02}};
    for (const auto& [x, y] : kPoints) {
        builder.add_organ(organ("", "stem", stem_at(x, y, -.1, .7, .06)));
        for (int i = 0; i < 5; ++i) {
            builder.add_organ(
                organ("", "leaf", leaf_from({x, y, .1 + .12 * i}, .38 * i + x, .45, .15)));
        }
    }
    builder.set_ground(ground("soil"));
    builder.set_cell({.along_x = true, .along_y = true});
    return std::move(builder).build();
}

struct CrossingCase {
    const char* name;
    Scene (*make)();
};
constexpr CrossingCase kCrossingCases[]{
    {"LeavesInAStem", leaves_in_a_stem},
    {"LeavesThroughTheGround", leaves_through_the_ground},
    {"CrossedPlates", crossed_plates},
    {"StemsOnTheBorder", stems_on_the_border},
};

class CrossedScenes : public ::testing::TestWithParam<CrossingCase> {};

/// Surfaces inside a stem or below the ground exchange no light with the outside. If a patch were
/// on both sides, the stem would have 5 to 12 % too much of the bright band.
TEST_P(CrossedScenes, AgreeWithLightTracingOrganByOrgan) {
    const Scene scene = GetParam().make();
    for (const auto& source : {sun(35, {1, 1}), sky({1, 1})}) {
        RunSpec plain_spec = spec_of(Method::light_tracing, 1 << 15);
        plain_spec.seed = 2;
        const Result own = run(scene, {source}, bundles(1 << 13));
        const Result plain = run(scene, {source}, plain_spec);
        expect_same(scene, own, plain, .01);
        for (std::size_t organ = 0; organ < own.organs(); ++organ) {
            for (std::size_t band = 0; band < own.bands; ++band) {
                const Estimate& a = own.at(organ, Quantity::absorbed_flux, band);
                const Estimate& b = plain.at(organ, Quantity::absorbed_flux, band);
                const double error = std::hypot(a.standard_error, b.standard_error);
                const double chance = kLevel / static_cast<double>(2 * 4 * own.organs());
                EXPECT_LE(
                    std::abs(a.mean - b.mean),
                    student_t_quantile(1 - chance / 2, kReplicates - 1) * error)
                    << "organ " << organ << ", band " << band;
            }
        }
    }
}

/// No light enters a closed stem, except through rounding.
TEST(CrossingSurfaces, LeaveTheInsideOfAStemDark) {
    SceneBuilder builder = builder_of_plants();
    builder.add_material(of_two_bands("bright stem", .1, .95, 0));
    builder.add_organ(organ("stem", "bright stem", stem_at(0, 0, 0, 1, .05)));
    for (int i = 0; i < 8; ++i) {
        builder.add_organ(organ(
            fmt::format("leaf {}", i), "leaf", leaf_from({0, 0, .2 + .09 * i}, .38 * i, .5, .12)));
    }
    const Scene scene = std::move(builder).build();
    const Result result = run(scene, {sky({1, 1})}, bundles(1 << 13));
    const double outside = result.at(0, Quantity::incident_upper, 1).mean;
    EXPECT_GT(outside, .1);
    EXPECT_LT(result.at(0, Quantity::incident_lower, 1).mean, 1e-4 * outside);
}

class CrossingCoverage : public ::testing::TestWithParam<CrossingCase> {};

TEST_P(CrossingCoverage, NinetyFivePercentIntervalsHoldTheTruthAtLeastThatOften) {
    expect_intervals_hold(GetParam().make(), 4096);
}

TEST_P(CrossingCoverage, NinetyFivePercentIntervalsHoldTheTruthWithFewPathsToo) {
    expect_intervals_hold(GetParam().make(), 1024);
}

std::string name_of_case(const ::testing::TestParamInfo<CrossingCase>& info) {
    return info.param.name;
}
INSTANTIATE_TEST_SUITE_P(, CrossedScenes, ::testing::ValuesIn(kCrossingCases), name_of_case);
INSTANTIATE_TEST_SUITE_P(Long, CrossingCoverage, ::testing::ValuesIn(kCrossingCases), name_of_case);

}  // namespace
}  // namespace quasimc::test

#include "optics/material.h"

#include <numbers>

#include <gtest/gtest.h>

#include "optics_testing.h"

namespace quasimc::test {
namespace {

constexpr Vec3 kUp{0, 0, 1};
constexpr Vec3 kSlanted{0.6, 0, 0.8};

MaterialSpec leaf(SideOptics upper, SideOptics lower) {
    return {"leaf", {std::move(upper)}, {std::move(lower)}};
}

TEST(Material, KnowsASensorFromAPaneAndALeaf) {
    const SideOptics through{.transmittance = 1, .transmission_model = "mirror"};
    const SideOptics pane{.transmittance = 0.99, .transmission_model = "mirror"};
    const SideOptics paper{.transmittance = 1};
    const SideOptics mirror{.reflectance = 1, .reflection_model = "mirror"};
    EXPECT_TRUE(make_material(leaf(through, through), 1).is_transparent());
    EXPECT_FALSE(make_material(leaf(through, pane), 1).is_transparent());
    EXPECT_FALSE(make_material(leaf(pane, through), 1).is_transparent());
    EXPECT_FALSE(make_material(leaf(paper, paper), 1).is_transparent());
    EXPECT_FALSE(make_material(leaf(mirror, mirror), 1).is_transparent());
    EXPECT_FALSE(make_material(leaf({}, {}), 1).is_transparent());
    const MaterialSpec half{"half", {through, pane}, {through, through}};
    EXPECT_FALSE(make_material(half, 2).is_transparent());
}

TEST(Material, GathersThroughTheOtherSidesTransmittance) {
    const Material m = make_material(
        leaf({.reflectance = 0.25, .transmittance = 0.5}, {.transmittance = 0.125}), 1);
    // To the upper side lead its own reflectance, 0.25, and the lower side's transmittance, 0.125.
    std::vector<double> weights{1.0};
    const auto from_above = m.gather(kUp, SurfaceSide::upper, kSlanted, {0.2, 0.5}, weights);
    ASSERT_TRUE(from_above);
    EXPECT_LT(from_above->wi.z, 0);
    const auto from_below = m.gather(kUp, SurfaceSide::upper, kSlanted, {0.3, 0.5}, weights);
    ASSERT_TRUE(from_below);
    EXPECT_GT(from_below->wi.z, 0);
    EXPECT_FALSE(m.gather(kUp, SurfaceSide::upper, kSlanted, {0.376, 0.5}, weights));
    EXPECT_DOUBLE_EQ(weights[0], 1);
    // To the lower side leads the upper side's transmittance alone.
    const auto on_lower = m.gather(-kUp, SurfaceSide::lower, -kSlanted, {0.49, 0.5}, weights);
    ASSERT_TRUE(on_lower);
    EXPECT_LT(on_lower->wi.z, 0);
    EXPECT_FALSE(m.gather(-kUp, SurfaceSide::lower, -kSlanted, {0.51, 0.5}, weights));
}

TEST(Material, GathersWithGrowingWeightsWhereMoreThanAllLightLeadsToOneSide) {
    const Material m = make_material(leaf({.reflectance = 0.9}, {.transmittance = 0.6}), 1);
    std::vector<double> weights{1.0};
    ASSERT_TRUE(m.gather(kUp, SurfaceSide::upper, kSlanted, {0.59, 0.5}, weights));
    EXPECT_DOUBLE_EQ(weights[0], 1.5);
    weights = {1.0};
    const auto through = m.gather(kUp, SurfaceSide::upper, kSlanted, {1 - 0x1p-53, 0.5}, weights);
    ASSERT_TRUE(through);
    EXPECT_GT(through->wi.z, 0);
    EXPECT_DOUBLE_EQ(weights[0], 1.5);
}

TEST(Material, GathersMoreThanAllLightOfSeveralBands) {
    const SideOptics bright{.reflectance = 0.9};
    const SideOptics dim{.reflectance = 0.2};
    const SideOptics thin{.transmittance = 0.7};
    const Material m = make_material({"leaf", {bright, dim}, {thin, thin}}, 2);
    // Powers 0.9 + 0.2 reflected and 0.7 + 0.7 from below, 2.5 in all, of weights 2.
    std::vector<double> weights{1.0, 1.0};
    const auto reflected = m.gather(kUp, SurfaceSide::upper, kSlanted, {0.43, 0.5}, weights);
    ASSERT_TRUE(reflected);
    EXPECT_LT(reflected->wi.z, 0);
    EXPECT_DOUBLE_EQ(weights[0], 0.9 * 2.5 / 1.1);
    EXPECT_DOUBLE_EQ(weights[1], 0.2 * 2.5 / 1.1);
    weights = {1.0, 1.0};
    const auto through = m.gather(kUp, SurfaceSide::upper, kSlanted, {0.45, 0.5}, weights);
    ASSERT_TRUE(through);
    EXPECT_GT(through->wi.z, 0);
    EXPECT_DOUBLE_EQ(weights[0], 0.7 * 2.5 / 1.4);
    EXPECT_TRUE(m.gather(kUp, SurfaceSide::upper, kSlanted, {1 - 0x1p-53, 0.5}, weights));
}

TEST(Material, GathersAlongTheDirectionOfAMirror) {
    const Material m = make_material(
        leaf(
            {.reflectance = 0.5, .reflection_model = "mirror"},
            {.transmittance = 0.25, .transmission_model = "mirror"}),
        1);
    std::vector<double> weights{1.0};
    const auto mirrored = m.gather(kUp, SurfaceSide::upper, kSlanted, {0.4, 0.5}, weights);
    ASSERT_TRUE(mirrored);
    EXPECT_TRUE(mirrored->narrow);
    EXPECT_EQ(mirrored->wi, (Vec3{0.6, 0, -0.8}));
    const auto through = m.gather(kUp, SurfaceSide::upper, kSlanted, {0.6, 0.5}, weights);
    ASSERT_TRUE(through);
    EXPECT_EQ(through->wi, kSlanted);
    EXPECT_DOUBLE_EQ(weights[0], 1);
    std::vector<double> out{0.0};
    m.add_reflected(kUp, SurfaceSide::upper, kSlanted, {0.6, 0, -0.8}, 1, weights, out);
    EXPECT_EQ(out[0], 0) << "a mirror is followed, not looked up";
}

TEST(Material, GathersNothingButNumbersAlongTheSurface) {
    const Material m = make_material(varied_leaf(4, 4), 4);
    Random random(13);
    for (const double z : {0.0, 1e-320, 1e-17, 1e-9}) {
        const Vec3 wo = normalized({1, 0, z});
        for (int i = 0; i < 1000; ++i) {
            std::vector<double> weights(4, 1.0);
            const double u0 = random();
            const auto gathered = m.gather(kUp, SurfaceSide::upper, wo, {u0, random()}, weights);
            for (const double w : weights) {
                ASSERT_TRUE(std::isfinite(w) && w >= 0) << z;
            }
            std::vector<double> out(4, 0.0);
            if (gathered) {
                ASSERT_TRUE(is_finite(gathered->wi));
                m.add_reflected(kUp, SurfaceSide::upper, wo, gathered->wi, 1, weights, out);
            }
        }
    }
}

TEST(Material, LooksUpLambertianLightFromBothSides) {
    const Material m = make_material(
        leaf({.reflectance = 0.5, .transmittance = 0.25}, {.transmittance = 0.125}), 1);
    const std::vector<double> weights{2.0};
    std::vector<double> out{1.0};
    m.add_reflected(kUp, SurfaceSide::upper, kSlanted, -kSlanted, 3, weights, out);
    EXPECT_DOUBLE_EQ(out[0], 1 + 3 * 2 * 0.5 * 0.8 / std::numbers::pi);
    out = {1.0};
    m.add_reflected(kUp, SurfaceSide::upper, kUp, kSlanted, 3, weights, out);
    EXPECT_DOUBLE_EQ(out[0], 1 + 3 * 2 * 0.125 * 0.8 / std::numbers::pi);
    out = {1.0};
    m.add_reflected(-kUp, SurfaceSide::lower, -kUp, -kSlanted, 3, weights, out);
    EXPECT_DOUBLE_EQ(out[0], 1 + 3 * 2 * 0.25 * 0.8 / std::numbers::pi);
}

}  // namespace
}  // namespace quasimc::test

#include "transport/prepared_scene.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "scene/scene.h"
#include "solvers/direct/visibility.h"
#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

/// A floor of 2 x 3, in one infinite layer: 6 square metres of light for each unit overhead.
Scene make_layer(std::size_t bands, const std::vector<OrganSpec>& more = {}) {
    SceneBuilder builder = make_builder(bands);
    builder.add_material(diffuse("leaf", .1, .1, bands));
    builder.add_material(net("mirror", std::vector<double>(bands, .5)));
    builder.add_material(sensor("sensor", bands));
    builder.add_organ(organ("floor", "leaf", floor_of(0, 2, 0, 3, 0)));
    for (const OrganSpec& spec : more) {
        builder.add_organ(spec);
    }
    builder.set_cell({.along_x = true, .along_y = true, .size_x = 2, .size_y = 3});
    return std::move(builder).build();
}

/// A stage and the objects that it refers to.
struct Staged {
    Scene scene;
    Sources sources;
    PreparedScene prepared;

    Staged(Scene of, Sources under)
        : scene(std::move(of)),
          sources(std::move(under)),
          prepared(
              scene,
              sources,
              StartArea::silhouette,
              std::make_shared<RayCaster>(
                  data_of(scene).geometry, scene.cell(), Accelerator::embree)) {}
    Staged(const Staged&) = delete;
    Staged& operator=(const Staged&) = delete;
};

TEST(PreparedScene, AddsUpTheFluxOfAllSources) {
    const Staged staged(make_layer(2), {sun(60, {2, 0}), sky({1, 5})});
    const PreparedScene& prepared = staged.prepared;
    EXPECT_NEAR(prepared.lights().flux()[0], 6 * (2 * .5 + 1), 1e-9);
    EXPECT_NEAR(prepared.lights().flux()[1], 6 * 5, 1e-9);
    EXPECT_NEAR(prepared.lights().sun_area(), 6 * .5, 1e-9);
}

TEST(PreparedScene, SharesThePathsOutByTheMeanOverTheBands) {
    const Staged staged(make_layer(2), {sun(0, {1, 1}), sky({3, 0}), sun(0, {0, 0})});
    const PreparedScene& prepared = staged.prepared;
    ASSERT_EQ(prepared.lights().size(), 2U) << "a source without light is left out";
    // The sun has a quarter of band 0, and all of band 1.
    EXPECT_NEAR(prepared.lights()[0].probability, (.25 + 1) / 2, 1e-12);
    EXPECT_NEAR(prepared.lights()[1].probability, .75 / 2, 1e-12);
    EXPECT_EQ(prepared.lights()[0].before, 0);
    EXPECT_NEAR(prepared.lights()[1].before, .625, 1e-12);
}

TEST(PreparedScene, GivesEveryBandStartWeightsOfMeanOne) {
    const Staged staged(
        make_layer(4), {sun(0, {1, 2, 0, 0}), sun(40, {5, 0, 0, 1}), sky({1, 1, 0, 9})});
    const PreparedScene& prepared = staged.prepared;
    for (std::size_t b = 0; b < 4; ++b) {
        double mean = 0;
        for (const BoundSource& light : prepared.lights()) {
            mean += light.probability * light.start_weights[b];
            EXPECT_NEAR(
                light.probability * light.start_weights[b] * prepared.lights().flux()[b],
                light.source->spectrum()[b] * light.source_sampler->flux() *
                    prepared.projection().world_area(),
                1e-12);
        }
        EXPECT_NEAR(mean, b == 2 ? 0 : 1, 1e-12) << "band " << b;  // band 2 has no light
    }
}

TEST(PreparedScene, LightsOfOneColourShareASpectrum) {
    const Staged staged(
        make_layer(2), {sun(0, {1, 3}), sky({1, 1}), sun(50, {.2, .6}), sun(10, {.1, .3})});
    const PreparedScene& prepared = staged.prepared;
    EXPECT_EQ(prepared.lights().spectra().size(), 2U);
    EXPECT_EQ(prepared.lights()[2].spectrum, prepared.lights()[0].spectrum);
    EXPECT_EQ(prepared.lights()[3].spectrum, prepared.lights()[0].spectrum);
    EXPECT_NE(prepared.lights()[1].spectrum, prepared.lights()[0].spectrum);
}

TEST(PreparedScene, PicksEachLightWithItsProbability) {
    const Staged staged(make_layer(1), {sun(0, {1}), sky({2}), sun(30, {3}), sun(50, {.5})});
    const PreparedScene& prepared = staged.prepared;
    EXPECT_EQ(prepared.lights().pick(0).index, 0U);
    EXPECT_EQ(prepared.lights().pick(0x1.fffffffffffffp-1).index, 3U);
    for (std::size_t i = 1; i < 4; ++i) {
        const double border = prepared.lights()[i].before;
        EXPECT_EQ(prepared.lights().pick(border).index, i);
        EXPECT_EQ(prepared.lights().pick(std::nextafter(border, 0)).index, i - 1);
    }
}

TEST(PreparedScene, SplitsTheSunlitAreaAmongTheSuns) {
    const Staged staged(make_layer(1), {sun(0, {1}), sky({2}), sun(60, {3})});
    const PreparedScene& prepared = staged.prepared;
    EXPECT_NEAR(prepared.lights()[0].sun_share, .25, 1e-12);
    EXPECT_EQ(prepared.lights()[1].sun_share, 0);
    EXPECT_NEAR(prepared.lights()[2].sun_share, .75, 1e-12);
}

TEST(PreparedScene, LightPassesSensorsOnItsWayToTheSky) {
    const auto reaches = [](Scene scene) {
        const Staged staged(std::move(scene), {sky({1})});
        const Vec3 p = staged.prepared.caster().mesh().point(0, .3, .3);
        return is_visible_source(
            staged.prepared, p, normalized({.1, .2, 1}), std::numeric_limits<double>::infinity(),
            0);
    };
    EXPECT_TRUE(reaches(make_layer(1)));
    EXPECT_TRUE(reaches(make_layer(
        1, {organ("s", "sensor", floor_of(0, 2, 0, 3, .1)),
            organ("t", "sensor", floor_of(0, 2, 0, 3, .2))})));
    EXPECT_FALSE(reaches(make_layer(
        1, {organ("s", "sensor", floor_of(0, 2, 0, 3, .1)),
            organ("t", "leaf", floor_of(0, 2, 0, 3, .2))})));
}

TEST(PreparedScene, KnowsWhatItsMaterialsAskFor) {
    const Sources light{sky({1})};
    const Staged plain(make_layer(1), light);
    EXPECT_LT(plain.prepared.optics().largest_peak, kNarrowPeak);
    EXPECT_FALSE(plain.prepared.optics().has_transparent);
    const std::vector<Triangle> floor = floor_of(0, 1, 0, 1, .1);
    const Staged shiny(make_layer(1, {organ("m", "mirror", floor)}), light);
    EXPECT_GE(shiny.prepared.optics().largest_peak, kNarrowPeak);
    EXPECT_FALSE(shiny.prepared.optics().has_transparent);
    const Staged watched(make_layer(1, {organ("s", "sensor", floor)}), light);
    EXPECT_TRUE(watched.prepared.optics().has_transparent);
    EXPECT_LT(watched.prepared.optics().largest_peak, kNarrowPeak);
}

}  // namespace
}  // namespace quasimc::test

#include "solvers/direct/sun_pixels.h"

#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "quasimc/run.h"
#include "samplers/catalogue.h"
#include "scene/scene.h"
#include "statistical/scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

constexpr std::uint32_t kSamples = 32;

/// Leaves over a floor, in a periodic cell of 1 x 1, or in the open.
Scene leaves_over_floor(bool repeats) {
    SceneBuilder builder = make_builder(2);
    builder.add_material(diffuse("leaf", .1, .1, 2));
    add_leaves(builder, random_leaves(20, .25, 1, 5));
    builder.add_organ(organ("floor", "leaf", floor_of(0, 1, 0, 1, -.2)));
    if (repeats) {
        builder.set_cell({.along_x = true, .along_y = true, .size_x = 1, .size_y = 1});
    }
    return std::move(builder).build();
}

/// Two beams of different colours and a disk.
Sources three_suns() {
    return {
        sun(20, {300, 200}), sun(50, {100, 300}),
        make_sun_disk("disk", normalized(Vec3{-.4, .3, .8}), .27, {50, 80})};
}

std::vector<SunLight> sun_samples(const PreparedScene& prepared, double pixels) {
    RunSpec spec;
    spec.method = Method::light_tracing;
    const auto sampler = make_sampler(spec.sampler);
    const SunPixels suns({prepared, *sampler, spec}, pixels);
    ItemScratch scratch;
    std::vector<SunLight> found;
    for (std::uint32_t i = 0; i < kSamples; ++i) {
        found.push_back(suns.find(i, scratch));
    }
    return found;
}

/// The same light from scan lines, far more exact.
Result by_lines(const Scene& scene, const Sources& suns) {
    RunSpec spec = spec_of(Method::first_hits, 1 << 18);
    spec.max_depth = 1;
    return run(scene, suns, spec);
}

class SunPixelsOfStand : public ::testing::TestWithParam<bool> {};

TEST_P(SunPixelsOfStand, SeeWhatScanLinesSee) {
    const Scene scene = leaves_over_floor(GetParam());
    const Sources suns = three_suns();
    const PreparedScene prepared(
        scene, suns, StartArea::silhouette,
        std::make_shared<RayCaster>(data_of(scene).geometry, scene.cell(), Accelerator::embree));
    const std::vector<SunLight> found = sun_samples(prepared, 400000);
    const Result lines = by_lines(scene, suns);
    ASSERT_EQ(scene.regions().size(), scene.organs().size());
    for (std::size_t o = 0; o < scene.organs().size(); ++o) {
        SCOPED_TRACE(o);
        const double area = scene.organs()[o].area;
        const auto agree = [&](const auto& value, const Estimate& expected, double most) {
            std::vector<double> values;
            for (const SunLight& light : found) {
                values.push_back(value(light) / area);
            }
            EXPECT_TRUE(agrees(measured(values), measured(expected, kReplicates), .03 * most));
        };
        for (std::size_t b = 0; b < 2; ++b) {
            agree(
                [&](const SunLight& light) {
                    return light.flux[4 * o + b] + light.flux[4 * o + 2 + b];
                },
                lines.at(o, Quantity::incident_direct, b), b == 0 ? 450 : 580);
        }
        agree(
            [&](const SunLight& light) { return light.sunlit_area[o]; }, lines.sunlit_fraction[o],
            1);
    }
    EXPECT_FALSE(agrees(
        measured(lines.at(0, Quantity::incident_direct, 0), kReplicates),
        1.2 * lines.at(0, Quantity::incident_direct, 0).mean, INFINITY))
        << "a control";
}

TEST_P(SunPixelsOfStand, LoseNoLight) {
    const Scene scene = leaves_over_floor(GetParam());
    const Sources suns = three_suns();
    const PreparedScene prepared(
        scene, suns, StartArea::silhouette,
        std::make_shared<RayCaster>(data_of(scene).geometry, scene.cell(), Accelerator::embree));
    for (const SunLight& light : sun_samples(prepared, 1000)) {
        for (std::size_t b = 0; b < 2; ++b) {
            double sum = light.escaped[b];
            for (std::size_t i = b; i < light.flux.size(); i += 2) {
                sum += light.flux[i];
            }
            EXPECT_DOUBLE_EQ(light.emitted[b], prepared.lights().flux()[b]);
            EXPECT_NEAR(sum, light.emitted[b], 1e-12 * light.emitted[b]);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, SunPixelsOfStand, ::testing::Bool());

}  // namespace
}  // namespace quasimc::test

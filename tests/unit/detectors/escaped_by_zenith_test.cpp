#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/angles.h"
#include "detectors/catalogue.h"
#include "quasimc/source.h"
#include "run/simulator.h"
#include "statistical/scenes.h"
#include "sums/sum_data.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

DetectorSpec of_rings(double count) {
    return {.type = "escaped_by_zenith", .parameters = {{"rings", count}}};
}

/// The ring to which light of a direction goes.
std::size_t ring_of(const Vec3& direction, std::size_t count) {
    const auto detector = make_detector(of_rings(static_cast<double>(count)));
    const SumLayout layout(1, {detector_block("it", count, 1)});
    Tally tally(layout);
    constexpr std::array<std::int64_t, 1> kAmount{1};
    detector->on_escape(direction, kAmount, tally.blocks().detector(0), tally);
    ExactBins bins(layout.bins());
    tally.move_into(bins);
    std::size_t ring = 0;
    while (ring < count && bins.quanta(tally.blocks().detector(0) + ring).low == 0) {
        ++ring;
    }
    return ring;
}

TEST(EscapedByZenith, CountsRingsFromTheZenith) {
    EXPECT_EQ(ring_of({0, 0, 1}, 9), 0U);
    EXPECT_EQ(ring_of({0, 0, -1}, 9), 8U);
    EXPECT_EQ(ring_of({1, 0, 0}, 9), 4U);
    EXPECT_EQ(ring_of({0, -1, 0}, 2), 1U);  // a bound belongs to the ring of larger angles
    for (std::size_t i = 0; i < 180; ++i) {
        const double theta = (static_cast<double>(i) + .5) * kRadians;
        EXPECT_EQ(ring_of({0, std::sin(theta), std::cos(theta)}, 180), i);
        EXPECT_EQ(ring_of({-std::sin(theta), 0, std::cos(theta)}, 1), 0U);
    }
}

TEST(EscapedByZenith, NamesItsRings) {
    const DetectorAxis axis = make_detector(of_rings(8))->axis();
    ASSERT_EQ(axis.bins.size(), 8U);
    EXPECT_EQ(axis.bins.front(), "0 to 22.5");
    EXPECT_EQ(axis.bins.back(), "157.5 to 180");
    EXPECT_EQ(make_detector({.type = "escaped_by_zenith"})->axis().bins.size(), 9U);
}

/// Leaves over a ground, seen in two bands.
Scene stand(bool detects, const Cell& cell = {}) {
    SceneBuilder builder = make_builder(2);
    builder.add_material(diffuse("leaf", .4, .3, 2));
    builder.add_organ(organ("leaves", "leaf", random_leaves(40, .4, 1, 5)));
    builder.set_cell(cell);
    if (detects) {
        builder.add_detector(of_rings(7));
        builder.add_detector(
            {.type = "escaped_by_zenith", .name = "all", .parameters = {{"rings", 1}}});
    }
    return std::move(builder).build();
}

/// Sun, sky and a lamp, so that all paths are taken.
Sources lights() {
    LampSpec lamp;
    lamp.name = "lamp";
    lamp.position = {.5, .5, 2};
    lamp.flux = {3, 1};
    return {sun(40, {1, 2}), sky({.5, .2}), make_lamp(std::move(lamp))};
}

RunSpec short_spec(Method method, unsigned threads) {
    RunSpec spec;
    spec.method = method;
    spec.paths = 4096;
    spec.replicates = 3;
    spec.threads = threads;
    return spec;
}

class EscapedLightTest : public ::testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(
    Ways, EscapedLightTest, ::testing::Values(Method::light_tracing, Method::first_hits), name_of);

TEST_P(EscapedLightTest, AddsUpToAllThatEscapesToTheLastBit) {
    for (const bool periodic : {false, true}) {
        const Cell cell =
            periodic ? Cell{.along_x = true, .along_y = true, .size_x = 1, .size_y = 1} : Cell{};
        const Scene scene = stand(true, cell);
        const Sources sources = lights();
        const Sums sums = Simulator().sums(scene, sources, short_spec(GetParam(), 1), 0);
        const LightBlocks blocks(sums->layout);
        for (const ExactBins& bins : sums->replicates) {
            for (std::size_t b = 0; b < 2; ++b) {
                const std::int64_t escaped = bins.quanta(blocks.escaped_scattered() + b).low;
                std::int64_t sum = 0;
                for (std::size_t i = 0; i < 7; ++i) {
                    sum += bins.quanta(blocks.detector(0) + 2 * i + b).low;
                }
                EXPECT_GT(escaped, 0);
                EXPECT_EQ(sum, escaped);
                EXPECT_EQ(bins.quanta(blocks.detector(1) + b).low, escaped);
            }
        }
        EXPECT_EQ(sums, Simulator().sums(scene, sources, short_spec(GetParam(), 3), 0));
    }
}

TEST_P(EscapedLightTest, ChangesNoNumberOfTheOrgans) {
    const Sources sources = lights();
    const Result with = run(stand(true), sources, short_spec(GetParam(), 1));
    const Result without = run(stand(false), sources, short_spec(GetParam(), 1));
    ASSERT_EQ(with.values.size(), without.values.size());
    for (std::size_t i = 0; i < with.values.size(); ++i) {
        EXPECT_EQ(with.values[i].mean, without.values[i].mean);
        EXPECT_EQ(with.values[i].standard_error, without.values[i].standard_error);
    }
    EXPECT_EQ(with.detectors.size(), 2U);
    EXPECT_TRUE(without.detectors.empty());
}

// A horizontal plate that scatters by the cosine law: of what it sends up, the share between two
// zenith angles is the difference of their squared sines, and likewise below.
TEST_P(EscapedLightTest, FollowsTheCosineLawAboveAndBelowAPlate) {
    constexpr double kRho = .6;
    constexpr double kTau = .3;
    constexpr std::size_t kPlateRings = 6;
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", kRho, kTau));
    builder.add_organ(organ("plate", "leaf", floor_of(0, 2, 0, 1, 0)));
    builder.add_detector(of_rings(kPlateRings));
    const Scene scene = std::move(builder).build();
    constexpr double kZenith = 30;
    constexpr double kFlux = 5 * 2;
    RunSpec spec = spec_of(GetParam(), 16384);
    const Result result = run(scene, {sun(kZenith, {5 / std::cos(kZenith * kRadians)})}, spec);
    ASSERT_EQ(result.detectors.size(), 1U);
    for (std::size_t i = 0; i < kPlateRings; ++i) {
        const auto sine2 = [&](std::size_t bound) {
            return std::pow(
                std::sin(std::numbers::pi * static_cast<double>(bound) / kPlateRings), 2);
        };
        const double share = std::abs(sine2(i + 1) - sine2(i));
        const double expected = kFlux * share * (i < kPlateRings / 2 ? kRho : kTau);
        EXPECT_TRUE(holds(
            {"light that leaves a plate, ring " + std::to_string(i), expected, .02 * kFlux,
             kPlateRings},
            result.detectors[0].at(i, 0)));
    }
}

}  // namespace
}  // namespace quasimc::test

// What runs make of detectors, whichever they are.

#include <gtest/gtest.h>

#include "planner/planner.h"
#include "quasimc/series.h"
#include "run/simulator.h"
#include "statistical/scenes.h"
#include "support/listening.h"

namespace quasimc::test {
namespace {

/// A plate that covers a periodic cell, so that no light escapes unscattered; one small leaf that
/// alone is measured.
Scene plate(std::vector<DetectorSpec> detectors) {
    SceneBuilder builder = make_builder(2);
    builder.add_material(diffuse("leaf", .5, .2, 2));
    OrganSpec all = organ("plate", "leaf", floor_of(0, 1, 0, 1, 0));
    all.measured = false;
    builder.add_organ(std::move(all));
    builder.add_organ(organ("leaf", "leaf", floor_of(.5, .501, .5, .501, .1)));
    builder.set_cell({.along_x = true, .along_y = true, .size_x = 1, .size_y = 1});
    for (DetectorSpec& detector : detectors) {
        builder.add_detector(std::move(detector));
    }
    return std::move(builder).build();
}

const DetectorSpec kNineRings{.type = "escaped_by_zenith"};

RunSpec short_spec() {
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.paths = 1024;
    spec.replicates = 4;
    return spec;
}

TEST(DetectedRuns, AddUpToTheEscapedLightOfTheBudget) {
    const Result result = run(plate({kNineRings}), {sky({3, 4})}, short_spec());
    ASSERT_EQ(result.detectors.size(), 1U);
    const DetectorResult& rings = result.detectors[0];
    EXPECT_EQ(rings.name, "escaped_by_zenith");
    EXPECT_EQ(rings.type, "escaped_by_zenith");
    for (std::size_t b = 0; b < 2; ++b) {
        double sum = 0;
        for (std::size_t i = 0; i < rings.bins.size(); ++i) {
            sum += rings.at(i, b).mean;
        }
        EXPECT_GT(sum, 1);
        EXPECT_NEAR(sum, result.budget[b].escaped.mean, 1e-12 * sum);
    }
}

TEST(DetectedRuns, GiveABoundWhereNothingWasSeen) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .5, 0));
    builder.add_organ(organ("plate", "leaf", floor_of(0, 1, 0, 1, 0)));
    builder.add_detector(kNineRings);
    const Result result =
        run(std::move(builder).build(), {sun(0, {2})}, spec_of(Method::light_tracing, 1024));
    const Estimate& below = result.detectors[0].at(8, 0);
    EXPECT_EQ(below.mean, 0);
    // 3 / (1024 paths x 32 replicates) of the emitted flux.
    EXPECT_NEAR(below.ci95_high, 3 * 2 / (1024. * 32), 1e-6);
}

TEST(DetectedRuns, AreRefusedWhereEscapedLightIsNotFollowed) {
    const auto faults_of = [](const Scene& scene, Method method) {
        RunSpec spec = short_spec();
        spec.method = method;
        Faults faults;
        check_run(scene, {sky({1, 1})}, spec, faults);
        std::string text;
        for (const Fault& fault : faults.all()) {
            text += fault.text();
        }
        return text;
    };
    EXPECT_EQ(
        faults_of(plate({kNineRings}), Method::from_organs),
        "method: from_organs does not follow escaping light (a detector needs it); use method = "
        "\"light_tracing\"");
    for (const Method method : {Method::light_tracing, Method::first_hits, Method::automatic}) {
        EXPECT_EQ(faults_of(plate({kNineRings}), method), "");
    }
    EXPECT_EQ(faults_of(plate({}), Method::from_organs), "");
}

TEST(DetectedRuns, AreNeverPlannedFromTheOrgans) {
    RunSpec spec = short_spec();
    spec.method = Method::automatic;
    EXPECT_EQ(plan_method(plate({}), {sky({1, 1})}, spec).method, Method::from_organs);
    EXPECT_NE(plan_method(plate({kNineRings}), {sky({1, 1})}, spec).method, Method::from_organs);
}

TEST(DetectedRuns, HaveADigestOfTheirOwn) {
    const auto digest = [](std::vector<DetectorSpec> detectors) {
        return Simulator()
            .sums(plate(std::move(detectors)), {sky({1, 1})}, short_spec(), 0)
            .digest();
    };
    DetectorSpec twelve = kNineRings;
    twelve.parameters["rings"] = 12;
    EXPECT_NE(digest({}), digest({kNineRings}));
    EXPECT_NE(digest({twelve}), digest({kNineRings}));
    EXPECT_EQ(digest({twelve}), digest({twelve}));
}

TEST(DetectedRuns, AreScaledWithTheLightOfASeries) {
    const Scene scene = plate({kNineRings});
    // The light of a day, no light, and three times the first.
    const std::vector<TimeStep> steps{
        {"morning", {sky({1, 1})}, "sky", 3600},
        {"night", {}, "", 3600},
        {"noon", {sky({3, 3})}, "sky", 3600}};
    std::vector<Result> results;
    Listening events;
    events.time_step = [&](std::size_t, const Result& result, std::size_t) {
        results.push_back(result);
    };
    static_cast<void>(run_series(scene, steps, short_spec(), {.listeners = {&events}}));
    ASSERT_EQ(results.size(), 3U);
    for (std::size_t i = 0; i < 9; ++i) {
        const double once = results[0].detectors.at(0).at(i, 0).mean;
        EXPECT_GT(once, 0);
        EXPECT_EQ(results[1].detectors.at(0).at(i, 0).mean, 0);
        EXPECT_NEAR(results[2].detectors.at(0).at(i, 0).mean, 3 * once, 1e-12 * once);
    }
}

}  // namespace
}  // namespace quasimc::test

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "quasimc/result.h"
#include "quasimc/series.h"
#include "statistical/scenes.h"
#include "support/listening.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Fifty leaves of two bands above a ground; the first `measured` are.
Scene make_audited_stand(double reflectance = .2, std::size_t measured = 50) {
    SceneBuilder builder = make_builder(2);
    builder.add_material(diffuse("leaf", reflectance, .2, 2));
    builder.add_material(diffuse("soil", .2, 0, 2));
    std::size_t count = 0;
    for (const Triangle& triangle : random_leaves(50, .3, 1, 3)) {
        OrganSpec leaf = organ("", "leaf", {triangle});
        leaf.measured = count++ < measured;
        builder.add_organ(std::move(leaf));
    }
    GroundSpec soil = ground("soil");
    soil.height = -.3;
    builder.set_ground(soil);
    return std::move(builder).build();
}

Sources make_sources() {
    return {sun(30, {1, .5}), sky({.5, .8})};
}

RunSpec audited_spec() {
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.paths = 1 << 12;
    spec.threads = 1;
    spec.audit = .1;
    return spec;
}

/// A result of organs of area 1 with that light on their upper sides and none on their lower sides.
Result result_of(const std::vector<Estimate>& upper, const Estimate& total) {
    Result result;
    result.bands = 1;
    result.replicates = 8;
    result.values.resize(upper.size() * kQuantities);
    for (std::size_t i = 0; i < upper.size(); ++i) {
        result.values[i * kQuantities + static_cast<std::size_t>(Quantity::incident_upper)] =
            upper[i];
    }
    result.budget.resize(1);
    result.budget[0].absorbed_by_organs = total;
    return result;
}

Estimate known(double mean, double error) {
    return {mean, error, mean - error, mean + error};
}

Scene two_leaves() {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .1, .1));
    for (const double z : {0.0, 1.0}) {
        builder.add_organ(organ("", "leaf", floor_of(0, 1, 0, 1, z)));
    }
    return std::move(builder).build();
}

TEST(Audit, ChiIsTheSumOfSquaresOverTheSumOfVariances) {
    const Result a = result_of({known(10, .3), known(20, .4)}, known(30, .6));
    const Result b = result_of({known(11, 1.2), known(18, .3)}, known(29, .8));
    const Audit audit = compare_results(two_leaves(), a, b);
    // (1 + 4) / (0.09 + 1.44 + 0.16 + 0.09), except for the minimum scatter of a number.
    EXPECT_NEAR(audit.bands[0].reduced_chi_square, 5 / 1.78, 1e-6);
    EXPECT_NEAR(audit.bands[0].freedom, 1.78 * 1.78 / (1.53 * 1.53 + .25 * .25), 1e-6);
    EXPECT_NEAR(audit.bands[0].difference, 1, 1e-12);
    EXPECT_NEAR(audit.bands[0].standard_error, 1, 1e-6);
    // Variances of 7 degrees each: (0.36 + 0.64)^2 / (0.36^2 + 0.64^2) * 7 = 12.98; |t| = 1.
    EXPECT_NEAR(audit.bands[0].difference_p_value, f_tail(1, 1, 7 / .5392), 1e-6);
    EXPECT_TRUE(audit.agrees());
}

TEST(Audit, CountsWhatWasNeverSeenAndSkipsWhatWasNotMeasured) {
    const Estimate unseen{0, kNan, 0, 1};
    const Estimate unknown{kNan, kNan, kNan, kNan};
    const Result a = result_of({known(1, .5), unknown}, {kNan, kNan, kNan, kNan});
    const Result b = result_of({unseen, known(1, 1)}, known(2, 1));
    const Audit audit = compare_results(two_leaves(), a, b);
    EXPECT_NEAR(audit.bands[0].reduced_chi_square, 1 / .25, 1e-6);
    EXPECT_TRUE(std::isnan(audit.bands[0].difference));
    EXPECT_EQ(audit.bands[0].difference_p_value, 1);
}

TEST(Audit, OfDarknessAgrees) {
    const Result dark = result_of({known(0, 0), known(0, 0)}, known(0, 0));
    const Audit audit = compare_results(two_leaves(), dark, dark);
    EXPECT_EQ(audit.bands[0].reduced_chi_square, 1);
    EXPECT_EQ(audit.p_value, 1);
}

TEST(Audit, AgreesWithEveryWayOfTracing) {
    const Scene scene = make_audited_stand();
    for (const Method from : {Method::light_tracing, Method::from_organs, Method::first_hits}) {
        RunSpec spec = audited_spec();
        spec.method = from;
        const Result result = run(scene, make_sources(), spec);
        ASSERT_TRUE(result.audit.has_value());
        EXPECT_TRUE(result.audit->agrees()) << result.audit->p_value;
        EXPECT_EQ(result.audit->paths, 410U);
        EXPECT_EQ(result.audit->replicates, 8U);
        for (const BandAudit& band : result.audit->bands) {
            EXPECT_GT(band.reduced_chi_square, .5);
            EXPECT_LT(band.reduced_chi_square, 1.6);
            EXPECT_GT(band.freedom, 20);
            EXPECT_GT(band.standard_error, 0);
        }
    }
}

TEST(Audit, LeavesTheResultAsItWas) {
    const Scene scene = make_audited_stand();
    RunSpec spec = audited_spec();
    const Result audited = run(scene, make_sources(), spec);
    spec.audit = 0;
    const Result plain = run(scene, make_sources(), spec);
    EXPECT_FALSE(plain.audit.has_value());
    for (std::size_t i = 0; i < plain.values.size(); ++i) {
        EXPECT_EQ(audited.values[i].mean, plain.values[i].mean);
    }
}

TEST(Audit, KnowsTheOrgansThatAreMeasured) {
    RunSpec spec = audited_spec();
    spec.method = Method::from_organs;
    const Result result = run(make_audited_stand(.2, 5), make_sources(), spec);
    EXPECT_TRUE(result.audit->agrees());
    EXPECT_TRUE(std::isnan(result.audit->bands[0].difference));
    EXPECT_LE(result.audit->bands[0].freedom, 12);
}

/// A control: leaves with another albedo.
TEST(Audit, FindsAWrongAlbedo) {
    RunSpec spec = audited_spec();
    spec.audit = 0;
    spec.paths = 1 << 14;
    const Result wrong = run(make_audited_stand(.3), make_sources(), spec);
    spec.sampler = "monte_carlo";
    spec.seed = 5;
    const Result right = run(make_audited_stand(.2), make_sources(), spec);
    const Audit audit = compare_results(make_audited_stand(), wrong, right);
    EXPECT_FALSE(audit.agrees());
    EXPECT_LT(audit.bands[0].difference_p_value, kAuditLevel);
}

/// The leaves that get least and most light from above.
std::pair<std::ptrdiff_t, std::ptrdiff_t> least_and_most_lit(const Result& result) {
    std::ptrdiff_t least = 0;
    std::ptrdiff_t most = 0;
    const auto light = [&](std::ptrdiff_t i) {
        return result.at(static_cast<std::size_t>(i), Quantity::incident_upper, 0).mean;
    };
    for (std::ptrdiff_t i = 1; i < 50; ++i) {
        least = light(i) < light(least) ? i : least;
        most = light(i) > light(most) ? i : most;
    }
    return {least, most};
}

/// A control: the light of two organs exchanged, which no total shows.
TEST(Audit, FindsLightOnTheWrongOrgan) {
    const Scene scene = make_audited_stand();
    RunSpec spec = audited_spec();
    spec.audit = 0;
    Result tampered = run(scene, make_sources(), spec);
    spec.sampler = "monte_carlo";
    spec.seed = 5;
    const Result right = run(scene, make_sources(), spec);
    EXPECT_TRUE(compare_results(scene, tampered, right).agrees());
    const auto [least, most] = least_and_most_lit(tampered);
    const auto size = static_cast<std::ptrdiff_t>(kQuantities * tampered.bands);
    const auto organ = tampered.values.begin();
    std::swap_ranges(organ + least * size, organ + (least + 1) * size, organ + most * size);
    const Audit audit = compare_results(scene, tampered, right);
    EXPECT_LT(audit.bands[0].chi_square_p_value, kAuditLevel);
    EXPECT_GT(audit.bands[0].difference_p_value, .01);
    EXPECT_FALSE(audit.agrees());
}

TEST(Audit, IsMadeOfEachTraceOfASeries) {
    const Scene scene = make_audited_stand();
    std::vector<TimeStep> time_steps;
    for (const double zenith : {20.0, 50.0}) {
        time_steps.push_back(
            {"", {sun(zenith, {1, .5})}, std::to_string(zenith), 3600, time_steps.size()});
    }
    time_steps.push_back({"", {sun(20, {2, 1})}, time_steps[0].directional_key, 3600, 2});
    std::vector<Audit> audits;
    Listening events;
    events.time_step = [&](std::size_t, const Result& result, std::size_t) {
        audits.push_back(*result.audit);
    };
    const SeriesSummary summary =
        run_series(scene, time_steps, audited_spec(), {.listeners = {&events}});
    ASSERT_EQ(audits.size(), 3U);
    EXPECT_EQ(summary.audited, 2U);
    EXPECT_DOUBLE_EQ(
        summary.audit_p_value, std::min(1.0, 2 * std::min(audits[0].p_value, audits[1].p_value)));
    // The third is twice the first.
    EXPECT_EQ(audits[2].bands[1].reduced_chi_square, audits[0].bands[1].reduced_chi_square);
    EXPECT_NEAR(audits[2].bands[1].difference, 2 * audits[0].bands[1].difference, 1e-12);
}

}  // namespace
}  // namespace quasimc::test

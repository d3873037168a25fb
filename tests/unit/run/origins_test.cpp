// Light by origin: parts of a run, by where the light came from.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "quasimc/series.h"
#include "results/evaluate.h"
#include "statistical/scenes.h"
#include "support/listening.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

/// Leaves and a sensor over a bright ground, in two bands.
Scene make_stand() {
    SceneBuilder builder = make_builder(2);
    builder.add_material(diffuse("leaf", .3, .2, 2));
    builder.add_material(diffuse("soil", .5, 0, 2));
    builder.add_material(sensor("sensor", 2));
    add_leaves(builder, random_leaves(10, .6, 1, 3));
    builder.add_organ(organ("sensor", "sensor", floor_of(0, 1, 0, 1, 1.2)));
    builder.set_ground(ground("soil"));
    return std::move(builder).build();
}

std::shared_ptr<const Source> lamp() {
    LampSpec spec;
    spec.name = "lamp";
    spec.position = {.5, .5, 3};
    spec.flux = {2, 1};
    return make_lamp(std::move(spec));
}

Sources all_sources() {
    return {sun(30, {1, 2}), sky({.5, .2}), lamp()};
}

RunSpec spec_by_origin(Method from, std::uint64_t paths = 1024) {
    RunSpec spec = spec_of(from, paths);
    spec.replicates = 8;
    spec.layers = 2;
    spec.origins = {"sun", "sky", "lamps"};
    return spec;
}

/// Whether the origins' means add up to the whole. @param values_of  of a Result or a SeriesSum
template <typename Light, typename ValuesOf>
void expect_sum(const Light& whole, const ValuesOf& values_of) {
    const std::vector<Estimate>& all = values_of(whole);
    for (std::size_t i = 0; i < all.size(); ++i) {
        double sum = 0;
        for (const auto& origin : whole.origins) {
            ASSERT_EQ(values_of(origin.light).size(), all.size());
            sum += values_of(origin.light)[i].mean;
        }
        EXPECT_NEAR(sum, all[i].mean, 1e-12 * (1 + std::abs(all[i].mean)));
    }
}

template <typename Light>
void expect_sums_of_origins(const Light& whole) {
    ASSERT_FALSE(whole.origins.empty());
    expect_sum(
        whole, [](const auto& light) -> const auto& { return light.values; });
    expect_sum(
        whole, [](const auto& light) -> const auto& { return light.groups.values; });
}

/// Errors are unknown where no light was sampled.
double error_of(const Estimate& estimate) {
    return std::isnan(estimate.standard_error) ? -1 : estimate.standard_error;
}

void expect_near(const Result& a, const Result& b, double relative) {
    ASSERT_EQ(a.values.size(), b.values.size());
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        const double mean = b.values[i].mean, error = error_of(b.values[i]);
        EXPECT_NEAR(a.values[i].mean, mean, relative * (1e-3 + mean));
        EXPECT_NEAR(error_of(a.values[i]), error, relative * (1e-3 + std::abs(error)));
    }
}

class Origins : public ::testing::TestWithParam<Method> {};

TEST_P(Origins, AddUpToTheWhole) {
    const Scene scene = make_stand();
    const Result whole = run(scene, all_sources(), spec_by_origin(GetParam()));
    ASSERT_EQ(whole.origins.size(), 3U);
    expect_sums_of_origins(whole);
    for (std::size_t b = 0; b < 2; ++b) {
        for (Estimate BandBudget::*part :
             {&BandBudget::emitted, &BandBudget::absorbed_by_organs,
              &BandBudget::absorbed_by_ground, &BandBudget::escaped, &BandBudget::cut_off}) {
            double sum = 0;
            for (const OriginLight& origin : whole.origins) {
                sum += (origin.light.budget[b].*part).mean;
            }
            EXPECT_NEAR(sum, (whole.budget[b].*part).mean, 1e-12 * whole.budget[b].emitted.mean);
        }
    }
}

/// Light is not traced otherwise because it is kept apart.
TEST_P(Origins, LeaveTheWholeAsItIs) {
    const Scene scene = make_stand();
    RunSpec spec = spec_by_origin(GetParam());
    const Result apart = run(scene, all_sources(), spec);
    spec.origins.clear();
    const Result together = run(scene, all_sources(), spec);
    EXPECT_TRUE(together.origins.empty());
    const bool traces_paths =
        GetParam() == Method::light_tracing || GetParam() == Method::first_hits;
    expect_near(apart, together, traces_paths ? 0 : 1e-6);
    EXPECT_EQ(apart.rays, together.rays);
}

TEST_P(Origins, AreTheSameOnAnyNumberOfThreads) {
    const Scene scene = make_stand();
    RunSpec spec = spec_by_origin(GetParam());
    const Result one = run(scene, all_sources(), spec);
    spec.threads = 3;
    const Result three = run(scene, all_sources(), spec);
    for (std::size_t i = 0; i < one.origins.size(); ++i) {
        expect_near(one.origins[i].light, three.origins[i].light, 0);
    }
}

/// Each origin has the light of a run in which its sources shine alone.
TEST_P(Origins, AreTheLightOfTheirSourcesAlone) {
    const Scene scene = make_stand();
    const Result whole = run(scene, all_sources(), spec_by_origin(GetParam(), 1 << 13));
    for (std::size_t i = 0; i < whole.origins.size(); ++i) {
        RunSpec spec = spec_of(Method::light_tracing, 1 << 14);
        spec.seed = 77;
        const Result alone = run(scene, {all_sources()[i]}, spec);
        const Result& part = whole.origins[i].light;
        double squares = 0, count = 0;
        for (std::size_t v = 0; v < part.values.size(); ++v) {
            const Estimate &a = part.values[v], &b = alone.values[v];
            const double error = std::hypot(error_of(a), error_of(b));
            if (error_of(a) < 0 || error_of(b) < 0) {
                EXPECT_LT(std::max(a.mean, b.mean), .01);  // hardly any light
                continue;
            }
            if (error > 1e-6 * b.mean) {
                const double off = (a.mean - b.mean) / error;
                EXPECT_LT(std::abs(off), 8) << v << ' ' << a.mean << ' ' << b.mean;
                squares += off * off;
                ++count;
            }
            EXPECT_LT(error, .1 * (.05 + b.mean));  // the comparison is sharp
        }
        EXPECT_LT(squares / count, 2.5) << whole.origins[i].name;
    }
}

TEST_P(Origins, AddUpOverTimes) {
    const Scene scene = make_stand();
    RunSpec spec = spec_by_origin(GetParam(), 256);
    spec.origins = {"sky"};
    const std::vector<TimeStep> steps{
        {"morning", {sun(60, {1, 1}), sky({.5, .2})}, "", 3600, 0},
        {"noon", {sky({.5, .2})}, "", 1800, 0},
        {"night", {}, "", 3600, 0}};
    std::vector<Result> times;
    std::vector<SeriesSum> days;
    Listening events;
    events.time_step = [&](std::size_t, const Result& result, std::size_t) {
        times.push_back(result);
    };
    events.day = [&](std::size_t, const SeriesSum& sum) { days.push_back(sum); };
    const SeriesSummary summary = run_series(scene, steps, spec, {.listeners = {&events}});
    for (const Result& time : times) {
        ASSERT_EQ(time.origins.size(), 2U);
        EXPECT_EQ(time.origins[1].name, "other");  // at every time, as the morning has a sun
        expect_sums_of_origins(time);
    }
    expect_sums_of_origins(days.at(0));
    expect_sums_of_origins(summary.total);
}

INSTANTIATE_TEST_SUITE_P(
    EveryMethod,
    Origins,
    ::testing::Values(
        Method::light_tracing, Method::first_hits, Method::from_organs, Method::ray_bundles),
    name_of);

TEST(OriginsOfMany, HaveTheirBandsInterpolated) {
    constexpr std::size_t kBands = 40;
    SceneBuilder builder = make_builder(kBands);
    MaterialSpec leaf = diffuse("leaf", 0, 0, kBands);
    for (std::size_t b = 0; b < kBands; ++b) {
        const double albedo = .01 * static_cast<double>(b);
        leaf.upper[b].reflectance = leaf.lower[b].reflectance = albedo;
    }
    builder.add_material(leaf);
    add_leaves(builder, random_leaves(10, .6, 1, 3));
    builder.set_ground(ground("leaf"));
    const Scene scene = std::move(builder).build();
    RunSpec spec = spec_by_origin(Method::ray_bundles);
    spec.origins = {"sun", "sky"};
    const Sources sources{
        sun(30, std::vector<double>(kBands, 1)), sky(std::vector<double>(kBands, 1))};
    const Result apart = run(scene, sources, spec);
    expect_sums_of_origins(apart);
    spec.origins.clear();
    // Errors of interpolation are those of each origin, which have less in common with each other.
    expect_near(apart, run(scene, sources, spec), 1e-3);
}

TEST(OriginsOfSums, AreAddedAndKept) {
    const Scene scene = make_stand();
    const RunSpec spec = spec_by_origin(Method::first_hits);
    const Result whole = run(scene, all_sources(), spec);
    Sums sums =
        load_sums(save_sums(Simulator().sums(scene, all_sources(), spec, 0, share_of(1, 2))));
    sums.add_share(Simulator().sums(scene, all_sources(), spec, 0, share_of(2, 2)));
    const Result merged = evaluate_run(sums, scene, spec, all_sources());
    for (std::size_t i = 0; i < 3; ++i) {
        expect_near(merged.origins.at(i).light, whole.origins[i].light, 0);
    }
    RunSpec other = spec;
    other.origins = {"sun", "lamps", "sky"};
    const Sums others = Simulator().sums(scene, all_sources(), other, 0, share_of(2, 2));
    EXPECT_THROW(sums.add_share(others), std::invalid_argument);
}

TEST(OriginsOfWaxyLeaves, AddUpWhereAbsorptionDependsOnTheAngle) {
    SceneBuilder builder = make_builder();
    MaterialSpec waxy = diffuse("leaf", .6, .3);
    for (auto* side : {&waxy.upper, &waxy.lower}) {
        side->front().reflection_model = side->front().transmission_model = "coated_lambertian";
    }
    builder.add_material(waxy);
    add_leaves(builder, random_leaves(10, .6, 1, 3));
    const Scene scene = std::move(builder).build();
    for (const Method method : {Method::light_tracing, Method::from_organs}) {
        RunSpec spec = spec_by_origin(method);
        spec.origins = {"sun", "sky"};
        expect_sums_of_origins(run(scene, {sun(30, {1}), sky({.5})}, spec));
    }
}

TEST(OriginsOfSeasons, AddUp) {
    RunSpec spec = spec_by_origin(Method::ray_bundles, 512);
    spec.time_method = TimeMethod::daylight_coefficients;
    spec.origins = {"sun", "sky"};
    const std::vector<TimeStep> steps{
        {"morning", {sun(60, {1, 1}), sky({.5, .2})}, "", 3600, 0},
        {"noon", {sky({.5, .2})}, "", 1800, 0},
        {"night", {}, "", 3600, 1}};
    std::vector<Result> times;
    std::vector<SeriesSum> days;
    Listening events;
    events.time_step = [&](std::size_t, const Result& result, std::size_t) {
        times.push_back(result);
    };
    events.day = [&](std::size_t, const SeriesSum& sum) { days.push_back(sum); };
    const Scene scene = make_stand();
    const SeriesSummary summary = run_series(scene, steps, spec, {.listeners = {&events}});
    ASSERT_EQ(times.size(), 3U);
    for (const Result& time : times) {
        expect_sums_of_origins(time);
    }
    ASSERT_EQ(days.size(), 2U);
    expect_sums_of_origins(days[0]);
    expect_sums_of_origins(days[1]);
    expect_sums_of_origins(summary.total);
    spec.origins.clear();
    std::vector<Result> plain;
    events.time_step = [&](std::size_t, const Result& result, std::size_t) {
        plain.push_back(result);
    };
    static_cast<void>(run_series(scene, steps, spec, {.listeners = {&events}}));
    for (std::size_t i = 0; i < plain.size(); ++i) {
        expect_near(times[i], plain[i], 0);
    }
}

}  // namespace
}  // namespace quasimc::test

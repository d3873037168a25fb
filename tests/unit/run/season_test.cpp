// Time steps of a series that are computed together.

#include <cmath>
#include <limits>
#include <stop_token>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "quasimc/series.h"
#include "statistical/scenes.h"
#include "support/listening.h"

namespace quasimc::test {
namespace {

/// A leaf over a floor, both grey.
Scene leaf_and_floor() {
    SceneBuilder builder = make_builder(2);
    builder.add_material(diffuse("leaf", .3, .2, 2));
    OrganSpec leaf = organ("leaf", "leaf", floor_of(0, .5, 0, .5, .4));
    leaf.labels = {{"plant", "1"}};
    builder.add_organ(leaf);
    builder.add_organ(organ("floor", "leaf", floor_of(-1, 1, -1, 1, 0)));
    return std::move(builder).build();
}

TimeStep hour_of(Sources sources, std::size_t day = 0, double seconds = 3600) {
    return {"hour", std::move(sources), "", seconds, day};
}

std::vector<TimeStep> two_short_days() {
    return {
        hour_of({sun(60, {300, 200}), sky({50, 10})}), hour_of({}), hour_of({sky({80, 70})}, 1),
        hour_of({sun(20, {700, 500}), sun(25, {70, 50}), sky({100, 20})}, 1, 1800),
        hour_of({sky({0, 0})}, 1)};
}

RunSpec together() {
    RunSpec spec;
    spec.method = Method::ray_bundles;
    spec.time_method = TimeMethod::daylight_coefficients;
    spec.paths = 1 << 9;
    spec.replicates = 4;
    spec.threads = 1;
    return spec;
}

struct SeasonResults {
    std::vector<Result> hours;
    std::vector<SeriesSum> days;
    SeriesSummary summary;
};

SeasonResults compute_season(
    const RunSpec& spec, const std::vector<TimeStep>& steps = two_short_days()) {
    SeasonResults season;
    Listening events;
    events.time_step = [&](std::size_t, const Result& result, std::size_t) {
        season.hours.push_back(result);
    };
    events.day = [&](std::size_t, const SeriesSum& sum) { season.days.push_back(sum); };
    season.summary = run_series(leaf_and_floor(), steps, spec, {.listeners = {&events}});
    return season;
}

void expect_same(const std::vector<Estimate>& a, const std::vector<Estimate>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].mean, b[i].mean);
        const bool is_unknown = std::isnan(a[i].standard_error);
        EXPECT_EQ(is_unknown, std::isnan(b[i].standard_error));
        EXPECT_TRUE(is_unknown || a[i].standard_error == b[i].standard_error);
        EXPECT_EQ(a[i].ci95_high, b[i].ci95_high);
    }
}

std::string season_faults(
    const Scene& scene, const std::vector<TimeStep>& steps, const RunSpec& spec) {
    try {
        run_series(scene, steps, spec);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(Season, GivesTheSameBitsOnAnyNumberOfThreads) {
    const SeasonResults one = compute_season(together());
    RunSpec spec = together();
    spec.threads = 3;
    const SeasonResults three = compute_season(spec);
    ASSERT_EQ(one.hours.size(), 5U);
    ASSERT_EQ(three.hours.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
        expect_same(one.hours[i].values, three.hours[i].values);
    }
    expect_same(one.summary.total.values, three.summary.total.values);
    spec.seed = 2;
    EXPECT_NE(compute_season(spec).hours[0].values[0].mean, one.hours[0].values[0].mean)
        << "a control";
}

/// Light is linear: a day is the sum of its hours, for organs and for groups.
TEST(Season, SumsOverDays) {
    RunSpec spec = together();
    spec.groups = {"plant"};
    const SeasonResults season = compute_season(spec);
    ASSERT_EQ(season.days.size(), 2U);
    const std::vector<double> seconds{3600, 3600, 3600, 1800, 3600};
    const auto expect_sum = [](double sum, double expected) {
        EXPECT_NEAR(sum, expected, 1e-6 * expected);
    };
    for (std::size_t i = 0; i < season.hours[0].values.size(); ++i) {
        const auto light = [&](std::size_t h) {
            return season.hours[h].values[i].mean * seconds[h];
        };
        expect_sum(season.days[0].values[i].mean, light(0));
        expect_sum(season.days[1].values[i].mean, light(2) + light(3));
        expect_sum(season.summary.total.values[i].mean, light(0) + light(2) + light(3));
    }
    ASSERT_EQ(season.days[1].groups.groups.size(), 2U);
    const Estimate& plant = season.days[1].groups.at(1, Quantity::absorbed_flux, 0);
    const Estimate& leaf = season.days[1].at(0, Quantity::absorbed_flux, 0);
    EXPECT_DOUBLE_EQ(plant.mean, leaf.mean);
    EXPECT_NEAR(plant.standard_error, leaf.standard_error, 1e-9 * leaf.standard_error);
    EXPECT_GT(plant.standard_error, 0);
    EXPECT_EQ(season.summary.total.seconds, 16200);
    EXPECT_EQ(season.summary.computed, 3U);
}

/// Hours whose light differs by a factor have proportional results, except for their suns.
TEST(Season, IsLinearInTheLightOfItsSkies) {
    const SeasonResults season = compute_season(
        together(), {hour_of({sky({10, 20})}), hour_of({sky({30, 60})}), hour_of({sky({10, 60})})});
    for (std::size_t o = 0; o < 2; ++o) {
        const auto mean = [&](std::size_t hour, std::size_t band) {
            return season.hours[hour].at(o, Quantity::absorbed_flux, band).mean;
        };
        EXPECT_NEAR(mean(1, 0), 3 * mean(0, 0), 1e-9 * mean(1, 0));
        EXPECT_NEAR(mean(2, 0), mean(0, 0), 1e-9 * mean(0, 0));
        EXPECT_NEAR(mean(2, 1), mean(1, 1), 1e-9 * mean(1, 1));
    }
}

TEST(Season, KnowsNight) {
    const SeasonResults season = compute_season(together());
    for (const std::size_t hour : {1U, 4U}) {
        for (const Estimate& e : season.hours[hour].values) {
            EXPECT_EQ(e.mean, 0);
            EXPECT_EQ(e.standard_error, 0);
        }
    }
    EXPECT_GT(season.hours[0].values[0].mean, 0);
    EXPECT_GT(season.hours[0].values[0].standard_error, 0);
}

TEST(Season, ClosesTheBudgetOfEachHour) {
    const SeasonResults season = compute_season(together());
    for (const std::size_t hour : {0U, 2U, 3U}) {
        for (const BandBudget& band : season.hours[hour].budget) {
            EXPECT_LT(band.closure_error, 1e-6);
            EXPECT_GT(band.absorbed_by_organs.mean, 0);
        }
    }
    EXPECT_EQ(season.hours[2].sunlit_fraction.size(), 0U);
    ASSERT_EQ(season.hours[0].sunlit_fraction.size(), 2U);
    EXPECT_NEAR(season.hours[0].sunlit_fraction[0].mean, 1, .01);
}

/// Direct light of the sun is that of the hour, not of the basis directions around it.
TEST(Season, LeavesTheSunsDirectLightToEachHour) {
    RunSpec spec = together();
    spec.replicates = 32;
    const double radian = std::acos(-1) / 180;
    for (const double zenith : {20., 23., 26.}) {
        const SeasonResults season = compute_season(spec, {hour_of({sun(zenith, {500, 500})})});
        const Estimate& found = season.hours[0].at(0, Quantity::incident_direct, 0);
        const auto is_at = [&](double of_zenith) {
            const double lit = 500 * std::cos(of_zenith * radian);
            return agrees(measured(found, 32), lit, .01 * lit);
        };
        EXPECT_TRUE(is_at(zenith));
        EXPECT_FALSE(is_at(zenith + 4)) << "a control";
    }
}

TEST(Season, KeepsWhatIsDoneWhenItIsStopped) {
    std::stop_source source;
    std::vector<std::size_t> hours, days;
    Listening events;
    events.time_step = [&](std::size_t i, const Result&, std::size_t) {
        hours.push_back(i);
        if (i == 2) {
            source.request_stop();
        }
    };
    events.day = [&](std::size_t day, const SeriesSum&) { days.push_back(day); };
    const SeriesSummary summary = run_series(
        leaf_and_floor(), two_short_days(), together(),
        {.stop = source.get_token(), .listeners = {&events}});
    EXPECT_EQ(summary.stop, StopReason::interrupted);
    EXPECT_EQ(hours, (std::vector<std::size_t>{0, 1, 2}));
    EXPECT_EQ(days, std::vector<std::size_t>{0});
    EXPECT_EQ(summary.completed, 3U);
    EXPECT_EQ(summary.total.seconds, 3 * 3600);
}

TEST(Season, HasNoResultIfItIsStoppedBeforeItsFirstHour) {
    std::stop_source source;
    source.request_stop();
    EXPECT_THROW(
        run_series(leaf_and_floor(), two_short_days(), together(), {.stop = source.get_token()}),
        Stopped);
    RunSpec spec = together();
    spec.paths = 1 << 22;
    spec.max_seconds = 1e-3;
    try {
        run_series(leaf_and_floor(), two_short_days(), spec);
        FAIL() << "it can't be done in a millisecond";
    } catch (const Stopped& stopped) {
        EXPECT_EQ(stopped.why(), StopReason::time_limit);
    }
}

TEST(Season, ReportsItsProgress) {
    std::vector<double> fractions;
    Listening events;
    events.progress = [&](const Progress& progress) { fractions.push_back(progress.fraction); };
    run_series(leaf_and_floor(), two_short_days(), together(), {.listeners = {&events}});
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    EXPECT_EQ(fractions.back(), 1);
}

TEST(Season, RefusesByNameWhatItCantDo) {
    const Scene scene = leaf_and_floor();
    RunSpec spec = together();
    spec.method = Method::first_hits;
    spec.target_error = .01;
    spec.audit = .1;
    spec.path_allocation = PathAllocation::proportional;
    const std::string faults = season_faults(scene, two_short_days(), spec);
    for (const char* text :
         {"method is not ray_bundles", "target_error", "audit", "path_allocation"}) {
        EXPECT_NE(faults.find(text), std::string::npos) << faults;
    }
    const auto lamp =
        make_lamp({.name = "lamp", .position = {0, 0, 2}, .opening = {}, .flux = {1, 1}});
    const auto below = make_directional_source("below", {0, 0, 1}, {1, 1});
    EXPECT_NE(
        season_faults(scene, {hour_of({lamp})}, together()).find("source 'lamp'"),
        std::string::npos);
    EXPECT_NE(
        season_faults(scene, {hour_of({below})}, together()).find("below the horizon"),
        std::string::npos);
    EXPECT_EQ(season_faults(scene, two_short_days(), together()), "");
}

TEST(Season, IsNoPartOfARunThatIsShared) {
    EXPECT_THROW(
        trace_share(
            leaf_and_floor(), two_short_days(), together(), {}, [](std::size_t, const Sums&) {}),
        InputError);
}

}  // namespace
}  // namespace quasimc::test

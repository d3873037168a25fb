#include "quasimc/series.h"

#include <cmath>
#include <limits>
#include <stop_token>
#include <string>
#include <utility>

#include "series/series_sum.h"
#include "statistical/scenes.h"
#include "support/listening.h"

namespace quasimc::test {
namespace {

/// A leaf over a ground, both grey.
Scene make_scene(std::size_t bands = 1) {
    SceneBuilder builder = make_builder(bands);
    builder.add_material(diffuse("leaf", .3, .2, bands));
    builder.add_organ(organ("leaf", "leaf", floor_of(0, .5, 0, .5, .4)));
    builder.add_organ(organ("floor", "leaf", floor_of(-1, 1, -1, 1, 0)));
    return std::move(builder).build();
}

TimeStep time_step_of(
    Sources sources, std::string shapes, std::size_t day = 0, double seconds = 3600) {
    return {"time step", std::move(sources), std::move(shapes), seconds, day};
}

RunSpec small_spec() {
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.paths = 1 << 10;
    spec.threads = 1;
    return spec;
}

/// The results of all time steps.
std::vector<Result> results_of(
    const Scene& scene, const std::vector<TimeStep>& time_steps, const RunSpec& spec) {
    std::vector<Result> results;
    Listening events;
    events.time_step = [&](std::size_t, const Result& result, std::size_t) {
        results.push_back(result);
    };
    run_series(scene, time_steps, spec, {.listeners = {&events}});
    return results;
}

bool same_numbers(const Result& a, const Result& b) {
    return std::equal(
        a.values.begin(), a.values.end(), b.values.begin(), b.values.end(),
        [](const Estimate& x, const Estimate& y) {
            return x.mean == y.mean && x.ci95_high == y.ci95_high;
        });
}

TEST(Series, RefusesTimesThatAreNotInTheOrderOfTheirDays) {
    const Scene scene = make_scene();
    const Sources sources{sun(30, {500})};
    const std::vector<TimeStep> times{
        time_step_of(sources, "a", 2), time_step_of(sources, "a", 1), time_step_of(sources, "a", 3),
        time_step_of(sources, "a", 0)};
    try {
        run_series(scene, times, small_spec());
        FAIL() << "it is not refused";
    } catch (const InputError& error) {
        ASSERT_EQ(error.faults().size(), 2U);
        EXPECT_EQ(error.faults()[0].problem, "it belongs to day 1, but follows day 2");
        EXPECT_EQ(error.faults()[1].problem, "it belongs to day 0, but follows day 3");
    }
}

/// Rounds much shorter than the time between two reports.
TEST(Progress, IsReportedOfManyShortRounds) {
    RunSpec spec = small_spec();
    spec.paths = 64;
    spec.target_error = 1e-9;
    spec.max_seconds = 1;
    Listening events;
    std::size_t reports = 0;
    events.progress = [&](const Progress&) { ++reports; };
    std::vector<TimeStep> times;
    for (int i = 0; i < 50; ++i) {
        times.push_back(time_step_of({sun(20 + i, {1})}, std::to_string(i)));
    }
    run_series(make_scene(), times, spec, {.listeners = {&events}});
    EXPECT_GT(reports, 0U);
}

/// A listener that does not specify its needs.
class PlainListener final : public RunListener {
  public:
    std::size_t ends = 0, done = 0;
    bool has_total = false;

    void on_end(const SeriesSummary& summary) override {
        ++ends;
        done = summary.completed;
        has_total = !summary.total.values.empty();
    }
};

TEST(Series, ReportsItsEndOnceWithTheTotalToAPlainListener) {
    const Scene scene = make_scene();
    const Sources sources{sun(30, {500})};
    PlainListener listener;
    run_series(
        scene, {time_step_of(sources, "a"), time_step_of(sources, "a", 1)}, small_spec(),
        {.listeners = {&listener}});
    EXPECT_EQ(listener.ends, 1U);
    EXPECT_EQ(listener.done, 2U);
    EXPECT_TRUE(listener.has_total);
}

TEST(Series, OfOneTimeStepIsTheRun) {
    const Scene scene = make_scene();
    const Sources sources{sun(30, {500}), sky({100})};
    const auto results = results_of(scene, {time_step_of(sources, "a")}, small_spec());
    ASSERT_EQ(results.size(), 1U);
    EXPECT_TRUE(same_numbers(results[0], run(scene, sources, small_spec())));
}

TEST(Series, TracesProportionalTimeStepsOnce) {
    const std::vector<TimeStep> time_steps{
        time_step_of({sky({100, 40})}, "overcast"),
        time_step_of({sun(20, {100, 40})}, "sun"),
        time_step_of({sky({50, 20})}, "overcast"),
        time_step_of({sky({50, 21})}, "overcast"),
        time_step_of({}, ""),
        time_step_of({sky({0, 0})}, "overcast")};
    const auto plans = plan_series(time_steps);
    EXPECT_EQ(plans[0].traced, 0U);
    EXPECT_EQ(plans[1].traced, 1U);
    EXPECT_EQ(plans[2].traced, 0U);
    EXPECT_DOUBLE_EQ(plans[2].factor, .5);
    EXPECT_EQ(plans[3].traced, 3U) << "another ratio of the bands";
    EXPECT_EQ(plans[4].factor, 0);
    EXPECT_EQ(plans[5].factor, 0);
    const Scene scene = make_scene(2);
    const auto results = results_of(scene, time_steps, small_spec());
    for (std::size_t i = 0; i < results[0].values.size(); ++i) {
        EXPECT_DOUBLE_EQ(results[2].values[i].mean, .5 * results[0].values[i].mean);
        EXPECT_EQ(results[4].values[i].mean, 0);
        EXPECT_EQ(results[4].values[i].standard_error, 0) << "night is certain";
    }
    EXPECT_DOUBLE_EQ(results[2].budget[0].emitted.mean, .5 * results[0].budget[0].emitted.mean);
    EXPECT_TRUE(results[4].sunlit_fraction.empty());
}

TEST(Series, GivesEachTraceNumbersOfItsOwn) {
    const Scene scene = make_scene();
    const std::vector<TimeStep> time_steps{
        time_step_of({sun(30, {1})}, "a"), time_step_of({sun(30, {1})}, "b")};
    const auto results = results_of(scene, time_steps, small_spec());
    EXPECT_NE(results[0].values[0].mean, results[1].values[0].mean);
    const auto again = results_of(scene, time_steps, small_spec());
    EXPECT_TRUE(same_numbers(results[1], again[1]));
}

/// Sums are those of the time steps; their errors add in squares, unless they share a trace.
TEST(Series, SumsOverDaysAndInAll) {
    const Scene scene = make_scene();
    const std::vector<TimeStep> time_steps{
        time_step_of({sky({10})}, "o"),           time_step_of({sun(30, {20})}, "s"),
        time_step_of({sky({30})}, "o"),           time_step_of({sky({20})}, "o", 1, 7200),
        time_step_of({sun(40, {5})}, "t", 1, 60), time_step_of({}, "", 1)};
    std::vector<Result> results;
    std::vector<SeriesSum> days;
    Listening events;
    events.time_step = [&](std::size_t, const Result& result, std::size_t) {
        results.push_back(result);
    };
    events.day = [&](std::size_t day, const SeriesSum& sum) {
        EXPECT_EQ(day, days.size());
        days.push_back(sum);
    };
    const SeriesSummary summary =
        run_series(scene, time_steps, small_spec(), {.listeners = {&events}});
    EXPECT_EQ(summary.computed, 3U);
    ASSERT_EQ(days.size(), 2U);
    EXPECT_EQ(days[0].seconds, 3 * 3600);
    EXPECT_EQ(days[1].seconds, 7200 + 60 + 3600);
    EXPECT_EQ(summary.total.seconds, days[0].seconds + days[1].seconds);
    for (std::size_t i = 0; i < results[0].values.size(); ++i) {
        const auto mean = [&](std::size_t m) { return results[m].values[i].mean; };
        const auto error = [&](std::size_t m) { return results[m].values[i].standard_error; };
        if (!std::isfinite(error(0)) || !std::isfinite(error(1)) || !std::isfinite(error(4))) {
            continue;  // without contributions: see below
        }
        const double first = 3600 * (mean(0) + mean(1) + mean(2));
        EXPECT_NEAR(days[0].values[i].mean, first, 1e-9 * first);
        const double overcast = 3600 * (error(0) + error(2));
        EXPECT_NEAR(
            days[0].values[i].standard_error, std::hypot(overcast, 3600 * error(1)),
            1e-9 * overcast);
        const double total = first + 7200 * mean(3) + 60 * mean(4);
        EXPECT_NEAR(summary.total.values[i].mean, total, 1e-9 * total);
        EXPECT_NEAR(
            summary.total.values[i].standard_error,
            std::hypot(overcast + 7200 * error(3), 3600 * error(1), 60 * error(4)),
            1e-9 * overcast);
    }
}

/// A stop after the third of four times: they are complete, and so is the only whole day.
TEST(Series, KeepsWhatIsDoneWhenItIsStopped) {
    const Scene scene = make_scene();
    const std::vector<TimeStep> time_steps{
        time_step_of({sun(30, {1})}, "a"), time_step_of({sun(40, {1})}, "b"),
        time_step_of({sun(30, {2})}, "a", 1, 7200), time_step_of({sun(50, {1})}, "c", 1)};
    std::stop_source source;
    std::vector<Result> results;
    std::vector<std::size_t> days;
    Listening events;
    events.time_step = [&](std::size_t, const Result& result, std::size_t) {
        results.push_back(result);
        if (results.size() == 3) {
            source.request_stop();
        }
    };
    events.day = [&](std::size_t day, const SeriesSum&) { days.push_back(day); };
    const SeriesSummary summary = run_series(
        scene, time_steps, small_spec(), {.stop = source.get_token(), .listeners = {&events}});
    EXPECT_EQ(summary.stop, StopReason::interrupted);
    EXPECT_EQ(summary.completed, 3U);
    EXPECT_EQ(summary.computed, 2U);
    EXPECT_EQ(summary.with_fewer_paths, 0U);
    EXPECT_EQ(days, std::vector<std::size_t>{0});
    EXPECT_EQ(summary.total.seconds, 2 * 3600 + 7200);
    const auto mean = [&](std::size_t m) { return results[m].values[0].mean; };
    const double total = 3600 * (mean(0) + mean(1)) + 7200 * mean(2);
    EXPECT_NEAR(summary.total.values[0].mean, total, 1e-9 * total);
    const auto whole = results_of(scene, time_steps, small_spec());
    EXPECT_TRUE(same_numbers(whole[1], results[1]));
}

/// A time step that could take the whole limit leaves the others their shares.
TEST(Series, SharesItsTime) {
    const Scene scene = make_scene();
    const std::vector<TimeStep> time_steps{
        time_step_of({sun(30, {1})}, "a"), time_step_of({sun(40, {1})}, "b"), time_step_of({}, ""),
        time_step_of({sun(50, {1})}, "c")};
    RunSpec spec = small_spec();
    spec.paths = std::uint64_t{1} << 30U;
    spec.max_seconds = 2;
    Listening events;
    events.time_step = [&](std::size_t i, const Result& result, std::size_t) {
        EXPECT_EQ(result.stop, i == 2 ? StopReason::finished : StopReason::time_limit);
    };
    const SeriesSummary summary = run_series(scene, time_steps, spec, {.listeners = {&events}});
    EXPECT_EQ(summary.stop, StopReason::time_limit);
    EXPECT_EQ(summary.completed, 4U);
    EXPECT_EQ(summary.with_fewer_paths, 3U);
}

/// Three hours of a day with decreasing light, each of them traced.
std::vector<TimeStep> fading_day() {
    return {
        time_step_of({sky({900})}, "a"), time_step_of({sky({90})}, "b"),
        time_step_of({sky({9})}, "c")};
}

/// After a night each of two traces is half of the work.
TEST(Series, CountsNoDarkTimesAsProgress) {
    std::vector<TimeStep> time_steps(10, time_step_of({}, ""));
    time_steps.push_back(time_step_of({sun(30, {1})}, "a"));
    time_steps.push_back(time_step_of({sun(40, {1})}, "b"));
    RunSpec spec = small_spec();
    spec.paths = std::uint64_t{1} << 30U;
    spec.max_seconds = 1.5;
    Listening events;
    std::size_t done = 0;
    std::size_t told_in_first = 0;
    events.progress = [&](const Progress& progress) {
        const bool is_first = done == 10;
        told_in_first += is_first ? 1 : 0;
        EXPECT_GE(progress.fraction, is_first ? 0 : .5);
        EXPECT_LE(progress.fraction, is_first ? .5 : 1);
    };
    events.time_step = [&](std::size_t i, const Result&, std::size_t) { done = i + 1; };
    run_series(make_scene(), time_steps, spec, {.listeners = {&events}});
    EXPECT_EQ(done, 12U);
    EXPECT_GT(told_in_first, 0U);
}

TEST(SpreadEffort, FollowsTheLightOfTheDay) {
    std::vector<TimeStep> time_steps = fading_day();
    auto plans = plan_series(time_steps);
    EXPECT_EQ(plans[0].path_factor, 1) << "unless it is asked for";
    allocate_paths(make_scene(), time_steps, plans);
    // Shares of the sum are 900/999, 90/999 and 9/999; three times that is 2.7, 0.27 and 0.027.
    EXPECT_EQ(plans[0].path_factor, 2);
    EXPECT_EQ(plans[1].path_factor, .25);
    EXPECT_EQ(plans[2].path_factor, 1. / 32);
    EXPECT_NEAR(plans[2].target, std::sqrt(999. / 9), 1e-12);
    time_steps[2].seconds = 3600e-6;
    plans = plan_series(time_steps);
    allocate_paths(make_scene(), time_steps, plans);
    EXPECT_EQ(plans[2].path_factor, 1. / 64) << "at least";
}

TEST(SpreadEffort, OfDaysIsOfEachByItself) {
    const std::vector<TimeStep> time_steps{
        time_step_of({sky({900})}, "a", 0), time_step_of({sky({900})}, "b", 0),
        time_step_of({sky({1})}, "c", 1), time_step_of({}, "", 1)};
    auto plans = plan_series(time_steps);
    allocate_paths(make_scene(), time_steps, plans);
    for (const std::size_t i : {0, 1, 2}) {
        EXPECT_EQ(plans[i].path_factor, 1) << i;
    }
}

TEST(SpreadEffort, CountsASharedTraceByAllItServes) {
    const std::vector<TimeStep> time_steps{
        time_step_of({sky({100})}, "overcast"), time_step_of({sky({100})}, "b"),
        time_step_of({sky({200})}, "overcast"), time_step_of({sky({400})}, "overcast")};
    auto plans = plan_series(time_steps);
    allocate_paths(make_scene(), time_steps, plans);
    EXPECT_EQ(plans[0].path_factor, 2) << "700 of 800, and two traces";
    EXPECT_EQ(plans[1].path_factor, .25);
}

/// Proportional allocation: less than half of the paths for the same error of the sum.
TEST(Series, OfADayNeedsFewerPathsForItsSum) {
    const Scene scene = make_scene();
    RunSpec spec = small_spec();
    spec.sampler = "monte_carlo";
    spec.replicates = 512;
    const auto cost = [&](PathAllocation path_allocation) {
        spec.path_allocation = path_allocation;
        double paths = 0;
        Listening events;
        events.time_step = [&](std::size_t, const Result& result, std::size_t) {
            paths += static_cast<double>(result.paths);
        };
        const Estimate sum = run_series(scene, fading_day(), spec, {.listeners = {&events}})
                                 .total.at(0, Quantity::absorbed_flux, 0);
        return paths * sum.standard_error * sum.standard_error / (sum.mean * sum.mean);
    };
    // 3 (0.9^2 + 0.09^2 + 0.009^2) = 2.46 against 1.
    EXPECT_LT(cost(PathAllocation::proportional), .55 * cost(PathAllocation::equal));
}

TEST(Series, OfADayHasTheTargetForItsSum) {
    RunSpec spec = small_spec();
    spec.sampler = "monte_carlo";
    spec.paths = 256;
    spec.replicates = 32;
    spec.target_error = .02;
    spec.target_fraction = 1;
    spec.path_allocation = PathAllocation::proportional;
    std::vector<std::uint64_t> paths;
    Listening events;
    events.time_step = [&](std::size_t, const Result& result, std::size_t) {
        paths.push_back(result.paths);
        EXPECT_EQ(result.stop, StopReason::target_reached);
    };
    const SeriesSum sum =
        run_series(make_scene(), fading_day(), spec, {.listeners = {&events}}).total;
    for (const std::size_t organ : {0, 1}) {
        const Estimate& e = sum.at(organ, Quantity::absorbed_flux, 0);
        EXPECT_LT(e.standard_error, .02 * e.mean) << organ;
    }
    EXPECT_GT(paths[0], 8 * paths[2]);
}

/// The target of an hour that hardly counts in the sum of the day is no error of 100 % or more.
TEST(Series, OfADayHasTargetsBelowOneForDimHours) {
    RunSpec spec = small_spec();
    spec.paths = 256;
    spec.target_error = .2;
    spec.path_allocation = PathAllocation::proportional;
    const std::vector<TimeStep> day{
        time_step_of({sky({1e-9})}, "dawn"), time_step_of({sky({1})}, "noon")};
    const SeriesSummary summary = run_series(make_scene(), day, spec);
    EXPECT_EQ(summary.with_fewer_paths, 0U);
    EXPECT_EQ(summary.at_target, 2U);
}

/// Independent of the ideal share of the brightest hour.
TEST(Series, OfADayKeepsToTheMostPaths) {
    RunSpec spec = small_spec();
    spec.paths = 256;
    spec.max_paths = 256;
    spec.path_allocation = PathAllocation::proportional;
    std::vector<std::uint64_t> paths;
    Listening events;
    events.time_step = [&](std::size_t, const Result& result, std::size_t) {
        paths.push_back(result.paths);
    };
    static_cast<void>(run_series(make_scene(), fading_day(), spec, {.listeners = {&events}}));
    EXPECT_EQ(paths[0], 256U);
    EXPECT_LT(paths[2], 256U);
}

TEST(Series, LeavesOutSumsThatAreNotRequested) {
    const Scene scene = make_scene();
    const std::vector<TimeStep> time_steps{
        time_step_of({sky({10})}, "o"), time_step_of({}, ""), time_step_of({sky({20})}, "o", 1)};
    std::vector<Result> results;
    Listening events;
    events.time_step = [&](std::size_t, const Result& result, std::size_t) {
        results.push_back(result);
    };
    events.total = false;
    const SeriesSummary summary =
        run_series(scene, time_steps, small_spec(), {.listeners = {&events}});
    EXPECT_TRUE(summary.total.values.empty());
    EXPECT_EQ(summary.computed, 1U);
    const auto usual = results_of(scene, time_steps, small_spec());
    ASSERT_EQ(results.size(), usual.size());
    for (std::size_t i = 0; i < usual.size(); ++i) {
        EXPECT_TRUE(same_numbers(results[i], usual[i])) << i;
    }
}

/// {1, 3} has mean 2 and standard error 1; twice that and {0, 0.2} independently.
TEST(SeriesAdder, AddsMeansAndSquaresOfErrors) {
    Result a;
    a.bands = 1;
    a.replicates = 2;
    a.values = {estimate_mean(std::vector<double>{1, 3})};
    Result b = a;
    b.values = {estimate_mean(std::vector<double>{0, .2})};
    SeriesAdder adder;
    adder.add(a, 2);
    adder.add(b, 10);
    const Estimate sum = adder.sum(1, 1).values[0];
    EXPECT_DOUBLE_EQ(sum.mean, 5);
    EXPECT_DOUBLE_EQ(sum.standard_error, std::sqrt(5));
    // Welch and Satterthwaite: (4 + 1)^2 / (16 + 1) degrees of freedom, 1 and a half.
    EXPECT_NEAR(sum.ci95_high - sum.mean, std::sqrt(5) * interval_quantile(1), 1e-9);
}

TEST(SeriesAdder, KeepsTheBoundsOfWhatWasNotSeen) {
    Result unseen;
    unseen.bands = 1;
    unseen.replicates = 4;
    unseen.values = {estimate_unseen(30, 2)};
    SeriesAdder adder;
    adder.add(unseen, 10);
    Estimate sum = adder.sum(1, 1).values[0];
    EXPECT_EQ(sum.mean, 0);
    EXPECT_TRUE(std::isnan(sum.standard_error));
    EXPECT_DOUBLE_EQ(sum.ci95_high, 10 * .2);
    Result seen = unseen;
    seen.values = {estimate_mean(std::vector<double>{1, 2, 1, 2})};
    adder.add(seen, 1);
    sum = adder.sum(1, 1).values[0];
    EXPECT_DOUBLE_EQ(sum.mean, 1.5);
    EXPECT_NEAR(sum.ci95_high, seen.values[0].ci95_high + 2, 1e-9);
    Result single = unseen;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    single.values = {{1, nan, nan, nan}};
    adder.add(single, 1);
    EXPECT_TRUE(std::isnan(adder.sum(1, 1).values[0].standard_error));
}

/// Means are clipped to possible values when they are reported: sums use unclipped means.
TEST(SeriesAdder, AddsMeansThatAreNotCut) {
    Result result;
    result.bands = 1;
    result.replicates = 8;
    result.values = {{1.25, .5, .5, 1}};
    SeriesAdder adder;
    adder.add(result, 2);
    adder.add(result, 2);
    EXPECT_EQ(adder.sum(1, 1).values[0].mean, 5);
}

/// A share of a half of 2 (error 0.1) and one of 0.2 of 3 (error 0.05), whose light is doubled: 2.2
/// of 5, with the errors 2 x 0.1 and 6 x 0.05.
TEST(TimeQuotient, WeighsItsPartsByTheirWholes) {
    TimeQuotient quotient;
    quotient.add({.5, .1}, {2, 0}, {1, 1}, 3);
    quotient.add({.2, .05}, {3, 0}, {2, 1}, 3);
    const Estimate mean = quotient.estimate();
    EXPECT_DOUBLE_EQ(mean.mean, 2.2 / 5);
    EXPECT_DOUBLE_EQ(mean.standard_error, std::hypot(.2, .3) / 5);
    quotient.add_whole(6);
    EXPECT_DOUBLE_EQ(quotient.estimate().mean, .2);
}

/// The error of a whole counts where the share of a time differs from that of all.
TEST(TimeQuotient, IncludesTheErrorsOfWholes) {
    TimeQuotient quotient;
    quotient.add({1, 0}, {1, .1}, {1, 1}, 3);
    quotient.add({0, 0}, {1, .1}, {1, 1}, 3);
    EXPECT_DOUBLE_EQ(quotient.estimate().mean, .5);
    EXPECT_DOUBLE_EQ(quotient.estimate().standard_error, std::sqrt(2 * .05 * .05) / 2);
    EXPECT_TRUE(std::isnan(TimeQuotient().estimate().mean));
}

/// Without any trace, sums have the requested size, and are 0.
TEST(SeriesAdder, OfNothingIsCertainlyNothing) {
    const SeriesSum sum = SeriesAdder().sum(1, 3);
    ASSERT_EQ(sum.values.size(), 3U);
    EXPECT_EQ(sum.values[2].mean, 0);
    EXPECT_EQ(sum.values[2].standard_error, 0);
}

}  // namespace
}  // namespace quasimc::test

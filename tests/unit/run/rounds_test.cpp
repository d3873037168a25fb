#include "run/rounds.h"

#include <bit>
#include <chrono>
#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

/// The limits of a run that may take max_seconds.
RoundLimits limits_of(const RunSpec& spec, std::uint64_t fewest = 256) {
    return {
        .deadline = spec.max_seconds > 0 ? Deadline::after(spec.max_seconds) : Deadline(),
        .fewest = fewest};
}

/// Seconds after the beginning of rounds.
Deadline::Clock::time_point after(const RoundLimits& limits, double seconds) {
    return limits.start + std::chrono::duration_cast<Deadline::Clock::duration>(
                              std::chrono::duration<double>(seconds));
}

RunSpec spec_with_target() {
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.paths = 1024;
    spec.target_error = .01;
    spec.target_fraction = .9;
    return spec;
}

TEST(Rounds, AreOneWithoutABudget) {
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.paths = 1000;
    const RoundLimits limits;
    Rounds rounds(spec, limits);
    const auto first = rounds.next();
    ASSERT_TRUE(first);
    EXPECT_EQ(first->first, 0U);
    EXPECT_EQ(first->count, 1000U);
    rounds.finish(after(limits, 1), {});
    EXPECT_FALSE(rounds.next());
    EXPECT_EQ(rounds.stop(), StopReason::finished);
}

TEST(Rounds, TraceAsManyAgainUntilTheTargetIsReached) {
    const RunSpec spec = spec_with_target();
    const RoundLimits limits{.fewest = spec.paths};
    Rounds rounds(spec, limits);
    for (const std::uint64_t done : {0U, 1024U, 2048U, 4096U}) {
        const auto round = rounds.next();
        ASSERT_TRUE(round);
        EXPECT_EQ(round->first, done);
        EXPECT_EQ(round->count, done == 0 ? 1024 : done);
        rounds.finish(after(limits, 0), {.fraction_at_target = done < 4096 ? .89 : .9});
    }
    EXPECT_FALSE(rounds.next());
    EXPECT_EQ(rounds.stop(), StopReason::target_reached);
    EXPECT_EQ(rounds.at_target(), .9);
}

/// The rounds of a run whose error falls with the root of its paths: of `error` with one path.
struct TargetCourse {
    std::vector<Round> rounds;
    StopReason stop = StopReason::finished;

    /// Paths of the result.
    [[nodiscard]] std::uint64_t paths() const { return rounds.back().first + rounds.back().count; }
    /// Paths that all rounds have traced.
    [[nodiscard]] std::uint64_t traced() const {
        return std::accumulate(
            rounds.begin(), rounds.end(), std::uint64_t{0},
            [](std::uint64_t sum, const Round& round) { return sum + round.count; });
    }
};

TargetCourse course_to_target(const RunSpec& spec, double error, RoundLimits limits = {}) {
    limits.fewest = 256;
    TargetCourse course;
    Rounds rounds(spec, limits);
    std::uint64_t done = 0;
    while (const auto round = rounds.next()) {
        EXPECT_TRUE(round->first == 0 || (round->first == done && round->count == done));
        course.rounds.push_back(*round);
        done = round->first + round->count;
        const double ratio = error / std::sqrt(static_cast<double>(done)) / spec.target_error;
        rounds.finish(
            after(limits, 0),
            {.fraction_at_target = ratio <= 1 ? 1. : 0., .ratio_to_target = ratio});
    }
    course.stop = rounds.stop();
    return course;
}

RunSpec spec_to(double target) {
    RunSpec spec = spec_with_target();
    spec.paths = 1U << 16U;
    spec.target_error = target;
    return spec;
}

TEST(Rounds, OfATargetBeginWithPilotsAndGrowByWhatIsMissing) {
    EXPECT_EQ(course_to_target(spec_to(.1), 1.5).rounds, (std::vector<Round>{{0, 256}}));
    EXPECT_EQ(course_to_target(spec_to(.1), 2).rounds, (std::vector<Round>{{0, 256}, {256, 256}}));
    EXPECT_EQ(course_to_target(spec_to(.1), 3).rounds, (std::vector<Round>{{0, 256}, {0, 1024}}));
    EXPECT_EQ(course_to_target(spec_to(.1), 6).rounds, (std::vector<Round>{{0, 256}, {0, 4096}}))
        << "at most 16 times as many";
    EXPECT_EQ(
        course_to_target(spec_to(.1), 30).rounds,
        (std::vector<Round>{{0, 256}, {0, 4096}, {0, 65536}, {65536, 65536}}))
        << "from the specification's paths on, as many again";
}

/// A smaller target never has fewer paths, the work of all rounds is at most 1.6 times that of the
/// needed paths, rounded up to a power of two, and no more than the paths of the run and a third.
TEST(Rounds, OfATargetCostLittleMoreThanTheNeededPaths) {
    std::uint64_t before = 0;
    for (double target = .5; target > .004; target /= 1.1) {
        const TargetCourse course = course_to_target(spec_to(target), 3);
        EXPECT_EQ(course.stop, StopReason::target_reached);
        EXPECT_GE(course.paths(), before) << target;
        before = course.paths();
        const double needed = std::pow(3 / target, 2);
        EXPECT_GE(static_cast<double>(course.paths()), needed);
        EXPECT_LE(
            course.paths(),
            std::max<std::uint64_t>(256, 2 * std::bit_ceil(static_cast<std::uint64_t>(needed))))
            << target;
        EXPECT_LE(course.traced() - course.paths(), course.paths() / 3) << target;
    }
}

/// Pilot rounds may show less light than there is: a run still ends where its target is reached.
TEST(Rounds, OfATargetGrowWhereTheDistanceIsUnknown) {
    const RunSpec spec = spec_to(.01);
    const RoundLimits limits{.fewest = 256};
    Rounds rounds(spec, limits);
    for (const std::uint64_t paths : {256U, 4096U, 65536U}) {
        EXPECT_EQ(rounds.next(), (Round{0, paths}));
        rounds.finish(after(limits, 0), {});
    }
    EXPECT_EQ(rounds.next(), (Round{65536, 65536}));
    rounds.finish(after(limits, 0), {.fraction_at_target = .95});
    EXPECT_FALSE(rounds.next());
}

/// After a round that was doubled and had too large an error all the same, it restarts.
TEST(Rounds, OfATargetRestartAfterADoubledPilot) {
    const RunSpec spec = spec_to(.01);
    const RoundLimits limits{.fewest = 1024};
    Rounds rounds(spec, limits);
    EXPECT_EQ(rounds.next(), (Round{0, 1024}));
    rounds.finish(after(limits, 0), {.ratio_to_target = 1.4});
    EXPECT_EQ(rounds.next(), (Round{1024, 1024}));
    EXPECT_TRUE(rounds.state().is_pilot);
    rounds.finish(after(limits, 0), {.ratio_to_target = 1.1});
    EXPECT_EQ(rounds.next(), (Round{0, 4096}));
}

TEST(Rounds, OfATargetHaveTheSizesThatPointSetsNeed) {
    for (const std::uint64_t paths : {300U, 1000U, 4096U, 100000U}) {
        RunSpec spec = spec_to(.01);
        spec.paths = paths;
        const TargetCourse course = course_to_target(spec, 100);
        for (const Round& round : course.rounds) {
            EXPECT_TRUE(round.first + round.count >= paths || std::has_single_bit(round.count));
        }
        EXPECT_EQ(course.paths() % paths, 0U);
    }
}

/// Where the preparation of a round costs as much as many paths, pilot rounds are few and large, or
/// there are none.
TEST(Rounds, OfATargetHaveFewPilotsWhereRoundsCostMuch) {
    const auto rounds_of = [](double fixed_cost) {
        return course_to_target(spec_to(.01), 3, {.fixed_cost = fixed_cost}).rounds;
    };
    EXPECT_EQ(
        rounds_of(4000), (std::vector<Round>{{0, 1024}, {0, 16384}, {0, 65536}, {65536, 65536}}));
    EXPECT_EQ(rounds_of(30000), (std::vector<Round>{{0, 4096}, {0, 65536}, {65536, 65536}}));
    EXPECT_EQ(rounds_of(1e5), (std::vector<Round>{{0, 65536}, {65536, 65536}}));
}

/// A resumed run decides as one that was not interrupted.
TEST(Rounds, OfATargetGoOnFromAPilot) {
    const RunSpec spec = spec_to(.01);
    const RoundLimits limits{.fewest = 256};
    const TargetDistance distance{.ratio_to_target = 2.5};
    Rounds whole(spec, limits);
    static_cast<void>(whole.next());
    whole.finish(after(limits, 0), distance);
    Rounds later(spec, limits);
    later.restore(whole.state(), distance);
    EXPECT_EQ(later.next(), whole.next());
    later.restore({.done = 256, .is_pilot = true, .cost = {}}, {.fraction_at_target = 1});
    EXPECT_FALSE(later.next());
    EXPECT_EQ(later.stop(), StopReason::target_reached);
}

TEST(Rounds, StopBeforeThePathLimitIsPassed) {
    RunSpec spec = spec_with_target();
    spec.max_paths = 3000;
    const RoundLimits limits{.fewest = spec.paths};
    Rounds rounds(spec, limits);
    std::uint64_t traced = 0;
    while (const auto round = rounds.next()) {
        traced += round->count;
        rounds.finish(after(limits, 0), {});
    }
    EXPECT_EQ(traced, 2048U);
    EXPECT_EQ(rounds.stop(), StopReason::path_limit);
}

TEST(Rounds, ReachThePathLimitWithoutATarget) {
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.paths = 1024;
    spec.max_paths = 8192;
    const RoundLimits limits;
    Rounds rounds(spec, limits);
    std::uint64_t traced = 0;
    while (const auto round = rounds.next()) {
        traced += round->count;
        rounds.finish(after(limits, 0), {});
    }
    EXPECT_EQ(traced, 8192U);
}

TEST(Rounds, StopAtTwoToTheThirtyPointsWhateverTheTarget) {
    const RunSpec spec = spec_with_target();
    const RoundLimits limits{.fewest = spec.paths};
    Rounds rounds(spec, limits);
    std::uint64_t traced = 0;
    while (const auto round = rounds.next()) {
        traced += round->count;
        rounds.finish(after(limits, 0), {});
    }
    EXPECT_EQ(traced, std::uint64_t{1} << 30U);
}

/// A round that would end after the time limit is not begun.
TEST(Rounds, StopBeforeTheTimeIsUp) {
    RunSpec spec = spec_with_target();
    spec.max_seconds = 5;
    const RoundLimits limits = limits_of(spec, spec.paths);
    Rounds rounds(spec, limits);
    double seconds = 1;
    int count = 0;
    while (rounds.next()) {
        rounds.finish(after(limits, seconds), {});
        seconds *= 2;
        ++count;
    }
    EXPECT_EQ(count, 3);  // 1, 2, 4 seconds; the next would end at 8
    EXPECT_EQ(rounds.stop(), StopReason::time_limit);
}

/// The first points and the sizes of the rounds of a run in which a round takes `fixed` seconds,
/// and each path `each`. A round that is not complete in time is abandoned.
struct Course {
    std::vector<std::pair<std::uint64_t, std::uint64_t>> rounds;
    StopReason stop = StopReason::finished;
    double seconds = 0, wasted = 0;
};

template <typename SecondsOf>
Course course_of(const RunSpec& spec, const SecondsOf& seconds_of) {
    Course course;
    const RoundLimits limits = limits_of(spec);
    Rounds rounds(spec, limits);
    while (const auto round = rounds.next()) {
        const double takes = seconds_of(*round);
        const bool is_first = course.rounds.empty();
        if (spec.max_seconds > 0 && !is_first && course.seconds + takes > spec.max_seconds) {
            course.wasted = spec.max_seconds - course.seconds;
            course.seconds = spec.max_seconds;
            rounds.interrupt(StopReason::time_limit);
            break;
        }
        course.seconds += takes;
        course.rounds.emplace_back(round->first, round->count);
        rounds.finish(after(limits, course.seconds), {});
    }
    course.stop = rounds.stop();
    return course;
}

Course course_of(const RunSpec& spec, double fixed, double each) {
    return course_of(
        spec, [&](const Round& round) { return fixed + each * static_cast<double>(round.count); });
}

/// Paths of the result.
std::uint64_t paths_of(const Course& course) {
    return course.rounds.back().first + course.rounds.back().second;
}

/// A limit of time ends a run with a target at the last round that fits.
TEST(Rounds, OfATargetKeepToATimeLimit) {
    RunSpec spec = spec_to(.001);
    spec.max_seconds = 10;
    for (const double each : {1e-6, 1e-4, 1e-3}) {
        const Course course = course_of(spec, .01, each);
        EXPECT_EQ(course.stop, StopReason::time_limit);
        EXPECT_EQ(course.wasted, 0) << each;
        EXPECT_LE(course.seconds, 10);
        EXPECT_GT(static_cast<double>(paths_of(course)), .2 * 10 / each) << each;
    }
}

/// The result of a huge run that is stopped, at a small cost.
TEST(Rounds, OfAHugeRunThatMayBeStoppedBeginWithPilots) {
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.paths = std::uint64_t{1} << 30U;
    const RoundLimits limits{.fewest = 256, .may_be_stopped = true};
    Rounds rounds(spec, limits);
    std::vector<std::uint64_t> counts;
    while (const auto round = rounds.next()) {
        EXPECT_EQ(round->first, 0U) << "each is a run of its own";
        counts.push_back(round->count);
        rounds.finish(after(limits, static_cast<double>(counts.size())), {});
    }
    EXPECT_EQ(counts.front(), 1U << 14U);
    EXPECT_EQ(counts.back(), spec.paths);
    EXPECT_EQ(counts[counts.size() - 2], spec.paths / 64);
    const auto pilots = std::accumulate(counts.begin(), counts.end() - 1, std::uint64_t{0});
    EXPECT_LT(static_cast<double>(pilots), .022 * static_cast<double>(spec.paths));
    EXPECT_EQ(rounds.stop(), StopReason::finished);
}

TEST(Rounds, OfOtherRunsThatMayBeStoppedAreOne) {
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.paths = (1U << 22U) - 1;
    const RoundLimits limits{.fewest = 256, .may_be_stopped = true};
    Rounds rounds(spec, limits);
    EXPECT_EQ(rounds.next()->count, spec.paths);
    spec.paths = 1U << 22U;
    EXPECT_EQ(Rounds(spec, {.fewest = 256}).next()->count, spec.paths);
}

TEST(Rounds, OfALongLimitEndWithThoseOfNone) {
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.paths = 1U << 16U;
    for (const double fixed : {0., .01, 1.}) {
        spec.max_seconds = 100;
        const Course limited = course_of(spec, fixed, 1e-5);
        EXPECT_EQ(limited.rounds.back(), (std::pair<std::uint64_t, std::uint64_t>{0, spec.paths}));
        EXPECT_EQ(limited.stop, StopReason::finished) << "a limit is no wish for more";
        spec.max_seconds = 0;
        const Course free = course_of(spec, fixed, 1e-5);
        EXPECT_EQ(free.rounds.size(), 1U);
        EXPECT_EQ(free.rounds.back(), limited.rounds.back());
    }
}

/// Whatever rounds and paths cost, the result has a good part of the paths that are possible in the
/// time, and no round is begun that must be abandoned.
TEST(Rounds, OfAShortLimitUseTheTime) {
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.paths = std::uint64_t{1} << 30U;
    for (const double limit : {.5, 2., 60.}) {
        for (const double fixed : {0., .001, .02}) {
            spec.max_seconds = limit;
            constexpr double kEach = 1e-6;
            const Course course = course_of(spec, fixed, kEach);
            const double most = (limit - fixed) / kEach;
            EXPECT_EQ(course.stop, StopReason::time_limit);
            EXPECT_EQ(course.wasted, 0) << limit << " " << fixed;
            EXPECT_LE(course.seconds, limit);
            EXPECT_GT(static_cast<double>(paths_of(course)), .2 * most) << limit << " " << fixed;
        }
    }
}

/// The cost per path may rise with the number of paths, as in first hits, which samples a large
/// scene by lines only where paths are many: pilot rounds of few paths do not show that.
TEST(Rounds, OfALimitUseTheTimeWhereManyPathsCostMoreThanPilotsShow) {
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.paths = std::uint64_t{1} << 20U;
    constexpr double kEach = 2e-5;
    for (const double limit : {10., 40., 100.}) {
        for (const std::uint64_t from : {512U, 4096U, 32768U}) {
            for (const double fixed : {.25, .5, 1.}) {
                spec.max_seconds = limit;
                const Course course = course_of(spec, [&](const Round& round) {
                    const auto paths = static_cast<double>(round.count);
                    return round.count >= from ? fixed + kEach * paths : .02;
                });
                const double most = std::min((limit - fixed) / kEach, 0x1p20);
                EXPECT_GT(static_cast<double>(paths_of(course)), .2 * most)
                    << limit << " " << from << " " << fixed;
            }
        }
    }
}

/// Rounds double from a power of two on, so that point sets are complete.
TEST(Rounds, OfAShortLimitAreWhole) {
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.paths = 100000000;
    spec.max_seconds = 3;
    const Course course = course_of(spec, 0, 1e-6);
    std::uint64_t done = 0;
    for (const auto& [first, count] : course.rounds) {
        EXPECT_TRUE(first == 0 || (first == done && count == done));
        done = first + count;
        EXPECT_EQ(done & (done - 1), 0U);
    }
}

TEST(Rounds, BeginWithAPilotWhereTheCostIsUnknown) {
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.paths = 1U << 20U;
    spec.max_seconds = 1;
    const RoundLimits limits = limits_of(spec);
    Rounds rounds(spec, limits);
    EXPECT_EQ(rounds.next()->count, 256U);
    rounds.finish(after(limits, 5), {});  // the time limit is over already
    EXPECT_FALSE(rounds.next());
    EXPECT_EQ(rounds.stop(), StopReason::time_limit);
}

TEST(Rounds, KnowTheirShareOfTheWork) {
    const RunSpec spec = spec_with_target();
    const RoundLimits limits{.fewest = spec.paths};
    Rounds rounds(spec, limits);
    ASSERT_TRUE(rounds.next());
    EXPECT_EQ(rounds.fraction_before(), 0);
    EXPECT_EQ(rounds.share(), 1);
    rounds.finish(after(limits, 0), {});
    ASSERT_TRUE(rounds.next());
    EXPECT_EQ(rounds.fraction_before(), .5);
    EXPECT_EQ(rounds.share(), .5);
}

TEST(RatioBands, AreFoundByName) {
    SceneBuilder builder({{"R"}, {"FR"}, {"PAR"}});
    builder.add_material(diffuse("leaf", .1, .1, 3));
    builder.add_organ(organ("leaf", "leaf", floor_of(0, 1, 0, 1, 0)));
    const Scene scene = std::move(builder).build();
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.ratios = {"R:FR", "PAR:R"};
    const auto pairs = ratio_bands(scene, spec);
    ASSERT_EQ(pairs.size(), 2U);
    EXPECT_EQ(pairs[0], (std::pair<std::size_t, std::size_t>{0, 1}));
    EXPECT_EQ(pairs[1], (std::pair<std::size_t, std::size_t>{2, 0}));
}

}  // namespace
}  // namespace quasimc::test

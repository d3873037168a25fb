#include "base/executor.h"

#include <algorithm>
#include <atomic>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "base/memory_need.h"
#include "base/stop.h"

namespace quasimc {
namespace {

constexpr std::uint64_t kTasks = 1000;

class Executors : public ::testing::TestWithParam<unsigned> {};

TEST_P(Executors, RunNoTaskOnceAStopIsRequested) {
    std::stop_source source;
    Executor executor(GetParam(), {.stop = source.get_token()});
    std::atomic<std::uint64_t> begun{0};
    const auto stop_at_the_tenth = [&](std::uint64_t, unsigned) {
        if (++begun == 10) {
            source.request_stop();
        }
    };
    EXPECT_THROW(executor.run(kTasks, stop_at_the_tenth), StopRequested);
    EXPECT_GE(begun, 10U);
    EXPECT_LT(begun, 10U + GetParam());
}

TEST_P(Executors, OfSharesRunEveryTaskOnce) {
    for (const std::uint64_t parts : {1U, 3U, 7U, 1000U, 1300U}) {
        std::vector<std::atomic<int>> runs(kTasks);
        for (std::uint64_t part = 1; part <= parts; ++part) {
            Executor executor(GetParam(), {.share = share_of(part, parts)});
            executor.run(kTasks, [&](std::uint64_t task, unsigned) { ++runs[task]; });
        }
        EXPECT_TRUE(std::all_of(runs.begin(), runs.end(), [](const auto& n) { return n == 1; }));
    }
}

/// A team of which this process is the only one.
class CountedTeam final : public TaskTeam {
  public:
    [[nodiscard]] Share share() const override { return {}; }
    [[nodiscard]] bool meet(bool is_done) override {
        ++(is_done ? done : given_up);
        return is_done;
    }
    int done = 0, given_up = 0;
};

TEST(Executor, ThatRunsNoTaskMeetsItsTeamOnce) {
    CountedTeam team;
    Executor(2, {.team = &team}).give_up();
    EXPECT_EQ(team.given_up, 1);
}

TEST(Executor, WhoseTaskThrewHasMetItsTeam) {
    CountedTeam team;
    Executor executor(2, {.team = &team});
    const auto fail = [](std::uint64_t, unsigned) { throw std::runtime_error("task"); };
    EXPECT_THROW(executor.run(kTasks, fail), std::runtime_error);
    executor.give_up();
    EXPECT_EQ(team.given_up, 1);
    EXPECT_EQ(team.done, 0);
}

TEST(Share, OfHugeNumbersOfTasksLeavesNoneOut) {
    constexpr std::uint64_t kMost = ~std::uint64_t{0};
    std::uint64_t next = 0;
    for (std::uint64_t part = 1; part <= 999'999; part += 1) {
        const auto [begin, end] = share_of(part, 999'999).range(kMost);
        ASSERT_EQ(begin, next);
        next = end;
    }
    EXPECT_EQ(next, kMost);
}

TEST_P(Executors, RunAllTasksWithoutAStop) {
    std::stop_source source;
    Executor executor(GetParam(), {.stop = source.get_token()});
    std::atomic<std::uint64_t> done{0};
    executor.run(kTasks, [&](std::uint64_t, unsigned) { ++done; });
    EXPECT_EQ(done, kTasks);
}

INSTANTIATE_TEST_SUITE_P(Workers, Executors, ::testing::Values(1U, 4U));

using std::chrono::hours;
using std::chrono::milliseconds;

TEST(StopAlarm, GoesOffInTheEnd) {
    std::stop_source source;
    StopAlarm alarm(source);
    alarm.set(StopAlarm::Clock::now() + milliseconds(1));
    while (!source.stop_requested()) {  // the test hangs if it never does
        std::this_thread::yield();
    }
    EXPECT_THROW(throw_if_stopped(source.get_token()), StopRequested);
}

TEST(StopAlarm, CanBeSetToAnEarlierTimeAndToALaterOne) {
    std::stop_source source;
    StopAlarm alarm(source);
    alarm.set(StopAlarm::Clock::now() + hours(1));
    alarm.set(StopAlarm::Clock::now() + milliseconds(1));
    while (!source.stop_requested()) {
        std::this_thread::yield();
    }
    std::stop_source other;
    {
        StopAlarm late(other);
        late.set(StopAlarm::Clock::now() + hours(1));
        late.set(StopAlarm::Clock::now() + hours(2));
    }  // ends at once
    EXPECT_FALSE(other.stop_requested());
    throw_if_stopped(other.get_token());
}

TEST(MakeBig, SaysForWhatMemoryWasNotEnough) {
    const auto words = [](const auto& make) {
        try {
            make_big("the sums of 7 organs", 2.5e9, make);
        } catch (const OutOfMemory& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const std::string expected = "not enough memory for the sums of 7 organs: about 2500 MB";
    EXPECT_EQ(words([]() -> int { throw std::bad_alloc(); }), expected);
    EXPECT_EQ(words([]() -> int { throw std::length_error("vector"); }), expected);
    EXPECT_EQ(
        words([]() -> int { throw OutOfMemory("a ray caster", 1e9); }),
        "not enough memory for a ray caster: about 1000 MB");
    EXPECT_EQ(make_big("", 0, [] { return 3; }), 3);
}

}  // namespace
}  // namespace quasimc

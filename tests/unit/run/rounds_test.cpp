#include "run/rounds.h"

#include <gtest/gtest.h>

#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

RunSpec spec_with_target() {
    RunSpec spec;
    spec.paths = 1024;
    spec.target_error = .01;
    spec.target_fraction = .9;
    return spec;
}

TEST(Rounds, AreOneWithoutABudget) {
    RunSpec spec;
    spec.paths = 1000;
    Rounds rounds(spec);
    const auto first = rounds.next();
    ASSERT_TRUE(first);
    EXPECT_EQ(first->first, 0U);
    EXPECT_EQ(first->count, 1000U);
    rounds.finish(1, 0);
    EXPECT_FALSE(rounds.next());
    EXPECT_EQ(rounds.stop(), StopReason::paths_done);
}

TEST(Rounds, TraceAsManyAgainUntilTheTargetIsReached) {
    const RunSpec spec = spec_with_target();
    Rounds rounds(spec);
    for (const std::uint64_t done : {0U, 1024U, 2048U, 4096U}) {
        const auto round = rounds.next();
        ASSERT_TRUE(round);
        EXPECT_EQ(round->first, done);
        EXPECT_EQ(round->count, done == 0 ? 1024 : done);
        rounds.finish(0, done < 4096 ? .89 : .9);
    }
    EXPECT_FALSE(rounds.next());
    EXPECT_EQ(rounds.stop(), StopReason::target_reached);
    EXPECT_EQ(rounds.at_target(), .9);
}

TEST(Rounds, StopBeforeThePathLimitIsPassed) {
    RunSpec spec = spec_with_target();
    spec.max_paths = 3000;
    Rounds rounds(spec);
    std::uint64_t traced = 0;
    while (const auto round = rounds.next()) {
        traced += round->count;
        rounds.finish(0, 0);
    }
    EXPECT_EQ(traced, 2048U);
    EXPECT_EQ(rounds.stop(), StopReason::path_limit);
}

TEST(Rounds, ReachThePathLimitWithoutATarget) {
    RunSpec spec;
    spec.paths = 1024;
    spec.max_paths = 8192;
    Rounds rounds(spec);
    std::uint64_t traced = 0;
    while (const auto round = rounds.next()) {
        traced += round->count;
        rounds.finish(0, 0);
    }
    EXPECT_EQ(traced, 8192U);
}

TEST(Rounds, StopAtTwoToTheThirtyPointsWhateverTheTarget) {
    const RunSpec spec = spec_with_target();
    Rounds rounds(spec);
    std::uint64_t traced = 0;
    while (const auto round = rounds.next()) {
        traced += round->count;
        rounds.finish(0, 0);
    }
    EXPECT_EQ(traced, std::uint64_t{1} << 30U);
}

/// A round that would end after the time is up is not begun.
TEST(Rounds, StopBeforeTheTimeIsUp) {
    RunSpec spec = spec_with_target();
    spec.max_seconds = 5;
    Rounds rounds(spec);
    double seconds = 1;
    int count = 0;
    while (rounds.next()) {
        rounds.finish(seconds, 0);
        seconds *= 2;
        ++count;
    }
    EXPECT_EQ(count, 3);  // 1, 2, 4 seconds; the next would end at 8
    EXPECT_EQ(rounds.stop(), StopReason::time_is_up);
}

TEST(Rounds, KnowTheirShareOfTheWork) {
    const RunSpec spec = spec_with_target();
    Rounds rounds(spec);
    ASSERT_TRUE(rounds.next());
    EXPECT_EQ(rounds.fraction_before(), 0);
    EXPECT_EQ(rounds.share(), 1);
    rounds.finish(0, 0);
    ASSERT_TRUE(rounds.next());
    EXPECT_EQ(rounds.fraction_before(), .5);
    EXPECT_EQ(rounds.share(), .5);
}

TEST(RatioBands, AreFoundByName) {
    SceneBuilder builder({{"R"}, {"FR"}, {"PAR"}});
    builder.add_material(matt("leaf", .1, .1, 3));
    builder.add_organ(organ("leaf", "leaf", floor_of(0, 1, 0, 1, 0)));
    const Scene scene = std::move(builder).build();
    RunSpec spec;
    spec.ratios = {"R:FR", "PAR:R"};
    const auto pairs = ratio_bands(scene, spec);
    ASSERT_EQ(pairs.size(), 2U);
    EXPECT_EQ(pairs[0], (std::pair<std::size_t, std::size_t>{0, 1}));
    EXPECT_EQ(pairs[1], (std::pair<std::size_t, std::size_t>{2, 0}));
}

}  // namespace
}  // namespace quasimc::test

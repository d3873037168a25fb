#include "base/parallel.h"

#include <atomic>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace quasimc {
namespace {

constexpr std::uint64_t kBlocks = 100;

class Parallel : public ::testing::TestWithParam<unsigned> {};

TEST_P(Parallel, RunsEveryBlockOnce) {
    std::vector<std::atomic<int>> times(kBlocks);
    parallel_blocks(kBlocks, GetParam(), [&](std::uint64_t block, unsigned) { ++times[block]; });
    for (const std::atomic<int>& count : times) {
        EXPECT_EQ(count, 1);
    }
}

TEST_P(Parallel, RunsEveryBlockOnceWhenTheFirstIsLate) {
    std::vector<std::atomic<int>> times(kBlocks);
    std::atomic<std::uint64_t> done{0};
    std::atomic<std::uint64_t> done_before_the_first{0};
    parallel_blocks(kBlocks, GetParam(), [&](std::uint64_t block, unsigned) {
        if (block == 0 && GetParam() > 1) {
            while (done < kBlocks - 1) {
                std::this_thread::yield();
            }
            done_before_the_first = done.load();
        }
        ++times[block];
        ++done;
    });
    for (const std::atomic<int>& count : times) {
        EXPECT_EQ(count, 1);
    }
    EXPECT_EQ(done_before_the_first, GetParam() > 1 ? kBlocks - 1 : 0);
}

TEST_P(Parallel, LetsNoTwoBlocksShareAWorkerAtOnce) {
    std::vector<std::atomic<int>> busy(GetParam());
    std::atomic<bool> shared{false};
    parallel_blocks(kBlocks, GetParam(), [&](std::uint64_t, unsigned worker) {
        shared = shared || ++busy.at(worker) > 1;
        std::this_thread::yield();
        --busy[worker];
    });
    EXPECT_FALSE(shared);
}

TEST_P(Parallel, RethrowsAndRunsNoMoreBlocks) {
    std::atomic<std::uint64_t> started{0};
    const auto fail_at_ten = [&](std::uint64_t block, unsigned) {
        ++started;
        if (block == 10) {
            throw std::runtime_error("block ten");
        }
    };
    const std::uint64_t many = 1ULL << 40;  // would take hours
    try {
        parallel_blocks(many, GetParam(), fail_at_ten);
        FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "block ten");
    }
    EXPECT_GE(started, 11U);
}

TEST_P(Parallel, SurvivesAnExceptionFromEveryWorker) {
    const auto fail = [](std::uint64_t, unsigned) { throw std::logic_error("all"); };
    EXPECT_THROW(parallel_blocks(kBlocks, GetParam(), fail), std::logic_error);
}

TEST_P(Parallel, DoesNothingWithoutBlocks) {
    parallel_blocks(0, GetParam(), [](std::uint64_t, unsigned) { FAIL(); });
}

TEST_P(Parallel, UsesBlocksInTheirOrderWhenTheFirstIsLate) {
    std::atomic<std::uint64_t> prepared{0};
    std::vector<std::uint64_t> order;  // written by one at a time
    ordered_blocks(
        kBlocks, GetParam(),
        [&](std::uint64_t block, unsigned) {
            while (block == 0 && GetParam() > 1 && prepared < GetParam() - 1) {
                std::this_thread::yield();
            }
            ++prepared;
        },
        [&](std::uint64_t block, unsigned) { order.push_back(block); });
    std::vector<std::uint64_t> expected(kBlocks);
    std::iota(expected.begin(), expected.end(), 0);
    EXPECT_EQ(order, expected);
}

TEST_P(Parallel, UsesNothingAfterAFailure) {
    for (const bool fails_in_turn : {false, true}) {
        std::uint64_t used = 0;
        const auto fail_at_ten = [](bool fails, std::uint64_t block) {
            if (fails && block == 10) {
                throw std::runtime_error("block ten");
            }
        };
        EXPECT_THROW(
            ordered_blocks(
                1ULL << 40U, GetParam(),
                [&](std::uint64_t block, unsigned) { fail_at_ten(!fails_in_turn, block); },
                [&](std::uint64_t block, unsigned) {
                    fail_at_ten(fails_in_turn, block);
                    ++used;
                }),
            std::runtime_error);
        EXPECT_LE(used, 10U);
    }
}

INSTANTIATE_TEST_SUITE_P(Workers, Parallel, ::testing::Values(1U, 2U, 7U));

TEST(ParallelBlocks, HandsBlocksOutInOrder) {
    std::vector<std::uint64_t> order;
    parallel_blocks(kBlocks, 1, [&](std::uint64_t block, unsigned) { order.push_back(block); });
    std::vector<std::uint64_t> expected(kBlocks);
    std::iota(expected.begin(), expected.end(), 0);
    EXPECT_EQ(order, expected);
}

TEST(ParallelBlocks, TakesNoWorkersForOne) {
    int runs = 0;
    parallel_blocks(5, 0, [&](std::uint64_t, unsigned worker) { runs += worker == 0 ? 1 : 100; });
    EXPECT_EQ(runs, 5);
}

TEST(ParallelBlocks, StartsNoMoreWorkersThanThereAreBlocks) {
    std::vector<std::atomic<int>> used(2);
    parallel_blocks(2, 1000000, [&](std::uint64_t, unsigned worker) { ++used.at(worker); });
    EXPECT_EQ(used[0] + used[1], 2);
}

TEST(ThreadCount, IsWhatWasAsked) {
    EXPECT_EQ(thread_count(1), 1U);
    EXPECT_EQ(thread_count(77), 77U);
}

TEST(ThreadCount, IsAtLeastOneByDefault) {
    EXPECT_GE(thread_count(0), 1U);
}

}  // namespace
}  // namespace quasimc

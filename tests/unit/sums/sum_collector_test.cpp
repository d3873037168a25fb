#include "sums/sum_collector.h"

#include <array>

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "support/light_layout.h"

namespace quasimc {
namespace {

constexpr double kPrivate = 1e9;
constexpr double kShared = 0;

SumData sums_of(const SumLayout& layout, std::size_t replicates) {
    SumData sums;
    sums.layout = layout;
    sums.replicates.assign(replicates, ExactBins(layout.bins()));
    return sums;
}

/// The sums of four replicates of a made-up run: every block adds to three bins of its replicate,
/// `amount` to one of them.
SumData counted(
    unsigned workers,
    double most_private_bytes,
    std::size_t private_regions,
    std::int64_t amount = 1) {
    const LightLayout layout(6, 1, 2);
    SumData sums = sums_of(layout, 4);
    SumCollector collector(sums, workers, most_private_bytes, private_regions);
    constexpr std::uint64_t kBlocks = 400;
    parallel_blocks(kBlocks, workers, [&](std::uint64_t block, unsigned worker) {
        const auto replicate = static_cast<std::uint32_t>(block * 7 % 4);
        Tally& tally = collector.tally_for(worker, replicate);
        for (std::size_t e = 0; e < layout.regions(); ++e) {
            tally.add(layout.sunlit(e), static_cast<std::int64_t>(block + e));
            tally.add(
                layout.scattered(e, SurfaceSide::lower), std::array<std::int64_t, 2>{amount, 2});
        }
        tally.add(layout.work(WorkUnit::ray), 1);
    });
    collector.collect();
    return sums;
}

TEST(SumCollector, SumsEachReplicateForItself) {
    const SumData sums = counted(1, kPrivate, 0);
    ASSERT_EQ(sums.replicates.size(), 4U);
    for (std::uint32_t r = 0; r < 4; ++r) {
        std::int64_t sum = 0;
        for (std::uint64_t block = 0; block < 400; ++block) {
            sum += block * 7 % 4 == r ? static_cast<std::int64_t>(block + 2) : 0;
        }
        const ExactBins& bins = sums.replicates[r];
        EXPECT_EQ(bins.quanta(LightBlocks(sums.layout).work(WorkUnit::ray)).low, 100);
        EXPECT_EQ(bins.quanta(LightBlocks(sums.layout).sunlit(2)).low, sum);
        EXPECT_EQ(
            bins.quanta(LightBlocks(sums.layout).scattered(5, SurfaceSide::lower) + 1).low, 200);
    }
}

TEST(SumCollector, SumsTheSamePrivateOrSharedOnAnyNumberOfWorkers) {
    // The larger amount fills bins many times over. It is as large as may be: once a shared bin is
    // full, each of seven workers may add to it before one of them empties it, and it has room for
    // as much again.
    for (const std::int64_t amount : {std::int64_t{1}, ExactBins::kCarry / 8}) {
        const SumData expected = counted(1, kPrivate, 0, amount);
        for (const unsigned workers : {1U, 2U, 7U}) {
            EXPECT_TRUE(counted(workers, kPrivate, 0, amount) == expected) << workers;
            for (const std::size_t private_regions : {0U, 1U, 6U, 100U}) {
                SumData shared = counted(workers, kShared, private_regions, amount);
                for (ExactBins& bins : shared.replicates) {
                    bins.settle();
                }
                EXPECT_TRUE(shared == expected) << workers << " " << private_regions;
            }
        }
    }
}

TEST(SumCollector, SumsWhatNoNumberOfItsOwnCouldHold) {
    const SumData sums = counted(2, kPrivate, 0, ExactBins::kCarry / 4 * 3);
    const ExactBins::Quanta quanta =
        sums.replicates[1].quanta(LightBlocks(sums.layout).scattered(3, SurfaceSide::lower));
    EXPECT_EQ(quanta, (ExactBins::Quanta{75, 0}));
    EXPECT_EQ(
        sums.replicates[1].value(LightBlocks(sums.layout).scattered(3, SurfaceSide::lower)),
        75 * from_fixed(ExactBins::kCarry));
}

/// Whether what a worker adds is in the sums at once.
bool is_shared(const LightLayout& layout) {
    SumData sums = sums_of(layout, 1);
    SumCollector collector(sums, 1, kPrivate, 2);
    collector.tally_for(0, 0).add(layout.sunlit(5), 3);
    const bool is_there = sums.replicates[0].quanta(layout.sunlit(5)).low == 3;
    collector.collect();
    EXPECT_EQ(sums.replicates[0].quanta(layout.sunlit(5)).low, 3);
    return is_there;
}

TEST(SumCollector, SharesWhatManyRegionsAreMetIn) {
    constexpr std::size_t kMany = 1 << 17;
    EXPECT_TRUE(is_shared({kMany, 1, 1}));
    EXPECT_FALSE(is_shared({kMany - 1, 1, 1}));
    EXPECT_FALSE(is_shared({kMany, 1, 20})) << "of many bands";
}

TEST(SumCollector, KeepsNothingBackAfterCollecting) {
    SumData sums = sums_of(LightLayout(1, 1, 1), 2);
    const std::size_t rays = LightBlocks(sums.layout).work(WorkUnit::ray);
    SumCollector collector(sums, 1, kPrivate, 0);
    collector.tally_for(0, 1).add(rays, 3);
    collector.collect();
    collector.collect();
    EXPECT_EQ(sums.replicates[1].quanta(rays).low, 3);
    collector.tally_for(0, 1).add(rays, 4);
    collector.collect();
    EXPECT_EQ(sums.replicates[1].quanta(rays).low, 7);
    EXPECT_EQ(sums.replicates[0].quanta(rays).low, 0);
}

}  // namespace
}  // namespace quasimc

#include "sums/replicates.h"

#include <array>

#include <gtest/gtest.h>

#include "base/parallel.h"

namespace quasimc {
namespace {

using Cells = std::vector<std::vector<std::int64_t>>;

constexpr double kPrivate = 1e9;
constexpr double kShared = 0;

/// The sums of four replicates of a made-up run: every block adds to three cells of its replicate.
Cells counted(unsigned workers, double most_private_bytes, std::size_t private_regions) {
    const TallyLayout layout{6, 1, 2};
    Replicates replicates(layout, 4, workers, most_private_bytes, private_regions);
    constexpr std::uint64_t kBlocks = 400;
    parallel_blocks(kBlocks, workers, [&](std::uint64_t block, unsigned worker) {
        const auto replicate = static_cast<std::uint32_t>(block * 7 % 4);
        Tally& tally = replicates.tally_for(worker, replicate);
        for (std::size_t e = 0; e < layout.regions; ++e) {
            tally.add(layout.sunlit(e), static_cast<std::int64_t>(block + e));
            tally.add(layout.scattered(e, true), std::array<std::int64_t, 2>{1, 2});
        }
        tally.add(layout.rays(), 1);
    });
    replicates.collect();
    Cells cells;
    for (std::uint32_t r = 0; r < replicates.count(); ++r) {
        cells.emplace_back(replicates.cells(r).begin(), replicates.cells(r).end());
    }
    return cells;
}

TEST(Replicates, CountEachForItself) {
    const TallyLayout layout{6, 1, 2};
    const Cells cells = counted(1, kPrivate, 0);
    ASSERT_EQ(cells.size(), 4U);
    for (std::uint32_t r = 0; r < 4; ++r) {
        std::int64_t sum = 0;
        for (std::uint64_t block = 0; block < 400; ++block) {
            sum += block * 7 % 4 == r ? static_cast<std::int64_t>(block + 2) : 0;
        }
        EXPECT_EQ(cells[r][layout.rays()], 100);
        EXPECT_EQ(cells[r][layout.sunlit(2)], sum);
        EXPECT_EQ(cells[r][layout.scattered(5, true) + 1], 200);
    }
}

TEST(Replicates, CountTheSamePrivateOrSharedOnAnyNumberOfWorkers) {
    const Cells expected = counted(1, kPrivate, 0);
    for (const unsigned workers : {1U, 2U, 7U}) {
        EXPECT_EQ(counted(workers, kPrivate, 0), expected) << workers;
        for (const std::size_t private_regions : {0U, 1U, 6U, 100U}) {
            EXPECT_EQ(counted(workers, kShared, private_regions), expected)
                << workers << " " << private_regions;
        }
    }
}

TEST(Replicates, KeepNothingBackAfterCollecting) {
    const TallyLayout layout{1, 1, 1};
    Replicates replicates(layout, 2, 1, kPrivate, 0);
    replicates.tally_for(0, 1).add(layout.rays(), 3);
    replicates.collect();
    replicates.collect();
    EXPECT_EQ(replicates.cells(1)[layout.rays()], 3);
    replicates.tally_for(0, 1).add(layout.rays(), 4);
    replicates.collect();
    EXPECT_EQ(replicates.cells(1)[layout.rays()], 7);
    EXPECT_EQ(replicates.cells(0)[layout.rays()], 0);
}

}  // namespace
}  // namespace quasimc

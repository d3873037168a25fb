#include "sums/tally.h"

#include <map>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace quasimc {
namespace {

TEST(FixedPoint, KeepsWholeUnitsAndRoundsToNearest) {
    EXPECT_EQ(to_fixed(0), 0);
    EXPECT_EQ(from_fixed(to_fixed(1)), 1);
    EXPECT_EQ(from_fixed(to_fixed(12345.5)), 12345.5);
    EXPECT_EQ(to_fixed(0.49 / kFixedOne), 0);
    EXPECT_EQ(to_fixed(0.51 / kFixedOne), 1);
    EXPECT_NEAR(from_fixed(to_fixed(0.1)), 0.1, 0.5 / kFixedOne);
}

TEST(FixedPoint, AddsTheSameInAnyOrder) {
    std::mt19937_64 bits(5);
    std::vector<std::int64_t> amounts(1000);
    for (std::int64_t& amount : amounts) {
        amount = to_fixed(std::uniform_real_distribution<double>(0, 3)(bits));
    }
    std::int64_t forward = 0;
    std::int64_t backward = 0;
    for (std::size_t i = 0; i < amounts.size(); ++i) {
        forward += amounts[i];
        backward += amounts[amounts.size() - 1 - i];
    }
    EXPECT_EQ(forward, backward);
}

/// Every cell of a layout with what it is for.
std::multimap<std::size_t, std::string> cells_of(const TallyLayout& layout) {
    std::multimap<std::size_t, std::string> cells;
    const auto add_row = [&](std::size_t first, std::size_t count, const std::string& what) {
        for (std::size_t i = 0; i < count; ++i) {
            cells.emplace(first + i, what);
        }
    };
    for (std::size_t e = 0; e < layout.regions; ++e) {
        for (const bool lower : {false, true}) {
            for (std::size_t s = 0; s < layout.spectra; ++s) {
                add_row(layout.direct(e, lower, s), 1, "direct");
            }
            add_row(layout.scattered(e, lower), layout.bands, "scattered");
        }
        add_row(layout.sunlit(e), 1, "sunlit");
    }
    add_row(layout.emitted(), layout.spectra, "emitted");
    add_row(layout.escaped_direct(), layout.spectra, "escaped direct");
    add_row(layout.escaped_scattered(), layout.bands, "escaped scattered");
    add_row(layout.scattered_out(), layout.bands, "scattered out");
    add_row(layout.cut_off(), layout.bands, "cut off");
    add_row(layout.rays(), 1, "rays");
    return cells;
}

TEST(TallyLayout, GivesEveryCellOneMeaning) {
    for (const TallyLayout& layout :
         {TallyLayout{0, 1, 1}, {1, 1, 1}, {3, 1, 4}, {3, 5, 1}, {7, 2, 3}, {2, 0, 2}}) {
        const std::multimap<std::size_t, std::string> cells = cells_of(layout);
        EXPECT_EQ(cells.size(), layout.cells());
        std::size_t next = 0;
        for (const auto& [cell, what] : cells) {
            EXPECT_EQ(cell, next) << what;
            ++next;
        }
    }
}

TEST(TallyLayout, KeepsTheCellsOfAnElementTogether) {
    const TallyLayout layout{4, 2, 3};
    EXPECT_EQ(layout.stride(), 2U * 2 + 2 * 3 + 1);
    for (std::size_t e = 0; e < 4; ++e) {
        EXPECT_EQ(layout.direct(e, false, 0), e * layout.stride());
        EXPECT_EQ(layout.sunlit(e), (e + 1) * layout.stride() - 1);
    }
}

TEST(Tally, AddsRowsAndSingleCells) {
    const TallyLayout layout{2, 1, 2};
    Tally tally(layout);
    tally.add(layout.sunlit(1), 5);
    const std::vector<std::int64_t> amounts{7, 8};
    tally.add(layout.scattered(1, true), amounts);
    tally.add(layout.scattered(1, true), amounts);
    std::vector<std::int64_t> total(layout.cells(), 100);
    tally.merge_into(total);
    for (std::size_t i = 0; i < total.size(); ++i) {
        std::int64_t expected = 100;
        expected += i == layout.sunlit(1) ? 5 : 0;
        expected += i == layout.scattered(1, true) ? 14 : 0;
        expected += i == layout.scattered(1, true) + 1 ? 16 : 0;
        EXPECT_EQ(total[i], expected) << i;
    }
}

TEST(Tally, IsEmptyAfterMerging) {
    const TallyLayout layout{2, 1, 1};
    Tally tally(layout);
    tally.add(layout.rays(), 3);
    std::vector<std::int64_t> total(layout.cells());
    tally.merge_into(total);
    tally.merge_into(total);
    EXPECT_EQ(total[layout.rays()], 3);
}

TEST(Tally, LeavesSharedCellsToTheSharedArrayAndKeepsTheOthers) {
    const TallyLayout layout{3, 1, 1};
    std::vector<std::int64_t> shared(layout.cells());
    Tally tally(layout, 2, shared);
    tally.add(layout.sunlit(1), 5);
    tally.add(layout.sunlit(2), 6);
    tally.add(layout.rays(), 7);
    EXPECT_EQ(shared[layout.sunlit(1)], 5);
    EXPECT_EQ(shared[layout.sunlit(2)], 0);
    EXPECT_EQ(shared[layout.rays()], 0);
    tally.merge_into(shared);
    EXPECT_EQ(shared[layout.sunlit(1)], 5);
    EXPECT_EQ(shared[layout.sunlit(2)], 6);
    EXPECT_EQ(shared[layout.rays()], 7);
}

TEST(Tally, AddsTwoCellsOfAnElementWhereverItIs) {
    const TallyLayout layout{3, 2, 2};
    for (const std::size_t shared_elements : {0, 1, 2, 3}) {
        std::vector<std::int64_t> cells(layout.cells());
        Tally tally(layout, shared_elements, cells);
        tally.add_two(1, 0, 5, layout.sunlit(0), 6);
        tally.merge_into(cells);
        EXPECT_EQ(cells[layout.direct(1, false, 0)], 5) << shared_elements;
        EXPECT_EQ(cells[layout.sunlit(1)], 6) << shared_elements;
    }
}

/// What `threads` workers count together, each adding pseudo-random amounts, when the first
/// `shared` elements are shared. The first worker starts last, on purpose.
std::vector<std::int64_t> counted(const TallyLayout& layout, unsigned threads, std::size_t shared) {
    std::vector<std::int64_t> cells(layout.cells());
    std::vector<Tally> tallies(threads, Tally(layout, shared, cells));
    constexpr unsigned kJobs = 12;
    constexpr int kAdditions = 2000;
    const auto work = [&](unsigned worker) {
        for (unsigned job = worker; job < kJobs; job += threads) {
            std::mt19937_64 bits(job);
            for (int i = 0; i < kAdditions; ++i) {
                const std::size_t cell = bits() % layout.cells();
                tallies[worker].add(cell, static_cast<std::int64_t>(bits() % 1000));
                const std::vector<std::int64_t> row(layout.bands, 1);
                tallies[worker].add(layout.scattered(bits() % layout.regions, false), row);
                tallies[worker].add_two(bits() % layout.regions, 0, 2, layout.sunlit(0), 3);
            }
        }
    };
    {
        std::vector<std::jthread> pool;
        for (unsigned worker = 1; worker < threads; ++worker) {
            pool.emplace_back(work, worker);
        }
        if (threads > 1) {
            pool.front().join();
        }
        work(0);
    }
    for (Tally& tally : tallies) {
        tally.merge_into(cells);
    }
    return cells;
}

TEST(Tally, CountsTheSamePrivateOrSharedOnAnyNumberOfThreads) {
    const TallyLayout layout{5, 2, 3};
    const std::vector<std::int64_t> expected = counted(layout, 1, 0);
    for (const unsigned threads : {1U, 2U, 5U}) {
        for (const std::size_t shared : {0U, 3U, 5U}) {
            EXPECT_EQ(counted(layout, threads, shared), expected) << threads << " " << shared;
        }
    }
}

}  // namespace
}  // namespace quasimc

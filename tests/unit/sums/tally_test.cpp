#include "sums/tally.h"

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "quasimc/error.h"
#include "support/light_layout.h"

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

/// Every bin of a layout with what it is for.
std::multimap<std::size_t, std::string> bins_of(
    const LightLayout& layout, std::size_t spectra, std::size_t bands) {
    std::multimap<std::size_t, std::string> bins;
    const auto add_row = [&](std::size_t first, std::size_t count, const std::string& what) {
        for (std::size_t i = 0; i < count; ++i) {
            bins.emplace(first + i, what);
        }
    };
    for (std::size_t e = 0; e < layout.regions(); ++e) {
        for (const SurfaceSide side : kSurfaceSides) {
            for (std::size_t s = 0; s < spectra; ++s) {
                add_row(layout.direct(e, side, s), 1, "direct");
            }
            add_row(layout.scattered(e, side), bands, "scattered");
        }
        add_row(layout.sunlit(e), 1, "sunlit");
    }
    add_row(layout.emitted(), spectra, "emitted");
    add_row(layout.escaped_direct(), spectra, "escaped direct");
    add_row(layout.escaped_scattered(), bands, "escaped scattered");
    add_row(layout.scattered_out(), bands, "scattered out");
    add_row(layout.cut_off(), bands, "cut off");
    add_row(layout.work(WorkUnit::ray), kWorkUnits, "work");
    return bins;
}

TEST(SumLayout, GivesEveryBinOneMeaning) {
    for (const auto& [regions, spectra, bands] :
         {std::array<std::size_t, 3>{0, 1, 1},
          {1, 1, 1},
          {3, 1, 4},
          {3, 5, 1},
          {7, 2, 3},
          {2, 0, 2}}) {
        const LightLayout layout(regions, spectra, bands);
        const std::multimap<std::size_t, std::string> bins = bins_of(layout, spectra, bands);
        EXPECT_EQ(bins.size(), layout.bins());
        std::size_t next = 0;
        for (const auto& [bin, what] : bins) {
            EXPECT_EQ(bin, next) << what;
            ++next;
        }
    }
}

TEST(SumLayout, FindsBlocksByName) {
    const SumLayout layout(
        3, {{"a", SumBlock::Rows::regions, columns_of(SumColumn::Of::band, 2)},
            {"all", SumBlock::Rows::run, {{SumColumn::Of::number}}},
            {"b", SumBlock::Rows::regions, {{SumColumn::Of::area}}}});
    EXPECT_EQ(layout.bins(), 10U);
    EXPECT_EQ(layout.find("a").bin(1, 1), 4U);
    EXPECT_EQ(layout.find("b").bin(2), 8U);
    EXPECT_EQ(layout.find("all").bin(0), 9U);
    EXPECT_TRUE(layout.find("b").exists());
    EXPECT_FALSE(layout.find("c").exists());
}

TEST(SumLayout, KeepsTheBinsOfARegionTogether) {
    const LightLayout layout(4, 2, 3);
    EXPECT_EQ(layout.stride(), 2U * 2 + 2 * 3 + 1);
    for (std::size_t e = 0; e < 4; ++e) {
        EXPECT_EQ(layout.direct(e, SurfaceSide::upper, 0), e * layout.stride());
        EXPECT_EQ(layout.sunlit(e), (e + 1) * layout.stride() - 1);
    }
}

TEST(Tally, AddsRowsAndSingleBins) {
    const LightLayout layout(2, 1, 2);
    Tally tally(layout);
    tally.add(layout.sunlit(1), 5);
    const std::vector<std::int64_t> amounts{7, 8};
    tally.add(layout.scattered(1, SurfaceSide::lower), amounts);
    tally.add(layout.scattered(1, SurfaceSide::lower), amounts);
    ExactBins total(layout.bins());
    for (std::size_t i = 0; i < total.size(); ++i) {
        total.add(i, 100);
    }
    tally.move_into(total);
    for (std::size_t i = 0; i < total.size(); ++i) {
        std::int64_t expected = 100;
        expected += i == layout.sunlit(1) ? 5 : 0;
        expected += i == layout.scattered(1, SurfaceSide::lower) ? 14 : 0;
        expected += i == layout.scattered(1, SurfaceSide::lower) + 1 ? 16 : 0;
        EXPECT_EQ(total.quanta(i).low, expected) << i;
    }
}

TEST(Tally, IsEmptyAfterMerging) {
    const LightLayout layout(2, 1, 1);
    Tally tally(layout);
    tally.count(WorkUnit::ray, 3);
    ExactBins total(layout.bins());
    tally.move_into(total);
    tally.move_into(total);
    EXPECT_EQ(total.quanta(layout.work(WorkUnit::ray)).low, 3);
}

TEST(Tally, LeavesSharedBinsToTheSharedArrayAndKeepsTheOthers) {
    const LightLayout layout(3, 1, 1);
    ExactBins sums(layout.bins());
    const std::span<std::int64_t> shared = sums.shared();
    Tally tally(layout, 2, shared);
    tally.add(layout.sunlit(1), 5);
    tally.add(layout.sunlit(2), 6);
    tally.add(layout.work(WorkUnit::ray), 7);
    EXPECT_EQ(shared[layout.sunlit(1)], 5);
    EXPECT_EQ(shared[layout.sunlit(2)], 0);
    EXPECT_EQ(shared[layout.work(WorkUnit::ray)], 0);
    tally.move_into(sums);
    EXPECT_EQ(shared[layout.sunlit(1)], 5);
    EXPECT_EQ(shared[layout.sunlit(2)], 6);
    EXPECT_EQ(shared[layout.work(WorkUnit::ray)], 7);
}

TEST(Tally, AddsTwoBinsOfARegionWhereverItIs) {
    const LightLayout layout(3, 2, 2);
    for (const std::size_t shared_regions : {0, 1, 2, 3}) {
        ExactBins sums(layout.bins());
        const std::span<std::int64_t> bins = sums.shared();
        Tally tally(layout, shared_regions, bins);
        tally.add_two(1, 0, 5, layout.sunlit(0), 6);
        tally.move_into(sums);
        EXPECT_EQ(bins[layout.direct(1, SurfaceSide::upper, 0)], 5) << shared_regions;
        EXPECT_EQ(bins[layout.sunlit(1)], 6) << shared_regions;
    }
}

/// What `threads` workers count together, each adding pseudo-random amounts, when the first
/// `shared` regions are shared. The first worker starts last, on purpose.
ExactBins counted(const LightLayout& layout, unsigned threads, std::size_t shared) {
    ExactBins sums(layout.bins());
    std::vector<Tally> tallies(threads, Tally(layout, shared, sums.shared()));
    constexpr unsigned kJobs = 12;
    constexpr int kAdditions = 2000;
    const auto work = [&](unsigned worker) {
        for (unsigned job = worker; job < kJobs; job += threads) {
            std::mt19937_64 bits(job);
            for (int i = 0; i < kAdditions; ++i) {
                const std::size_t bin = bits() % layout.bins();
                tallies[worker].add(bin, static_cast<std::int64_t>(bits() % 1000));
                const std::vector<std::int64_t> row(layout.scattered_blocks().escaped.columns, 1);
                tallies[worker].add(
                    layout.scattered(bits() % layout.regions(), SurfaceSide::upper), row);
                tallies[worker].add_two(bits() % layout.regions(), 0, 2, layout.sunlit(0), 3);
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
        tally.move_into(sums);
    }
    return sums;
}

TEST(Tally, CountsTheSamePrivateOrSharedOnAnyNumberOfThreads) {
    const LightLayout layout(5, 2, 3);
    const ExactBins expected = counted(layout, 1, 0);
    for (const unsigned threads : {1U, 2U, 5U}) {
        for (const std::size_t shared : {0U, 3U, 5U}) {
            EXPECT_TRUE(counted(layout, threads, shared) == expected) << threads << " " << shared;
        }
    }
}

TEST(FixedPoint, RefusesWhatIsNoNumberOrTooLarge) {
    EXPECT_EQ(from_fixed(to_fixed(kLargestAmount / 2)), kLargestAmount / 2);
    for (const double amount :
         {kLargestAmount, 1e300, double{INFINITY}, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_THROW(static_cast<void>(to_fixed(amount)), InputError) << amount;
    }
}

TEST(Tally, TellsWhenItIsFull) {
    const LightLayout layout(1, 1, 1);
    Tally tally(layout);
    tally.add(0, ExactBins::kCarry - 1);
    EXPECT_FALSE(tally.is_full());
    tally.add(0, 1);
    EXPECT_TRUE(tally.is_full());
    ExactBins sums(layout.bins());
    tally.move_into(sums);
    EXPECT_FALSE(tally.is_full());
    EXPECT_EQ(sums.quanta(0), (ExactBins::Quanta{1, 0}));
}

TEST(Tally, NeverWrapsInSilence) {
    const LightLayout layout(1, 1, 2);
    const std::vector<std::int64_t> row{1, ExactBins::kCarry};
    const std::vector<std::function<void(Tally&)>> ways{
        [](Tally& t) { t.add(0, ExactBins::kCarry); },
        [](Tally& t) { t.add_two(0, 0, 1, 1, ExactBins::kCarry); },
        [&](Tally& t) { t.add(0, row); }, [](Tally& t) { t.add_signed(0, ExactBins::kCarry); },
        [](Tally& t) { t.add_signed(0, -ExactBins::kCarry); }};
    for (std::size_t i = 0; i < ways.size(); ++i) {
        Tally tally(layout);
        ExactBins sums(layout.bins());
        ways[i](tally);
        ways[i](tally);
        ways[i](tally);
        EXPECT_THROW(tally.move_into(sums), InputError) << i;
    }
}

/// Adding an amount 2^k times gives 2^k times the amount, however large.
RC_GTEST_PROP(Tally, SumsManyEqualAmountsExactly, ()) {
    const LightLayout layout(1, 1, 1);
    const auto amount = *rc::gen::inRange<std::int64_t>(1, std::int64_t{1} << 61U);
    const auto log2_count = *rc::gen::inRange(0, 12);
    const bool is_shared = *rc::gen::arbitrary<bool>();
    ExactBins sums(layout.bins());
    Tally tally(layout, is_shared ? 1 : 0, sums.shared());
    for (int i = 0; i < 1 << log2_count; ++i) {
        tally.add(0, amount);
        if (tally.is_full()) {
            tally.move_into(sums);
            sums.settle();
        }
    }
    tally.move_into(sums);
    sums.settle();
    // In two parts that hold the product: of the high and the low 31 bits of the amount.
    const std::int64_t high = (amount >> 31U) << log2_count;
    const std::int64_t low = (amount & 0x7FFFFFFF) << log2_count;
    const std::int64_t top = high + (low >> 31U);
    RC_ASSERT(
        sums.quanta(0) ==
        (ExactBins::Quanta{top >> 31U, ((top & 0x7FFFFFFF) << 31U) | (low & 0x7FFFFFFF)}));
}

}  // namespace
}  // namespace quasimc

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "sums/fixed_point.h"

namespace quasimc {
namespace {

constexpr std::int64_t kCarry = ExactBins::kCarry;
using Quanta = ExactBins::Quanta;

TEST(ExactBins, AddsWhatFitsIntoOneNumber) {
    ExactBins bins(2);
    bins.add(0, 5);
    bins.add(0, kCarry - 6);
    bins.add(1, -3);
    EXPECT_EQ(bins.quanta(0), (Quanta{0, kCarry - 1}));
    EXPECT_EQ(bins.quanta(1), (Quanta{0, -3}));
    EXPECT_EQ(bins.value(1), from_fixed(-3));
}

TEST(ExactBins, CarriesWhatDoesNot) {
    ExactBins bins(3);
    for (int i = 0; i < 10; ++i) {
        bins.add(0, kCarry - 1);
        bins.add(1, -(kCarry - 1));
        bins.add(2, std::numeric_limits<std::int64_t>::max());
    }
    EXPECT_EQ(bins.quanta(0), (Quanta{9, kCarry - 10}));
    EXPECT_EQ(bins.quanta(1), (Quanta{-9, -(kCarry - 10)}));
    EXPECT_EQ(bins.quanta(2), (Quanta{19, kCarry - 10}));
    EXPECT_DOUBLE_EQ(bins.value(0), 10 * from_fixed(kCarry));
    EXPECT_DOUBLE_EQ(bins.value(1), -10 * from_fixed(kCarry));
}

TEST(ExactBins, AddsOthersWithTheirCarries) {
    ExactBins a(2);
    ExactBins b(2);
    a.add(0, kCarry - 1);
    b.add(0, kCarry - 1);
    b.add(0, kCarry - 1);
    b.add(1, 7);
    a += b;
    EXPECT_EQ(a.quanta(0), (Quanta{2, kCarry - 3}));
    EXPECT_EQ(a.quanta(1), (Quanta{0, 7}));
    ExactBins c(2);
    c.add(0, kCarry - 1);
    b += c;
    EXPECT_TRUE(a.quanta(0) == b.quanta(0)) << "in any order";
}

TEST(ExactBins, AreClearedWithinPagesAndOverThem) {
    constexpr std::size_t kBins = 50000;  // some pages
    for (const std::int64_t quanta : {std::int64_t{7}, std::numeric_limits<std::int64_t>::max()}) {
        for (const auto& [first, last] : std::vector<std::pair<std::size_t, std::size_t>>{
                 {0, kBins}, {3, 49990}, {700, 705}, {kBins, kBins}}) {
            ExactBins bins(kBins);
            ExactBins expected(kBins);
            for (std::size_t i = 0; i < kBins; ++i) {
                bins.add(i, quanta);
                if (i < first || i >= last) {
                    expected.add(i, quanta);
                }
            }
            bins.clear(first, last);
            EXPECT_TRUE(bins == expected) << first << " to " << last;
            bins.add(3000, 1);  // they are as new
            expected.add(3000, 1);
            EXPECT_EQ(bins.quanta(3000), expected.quanta(3000));
        }
    }
}

TEST(ExactBins, SettlesWhatOthersAdded) {
    ExactBins bins(2);
    bins.shared()[0] = kCarry + 4;
    bins.shared()[1] = 4;
    bins.settle();
    EXPECT_EQ(bins.quanta(0), (Quanta{1, 4}));
    EXPECT_EQ(bins.quanta(1), (Quanta{0, 4}));
}

TEST(ExactBins, AreEqualByTheirSums) {
    ExactBins a(1);
    ExactBins b(1);
    a.add(0, kCarry - 1);
    a.add(0, 1);
    a.add(0, -1);
    b.add(0, kCarry - 1);
    EXPECT_EQ(a.quanta(0), (Quanta{0, kCarry - 1}));
    EXPECT_TRUE(a == b);
    EXPECT_EQ(a.value(0), b.value(0));
    b.add(0, -1);
    EXPECT_FALSE(a == b);
    EXPECT_FALSE(a == ExactBins(2));
}

}  // namespace
}  // namespace quasimc

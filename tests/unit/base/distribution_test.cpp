#include "base/distribution.h"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace quasimc {
namespace {

TEST(PartOfInterval, IsBelowOneAlsoAtTheEnd) {
    EXPECT_EQ(part_of_interval(3, 2, 4), 0.25);
    EXPECT_EQ(part_of_interval(6, 2, 4), kBelowOne);
    EXPECT_EQ(part_of_interval(1.5, 2, 4), 0);
    EXPECT_EQ(part_of_interval(2, 2, 0), 0);
    EXPECT_LT(kBelowOne, 1);
    EXPECT_EQ(std::nextafter(kBelowOne, 2), 1);
}

TEST(PickInterval, InvertsARunningSum) {
    const std::array<double, 4> ends{1, 1, 4, 8};
    EXPECT_EQ(pick_interval(ends, 0).index, 0U);
    EXPECT_EQ(pick_interval(ends, 0.75).part, 0.75);
    EXPECT_EQ(pick_interval(ends, 1).index, 2U) << "an interval of no width is passed over";
    const IntervalPick third = pick_interval(ends, 2.5);
    EXPECT_EQ(third.index, 2U);
    EXPECT_EQ(third.part, 0.5);
    EXPECT_EQ(third.width, 3);
    EXPECT_EQ(pick_interval(ends, 8).index, 3U);
    EXPECT_EQ(pick_interval(ends, 8).part, kBelowOne);
}

TEST(IntervalBetween, TakesTheIntervalAboveABorder) {
    const std::array<double, 4> borders{0, 1, 3, 4};
    EXPECT_EQ(interval_between(borders, -1), 0U);
    EXPECT_EQ(interval_between(borders, 0.5), 0U);
    EXPECT_EQ(interval_between(borders, 1), 1U);
    EXPECT_EQ(interval_between(borders, 3.5), 2U);
    EXPECT_EQ(interval_between(borders, 4), 2U);
}

TEST(PiecewiseConstant2D, DrawsEachCellAsOftenAsItsShareSays) {
    const std::vector<double> shares{1, 0, 3, 0, 0, 0, 2, 1, 1};
    const PiecewiseConstant2D cells(shares, 3);
    EXPECT_EQ(cells.total(), 8);
    constexpr int kSteps = 64;  // all borders are among the points
    std::vector<int> drawn(shares.size());
    for (int i = 0; i < kSteps; ++i) {
        for (int j = 0; j < kSteps; ++j) {
            const auto cell = cells.pick((i + .5) / kSteps, (j + .5) / kSteps);
            ++drawn[3 * cell.row.index + cell.column.index];
            EXPECT_EQ(
                cells.probability(cell.row.index, cell.column.index),
                cell.row.width * cell.column.width);
        }
    }
    for (std::size_t i = 0; i < shares.size(); ++i) {
        EXPECT_EQ(drawn[i], shares[i] / 8 * kSteps * kSteps) << i;
        if (shares[i] > 0) {
            EXPECT_DOUBLE_EQ(cells.probability(i / 3, i % 3), shares[i] / 8);
        }
    }
}

TEST(PiecewiseConstant2D, FillsACellEvenly) {
    const std::vector<double> shares{1, 1};
    const PiecewiseConstant2D cells(shares, 2);
    const auto cell = cells.pick(0.25, 0.875);
    EXPECT_EQ(cell.row.part, 0.25);
    EXPECT_EQ(cell.column.index, 1U);
    EXPECT_EQ(cell.column.part, 0.75);
}

}  // namespace
}  // namespace quasimc

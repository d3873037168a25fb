#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "base/checks.h"

namespace quasimc {

/// The largest number below 1.
inline constexpr double kBelowOne = 0x1.fffffffffffffp-1;

/// Relative position of `x` in an interval of some width that begins at `begin`: 0 to below 1
/// despite rounding; 0 in an interval of no width.
[[nodiscard]] inline double part_of_interval(double x, double begin, double width) {
    return width > 0 ? std::clamp((x - begin) / width, 0.0, kBelowOne) : 0;
}

/// Position of a number among intervals.
struct IntervalPick {
    std::size_t index = 0;
    double part = 0;   ///< position in the interval, see part_of_interval
    double width = 0;  ///< of the interval
};

/// The width of an interval; the first begins at 0, and each ends at one of ascending `ends`.
[[nodiscard]] inline double interval_width(std::span<const double> ends, std::size_t index) {
    return ends[index] - (index == 0 ? 0 : ends[index - 1]);
}

/// The interval that contains `x`; the first begins at 0, and each ends at one of ascending `ends`,
/// at least one: the inverse of a cumulative distribution. The first whose end exceeds x, otherwise
/// the last; intervals of no width are skipped.
[[nodiscard]] inline IntervalPick pick_interval(std::span<const double> ends, double x) {
    const auto found = std::upper_bound(ends.begin(), ends.end() - 1, x);
    const auto index = static_cast<std::size_t>(found - ends.begin());
    const double width = interval_width(ends, index);
    return {index, part_of_interval(x, index == 0 ? 0 : ends[index - 1], width), width};
}

/// The index of the interval that contains `x`, between ascending borders, at least two: at a
/// border the interval above; beyond the ends the first or last.
[[nodiscard]] inline std::size_t interval_between(std::span<const double> borders, double x) {
    const auto above = std::upper_bound(borders.begin() + 1, borders.end() - 1, x);
    return static_cast<std::size_t>(above - borders.begin()) - 1;
}

/// Draws cells of a table in proportion to their shares: a row, then a cell of it.
class PiecewiseConstant2D {
  public:
    PiecewiseConstant2D() = default;
    /// @param shares   [row][column], 0 or more; a row of zeros yields its first cell
    /// @param columns  of each row, at least one
    PiecewiseConstant2D(std::span<const double> shares, std::size_t columns) : columns_(columns) {
        EXPECT(columns > 0 && shares.size() % columns == 0);
        for (std::size_t first = 0; first < shares.size(); first += columns) {
            row_ends_.push_back(append_sums(shares.subspan(first, columns), column_ends_));
        }
        const std::vector<double> rows = std::move(row_ends_);
        row_ends_.clear();
        total_ = append_sums(rows, row_ends_);
    }

    struct Cell {
        IntervalPick row;     ///< its width is the share of the row
        IntervalPick column;  ///< its width is the share of the cell among those of the row
    };
    /// The cell and the position in it for a point of the unit square.
    [[nodiscard]] Cell pick(double u0, double u1) const {
        const IntervalPick row = pick_interval(row_ends_, u0);
        return {row, pick_interval(ends_of(row.index), u1)};
    }

    [[nodiscard]] double probability(std::size_t row, std::size_t column) const {
        return interval_width(row_ends_, row) * interval_width(ends_of(row), column);
    }
    /// The sum of all shares.
    [[nodiscard]] double total() const { return total_; }

  private:
    [[nodiscard]] std::span<const double> ends_of(std::size_t row) const {
        return {&column_ends_[row * columns_], columns_};
    }

    /// Appends running sums, scaled so that the last is 1; all 1 if the sum is 0.
    static double append_sums(std::span<const double> shares, std::vector<double>& ends) {
        double sum = 0;
        for (const double share : shares) {
            ends.push_back(sum += share);
        }
        for (double& end : std::span(ends).last(shares.size())) {
            end = sum > 0 ? end / sum : 1;
        }
        return sum;
    }

    std::vector<double> row_ends_;     // the last is 1
    std::vector<double> column_ends_;  // [row][column], the last of each row is 1
    std::size_t columns_ = 0;
    double total_ = 0;
};

}  // namespace quasimc

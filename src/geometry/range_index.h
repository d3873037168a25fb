#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace quasimc {

/// Finds the range that contains an index, among adjacent ranges, in nearly constant time.
class RangeIndex {
  public:
    RangeIndex() = default;
    /// @param first  the first index of each range, ascending; ranges are not empty
    /// @param end    one past the last index of the last range
    RangeIndex(std::vector<std::uint32_t> first, std::uint32_t end)
        : first_(std::move(first)), end_(end) {
        if (first_.empty()) {
            return;
        }
        const std::uint32_t total = end_ - first_.front();
        // Approximately one page per range.
        shift_ = std::bit_width(total / static_cast<std::uint32_t>(first_.size()));
        pages_.reserve((total >> shift_) + 2);
        std::uint32_t range = 0;
        for (std::uint64_t page = 0; page <= (total >> shift_); ++page) {
            const std::uint64_t number = first_.front() + (page << shift_);
            while (range + 1 < first_.size() && first_[range + 1] <= number) {
                ++range;
            }
            pages_.push_back(range);
        }
        pages_.push_back(static_cast<std::uint32_t>(first_.size() - 1));
    }

    [[nodiscard]] std::size_t size() const { return first_.size(); }
    [[nodiscard]] std::uint32_t first(std::size_t range) const { return first_[range]; }
    [[nodiscard]] std::uint32_t count(std::size_t range) const {
        return (range + 1 < first_.size() ? first_[range + 1] : end_) - first_[range];
    }
    /// The range of an index between the first and the end.
    [[nodiscard]] std::uint32_t find(std::uint32_t number) const {
        const std::size_t page = (number - first_.front()) >> shift_;
        const auto begin = first_.begin() + pages_[page];
        const auto end = first_.begin() + pages_[page + 1] + 1;
        return static_cast<std::uint32_t>(
            std::upper_bound(begin, end, number) - first_.begin() - 1);
    }

  private:
    std::vector<std::uint32_t> first_,
        pages_;  // pages_[i]: the range of the first number of page i
    std::uint32_t end_ = 0;
    int shift_ = 0;
};

}  // namespace quasimc

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace quasimc {

/// Exact sums of any size: one 64-bit number for each bin, and a second one, which counts carries,
/// for all of them once the first of them needs it.
///
/// Between calls every bin's lower number lies within (-kCarry, kCarry), but for those that others
/// add to through shared().
class ExactBins {
  public:
    /// Steps that a carry stands for.
    static constexpr std::int64_t kCarry = std::int64_t{1} << 62U;

    /// Steps of a unit.
    static constexpr double kQuantaPerUnit = 268435456.0;

    ExactBins() = default;
    explicit ExactBins(std::size_t bins) : low_(bins) {}

    [[nodiscard]] std::size_t size() const { return low_.size(); }
    /// The sum in units.
    [[nodiscard]] double value(std::size_t bin) const {
        return carries_.empty() ? static_cast<double>(low_[bin]) / kQuantaPerUnit
                                : value_with_carries(bin);
    }
    /// The sum as steps: carries * kCarry + low, both of one sign. One sum is one pair, in whatever
    /// order it was added up.
    struct Steps {
        std::int64_t carries = 0, low = 0;
        friend bool operator==(const Steps&, const Steps&) = default;
    };
    [[nodiscard]] Steps steps(std::size_t bin) const {
        return carries_.empty() ? Steps{0, low_[bin]} : steps_with_carries(bin);
    }

    /// Adds any number of steps to a bin.
    void add(std::size_t bin, std::int64_t steps) {
        std::int64_t sum = 0;
        const bool is_out = __builtin_add_overflow(low_[bin], steps, &sum);
        if (is_out || sum >= kCarry || sum <= -kCarry) [[unlikely]] {
            add_with_carry(bin, steps);
        } else {
            low_[bin] = sum;
        }
    }
    void add(std::size_t bin, Steps steps);
    /// Adds the sums of another, of the same size.
    ExactBins& operator+=(const ExactBins& other);

    /// The lower numbers, to which workers may add atomically. settle() carries what has grown too
    /// large; each may grow by kCarry in between.
    [[nodiscard]] std::span<std::int64_t> shared() { return low_; }
    void settle();

    /// Makes the bins from `first` up to `last` 0, which most of their memory is not needed for.
    void clear(std::size_t first, std::size_t last);

    friend bool operator==(const ExactBins& a, const ExactBins& b);

  private:
    [[nodiscard]] Steps steps_with_carries(std::size_t bin) const;
    [[nodiscard]] double value_with_carries(std::size_t bin) const;
    void add_with_carry(std::size_t bin, std::int64_t steps);
    void carry(std::size_t bin, std::int64_t carries);

    std::vector<std::int64_t> low_;
    std::vector<std::int64_t> carries_;  // empty: 0
};

}  // namespace quasimc

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace quasimc {

/// Exact sums of any size: one 64-bit number for each bin, and a second one for carries, which is
/// allocated for all bins when one needs it.
///
/// Between calls every bin's lower number is within (-kCarry, kCarry), except those that are added
/// to through shared().
class ExactBins {
  public:
    /// Quanta of a carry.
    static constexpr std::int64_t kCarry = std::int64_t{1} << 62U;

    /// Quanta of a unit.
    static constexpr double kQuantaPerUnit = 268435456.0;

    ExactBins() = default;
    explicit ExactBins(std::size_t bins) : low_(bins) {}

    [[nodiscard]] std::size_t size() const { return low_.size(); }
    /// The sum in units.
    [[nodiscard]] double value(std::size_t bin) const {
        return carries_.empty() ? static_cast<double>(low_[bin]) / kQuantaPerUnit
                                : value_with_carries(bin);
    }
    /// The sum in quanta: carries * kCarry + low, both of one sign. The pair of a sum does not
    /// depend on the order of additions.
    struct Quanta {
        std::int64_t carries = 0, low = 0;
        friend bool operator==(const Quanta&, const Quanta&) = default;
    };
    [[nodiscard]] Quanta quanta(std::size_t bin) const {
        return carries_.empty() ? Quanta{0, low_[bin]} : quanta_with_carries(bin);
    }

    /// Adds any number of quanta to a bin.
    void add(std::size_t bin, std::int64_t quanta) {
        std::int64_t sum = 0;
        const bool is_out = __builtin_add_overflow(low_[bin], quanta, &sum);
        if (is_out || sum >= kCarry || sum <= -kCarry) [[unlikely]] {
            add_with_carry(bin, quanta);
        } else {
            low_[bin] = sum;
        }
    }
    void add(std::size_t bin, Quanta quanta);
    /// Adds the sums of another, of the same size.
    ExactBins& operator+=(const ExactBins& other);

    /// The lower numbers, to which workers may add atomically. settle() carries those that are too
    /// large; each may grow by kCarry in between.
    [[nodiscard]] std::span<std::int64_t> shared() { return low_; }
    void settle();

    /// Sets the bins in [first, last) to 0.
    void clear(std::size_t first, std::size_t last);

    friend bool operator==(const ExactBins& a, const ExactBins& b);

  private:
    [[nodiscard]] Quanta quanta_with_carries(std::size_t bin) const;
    [[nodiscard]] double value_with_carries(std::size_t bin) const;
    void add_with_carry(std::size_t bin, std::int64_t quanta);
    void carry(std::size_t bin, std::int64_t carries);

    std::vector<std::int64_t> low_;
    std::vector<std::int64_t> carries_;  // empty: 0
};

}  // namespace quasimc

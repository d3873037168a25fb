#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sums/exact_bins.h"
#include "sums/fixed_point.h"
#include "sums/light_blocks.h"

namespace quasimc {

/// The bins one worker adds to: its own, or, for the first regions, an array that all workers share
/// (relaxed atomic additions; the sums are the same).
///
/// Amounts are not negative (except add_signed), so a bin that wraps around turns negative: the
/// signs of all written numbers are collected, at hardly any cost.
class Tally {
  public:
    /// Bins of regions [0, shared_regions) go to `shared`, which has layout.bins() bins; the others
    /// (all of them by default) are this worker's own, zero at first, until `move_into`.
    explicit Tally(
        const SumLayout& layout,
        std::size_t shared_regions = 0,
        std::span<std::int64_t> shared = {});

    /// The blocks that every method adds to. A solver finds its own in the layout.
    [[nodiscard]] const LightBlocks& blocks() const { return blocks_; }

    void add(std::size_t bin, std::int64_t amount) {
        if (bin >= shared_bins_) {
            written_ |= add_to(own_[bin - shared_bins_], amount);
        } else {
            add_shared(bin, amount);
        }
    }

    /// Adds to two bins of a region, given by their indices in its row.
    void add_two(
        std::size_t region,
        std::size_t index_a,
        std::int64_t a,
        std::size_t index_b,
        std::int64_t b) {
        const std::size_t row = region * blocks_.stride();
        if (row >= shared_bins_) {
            std::int64_t* bins = &own_[row - shared_bins_];
            written_ |= add_to(bins[index_a], a);
            written_ |= add_to(bins[index_b], b);
        } else {
            add_shared(row + index_a, a);
            add_shared(row + index_b, b);
        }
    }

    /// Adds amounts[i] to bin first + i.
    void add(std::size_t first, std::span<const std::int64_t> amounts) {
        if (first >= shared_bins_) {
            std::int64_t* bins = &own_[first - shared_bins_];
            std::int64_t written = 0;
            for (std::size_t i = 0; i < amounts.size(); ++i) {
                written |= add_to(bins[i], amounts[i]);
            }
            written_ |= written;
        } else {
            for (std::size_t i = 0; i < amounts.size(); ++i) {
                add_shared(first + i, amounts[i]);
            }
        }
    }

    /// Adds an area of a region that suns light on a side.
    void add_sunlit(std::size_t region, SurfaceSide side, std::int64_t area) {
        add(blocks_.sunlit(region), area);
        add_sunlit_upper(region, side, area);
    }
    /// Adds it to the areas whose upper side is lit, if it is one and these are summed.
    void add_sunlit_upper(std::size_t region, SurfaceSide side, std::int64_t area) {
        if (blocks_.has_sun_shade() && side == SurfaceSide::upper) {
            add(blocks_.sunlit_upper(region), area);
        }
    }

    /// Counts work that was done.
    void count(WorkUnit unit, std::uint64_t amount) {
        add(blocks_.work(unit), static_cast<std::int64_t>(amount));
    }

    /// Adds an amount of either sign.
    void add_signed(std::size_t bin, std::int64_t amount);

    /// Whether some bin is so full that it should be emptied.
    [[nodiscard]] bool is_full() const { return (written_ & ExactBins::kCarry) != 0; }

    /// Adds this worker's own bins to `total` (layout.bins() bins) and sets them to zero.
    /// @throws InputError  if some bin has wrapped around since the last call: each amount was
    /// small enough, but not their sum
    void move_into(ExactBins& total);
    /// Sets another array of shared bins.
    void share(std::span<std::int64_t> shared) { shared_ = shared; }

  private:
    /// Adds and returns the sum, which may wrap around (as signed numbers must not).
    static std::int64_t add_to(std::int64_t& sum, std::int64_t amount) {
        return sum = static_cast<std::int64_t>(
                   static_cast<std::uint64_t>(sum) + static_cast<std::uint64_t>(amount));
    }
    void add_shared(std::size_t bin, std::int64_t amount) {
        std::int64_t sum =
            std::atomic_ref(shared_[bin]).fetch_add(amount, std::memory_order_relaxed);
        written_ |= add_to(sum, amount);
    }

    LightBlocks blocks_;
    std::size_t bins_;
    std::size_t shared_bins_ = 0;
    std::span<std::int64_t> shared_;
    std::vector<std::int64_t> own_;
    std::int64_t written_ = 0;  // all written numbers, by "or"
};

}  // namespace quasimc

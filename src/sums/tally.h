#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace quasimc {

/// Amounts of light in 64-bit fixed point: sums are exact, so their order can't matter.
/// 2^28 steps a unit; a cell holds up to 2^35 units.
inline constexpr double kFixedOne = 268435456.0;

/// `amount` >= 0 in fixed point, rounded to nearest.
inline std::int64_t to_fixed(double amount) {
    // Not lround: truncation is one instruction, and right for what is never negative.
    return static_cast<std::int64_t>(
        amount * kFixedOne + 0.5);  // NOLINT(bugprone-incorrect-roundings)
}

inline double from_fixed(std::int64_t amount) {
    return static_cast<double>(amount) / kFixedOne;
}

/// What is counted, and where it stands in a row of cells.
///
/// Light that arrives straight from a source is counted per spectrum, not per band: all bands of it
/// follow by multiplication. So a band costs memory and time only where light has been scattered.
///
/// For each element (a part of an organ that is of one material), in this order:
///   direct[side][spectrum], scattered[side][band], sunlit;
/// then for the run: emitted[spectrum], escaped_direct[spectrum], escaped_scattered[band],
/// scattered_out[band], cut_off[band], rays.
struct TallyLayout {
    std::size_t regions = 0;
    std::size_t spectra = 1;
    std::size_t bands = 1;

    [[nodiscard]] std::size_t stride() const { return 2 * spectra + 2 * bands + 1; }
    [[nodiscard]] std::size_t direct(std::size_t region, bool lower, std::size_t spectrum) const {
        return region * stride() + (lower ? spectra : 0) + spectrum;
    }
    [[nodiscard]] std::size_t scattered(std::size_t region, bool lower) const {
        return region * stride() + 2 * spectra + (lower ? bands : 0);
    }
    [[nodiscard]] std::size_t sunlit(std::size_t region) const {
        return region * stride() + 2 * spectra + 2 * bands;
    }
    [[nodiscard]] std::size_t emitted() const { return regions * stride(); }
    [[nodiscard]] std::size_t escaped_direct() const { return emitted() + spectra; }
    [[nodiscard]] std::size_t escaped_scattered() const { return escaped_direct() + spectra; }
    [[nodiscard]] std::size_t scattered_out() const { return escaped_scattered() + bands; }
    [[nodiscard]] std::size_t cut_off() const { return scattered_out() + bands; }
    [[nodiscard]] std::size_t rays() const { return cut_off() + bands; }
    [[nodiscard]] std::size_t cells() const { return rays() + 1; }
};

/// The cells one worker adds to: its own, or, for the first elements, an array that all workers
/// share (relaxed atomic additions; the sums are the same).
class Tally {
  public:
    /// Cells of elements [0, shared_elements) go to `shared`, which has layout.cells() cells; the
    /// others (all of them by default) are this worker's own, zero at first, until `merge_into`.
    explicit Tally(
        const TallyLayout& layout,
        std::size_t shared_elements = 0,
        std::span<std::int64_t> shared = {});

    [[nodiscard]] const TallyLayout& layout() const { return layout_; }

    void add(std::size_t cell, std::int64_t amount) {
        if (cell >= shared_cells_) {
            own_[cell - shared_cells_] += amount;
        } else {
            std::atomic_ref(shared_[cell]).fetch_add(amount, std::memory_order_relaxed);
        }
    }

    /// Adds to two cells of an element, given by their places in its row.
    void add_two(
        std::size_t region,
        std::size_t place_a,
        std::int64_t a,
        std::size_t place_b,
        std::int64_t b) {
        const std::size_t row = region * layout_.stride();
        if (row >= shared_cells_) {
            std::int64_t* cells = &own_[row - shared_cells_];
            cells[place_a] += a;
            cells[place_b] += b;
        } else {
            add(row + place_a, a);
            add(row + place_b, b);
        }
    }

    /// Adds amounts[i] to cell first + i.
    void add(std::size_t first, std::span<const std::int64_t> amounts) {
        if (first >= shared_cells_) {
            std::int64_t* cells = &own_[first - shared_cells_];
            for (std::size_t i = 0; i < amounts.size(); ++i) {
                cells[i] += amounts[i];
            }
        } else {
            for (std::size_t i = 0; i < amounts.size(); ++i) {
                add(first + i, amounts[i]);
            }
        }
    }

    /// Lets the shared cells be those of another array.
    void share(std::span<std::int64_t> shared) { shared_ = shared; }
    /// Adds this worker's own cells to `total` (layout.cells() cells) and sets them to zero.
    void merge_into(std::span<std::int64_t> total);

  private:
    TallyLayout layout_;
    std::size_t shared_cells_ = 0;
    std::span<std::int64_t> shared_;
    std::vector<std::int64_t> own_;
};

}  // namespace quasimc

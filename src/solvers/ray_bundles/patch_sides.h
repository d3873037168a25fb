#pragma once

#include <cstddef>

#include "base/parallel.h"

namespace quasimc {

/// Memory layout of the sides of patches. One side follows another: its exitance, [column], then
/// its incident flux, [column]. If `kColumns` is 0, the number of columns is set at run time.
template <std::size_t kColumns>
class PatchSides {
  public:
    PatchSides(std::size_t columns, double* numbers) : columns_(columns), numbers_(numbers) {}
    template <std::size_t kOther>
    explicit PatchSides(const PatchSides<kOther>& other)
        : PatchSides(other.columns(), other.exitance(0)) {}

    [[nodiscard]] std::size_t columns() const { return kColumns > 0 ? kColumns : columns_; }
    /// @param side  [2 * patch + side]
    [[nodiscard]] double* exitance(std::size_t side) const {
        return numbers_ + 2 * side * columns();
    }
    [[nodiscard]] double* incident(std::size_t side) const { return exitance(side) + columns(); }

    /// Prefetches the numbers of a patch.
    void fetch(std::size_t patch) const {
        const double* const first = exitance(2 * patch);
        for (std::size_t i = 0; i < 4 * columns(); i += kStep) {
            __builtin_prefetch(first + i, 1);
        }
    }
    /// Prefetches the incident flux on a side, in `count` columns from `first` on.
    void fetch_incident(std::size_t side, std::size_t first, std::size_t count) const {
        const double* const from = incident(side) + first;
        for (std::size_t i = 0; i < count; i += kStep) {
            __builtin_prefetch(from + i, 1);
        }
    }

  private:
    static constexpr std::size_t kStep = kCacheLine / sizeof(double);

    std::size_t columns_;
    double* numbers_;
};

}  // namespace quasimc

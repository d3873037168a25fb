#pragma once

#include <cstddef>

#include "base/parallel.h"

namespace quasimc {

/// Where the numbers of the sides of patches stand, one side after the other: flux that leaves it
/// per area, [column], and after it flux that came to it, [column].
/// `kColumns` 0: as many as are said.
template <std::size_t kColumns>
class PatchSides {
  public:
    PatchSides(std::size_t columns, double* numbers) : said_(columns), numbers_(numbers) {}
    template <std::size_t kOther>
    explicit PatchSides(const PatchSides<kOther>& other)
        : PatchSides(other.columns(), other.exitance(0)) {}

    [[nodiscard]] std::size_t columns() const { return kColumns > 0 ? kColumns : said_; }
    /// @param side  [2 * patch + side]
    [[nodiscard]] double* exitance(std::size_t side) const {
        return numbers_ + 2 * side * columns();
    }
    [[nodiscard]] double* incident(std::size_t side) const { return exitance(side) + columns(); }

    /// Asks for the numbers of a patch, which may be any: they take a while to come from memory.
    void fetch(std::size_t patch) const {
        const double* const first = exitance(2 * patch);
        for (std::size_t i = 0; i < 4 * columns(); i += kStep) {
            __builtin_prefetch(first + i, 1);
        }
    }
    /// Asks for what came to a side, of some columns from the first on.
    void fetch_incident(std::size_t side, std::size_t first, std::size_t count) const {
        const double* const from = incident(side) + first;
        for (std::size_t i = 0; i < count; i += kStep) {
            __builtin_prefetch(from + i, 1);
        }
    }

  private:
    static constexpr std::size_t kStep = kCacheLine / sizeof(double);

    std::size_t said_;
    double* numbers_;
};

}  // namespace quasimc

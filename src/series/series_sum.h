#pragma once

#include <vector>

#include "quasimc/result.h"
#include "quasimc/series.h"

namespace quasimc {

/// Sums results with independent errors.
class SeriesAdder {
  public:
    /// Adds `weight` times a result. Results of one trace are added once, with the sum of their
    /// weights: their errors are equal.
    void add(const Result& result, double weight);
    void add_seconds(double seconds) { seconds_ += seconds; }
    /// The sum. Its interval is Student's t with the degrees of freedom of Welch (1947) and
    /// Satterthwaite (1946); upper bounds of values without contributions are added to its upper
    /// end.
    /// @param values  number of values, in case nothing was added
    /// @param groups  gets the values
    [[nodiscard]] SeriesSum sum(
        std::size_t bands, std::size_t values, const GroupResults& groups = {}) const;

  private:
    /// Sum of one value.
    struct Cell {
        double mean = 0, variance = 0;
        double spread = 0;        ///< sum of variance^2 / degrees of freedom
        double unseen = 0;        ///< sum of upper bounds of values without contributions
        bool is_unknown = false;  ///< some part has an unknown error
    };
    using Cells = std::vector<Cell>;

    static void add_all(
        const std::vector<Estimate>& values, double weight, double freedom, Cells& cells);
    [[nodiscard]] static Estimate estimate_of(const Cell& cell);

    Cells cells_, group_cells_;  // of organs, of groups
    double seconds_ = 0;
};

}  // namespace quasimc

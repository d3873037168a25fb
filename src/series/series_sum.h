#pragma once

#include <array>
#include <string>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/series.h"

namespace quasimc {

/// Sums results with independent errors.
class SeriesAdder {
  public:
    /// @param origins  of the results
    explicit SeriesAdder(const std::vector<std::string>& origins = {}) {
        for (const std::string& origin : origins) {
            origins_.push_back({origin});
        }
    }

    /// Adds `weight` times a result. Results of one trace are added once, with the sum of their
    /// weights: their errors are equal.
    void add(const Result& result, double weight);
    void add_seconds(double seconds) { seconds_ += seconds; }
    /// The sum. Its interval is Student's t with the degrees of freedom of Welch (1947) and
    /// Satterthwaite (1946); upper bounds of values without contributions are added to its upper
    /// end.
    /// @param values  number of values, in case nothing was added
    /// @param groups  gets the values
    /// @param of_sensors  number of values of sensors
    [[nodiscard]] SeriesSum sum(
        std::size_t bands,
        std::size_t values,
        const GroupResults& groups = {},
        std::size_t of_sensors = 0) const;

  private:
    /// Sum of one value.
    struct Cell {
        double mean = 0, variance = 0;
        double spread = 0;        ///< sum of variance^2 / degrees of freedom
        double unseen = 0;        ///< sum of upper bounds of values without contributions
        bool is_unknown = false;  ///< some part has an unknown error
    };
    using Cells = std::vector<Cell>;

    /// Sum of one share of a group: the quotient of sums of amounts, part and whole.
    struct Quotient {
        double part = 0, whole = 0;
        /// Sums of (whole x error of the share)^2, and of its square / degrees of freedom.
        double variance = 0, spread = 0;
        double unseen = 0;  ///< as in Cell, times the whole
        /// Sums of (error of the whole)^2 x share^k: for shares that differ between times.
        std::array<double, 3> of_whole{};
        bool is_unknown = false;
    };

    static void add_all(
        const std::vector<Estimate>& values, double weight, double freedom, Cells& cells);
    void add_shares(const Result& result, double weight, double freedom);
    [[nodiscard]] static Estimate estimate_of(const Cell& cell);
    /// The error follows from the delta method: var(sum of part - R whole) / whole^2, with the
    /// share of a time independent of its whole.
    [[nodiscard]] static Estimate estimate_of_quotient(const Quotient& quotient);

    /// The sums of all light, or of an origin.
    struct Part {
        std::string name;
        Cells organs = {}, groups = {}, sensors = {};
    };
    /// @param sensors  or null
    static void add_part(const Result& result, const Result* sensors, double weight, Part& part);
    [[nodiscard]] static std::vector<Estimate> estimates_of(const Cells& cells, std::size_t count);

    Part all_;
    std::vector<Part> origins_;
    std::vector<Quotient> shares_;  // as GroupResults::shares
    double seconds_ = 0;
};

}  // namespace quasimc

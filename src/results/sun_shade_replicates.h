#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/sums.h"
#include "results/combine.h"
#include "results/replicate_sum.h"
#include "scene/scene.h"

namespace quasimc {

/// Rows whose light of sunlit and shaded parts is summed: organs, or groups of organs.
struct SunShadeRows {
    std::span<const OrganWeights> organs;  ///< organs of each row; without weights
    std::span<const double> areas;         ///< one for each row
    bool are_groups = false;
};

/// Sums of a computation, and how they are evaluated.
struct ComputedSums {
    const Sums& sums;
    const Scene& scene;
    const EvaluationSpec& spec;
};

/// Weighted sums of the light of sunlit and shaded parts over the points of a sweep, replicate by
/// replicate. Light per sunlit or shaded area is the quotient of the sums of light and of area x
/// time.
class SunShadeReplicateSum {
  public:
    SunShadeReplicateSum() = default;
    SunShadeReplicateSum(std::size_t replicates, std::size_t rows, std::size_t bands);

    /// The weight of a computation.
    struct Weight {
        double light = 1;
        double time = 1;  ///< weight of its sunlit areas
    };
    /// Adds a computation of a point.
    void add(const ComputedSums& from, const SunShadeRows& rows, const Weight& weight);
    void end_point();

    /// The units of the estimates.
    struct Units {
        double light = 1;  ///< factor on direct light
        double time = 1;   ///< factor on fractions
        double whole = 0;  ///< weight of all time, in which there may be no light
    };
    /// @param areas  of the rows
    [[nodiscard]] SunShadeLight estimates(std::span<const double> areas, const Units& units) const;

  private:
    /// The amounts of a computation.
    struct Amounts {
        CombinedReplicates light, lit;
    };
    void put_row(
        const ComputedSums& from,
        const SunShadeRows& rows,
        std::size_t row,
        Amounts& amounts) const;
    [[nodiscard]] Estimate quotient(
        std::size_t light, std::vector<double> lit, SunShadePart part, double whole) const;

    std::size_t rows_ = 0, bands_ = 0;
    ReplicateSum light_;  // [((row * surfaces + surface) * bands + band) * amounts + amount], flux
    ReplicateSum lit_;    // [row * surfaces + surface], sunlit area
};

}  // namespace quasimc

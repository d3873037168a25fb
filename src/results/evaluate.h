#pragma once

#include "results/result.h"
#include "solvers/estimator.h"
#include "sums/replicates.h"

namespace quasimc {

/// What the sums of all replicates say after `paths` points each.
struct Evaluation {
    const PreparedScene& prepared;
    const Estimator& estimator;
    const Replicates& replicates;
    std::uint64_t paths = 0;
    unsigned threads = 1;
    DirectLight direct_light = DirectLight::counted;
};

/// Fills values, sunlit_fraction and ratio_values of the result.
/// @param ratios  pairs of bands
void evaluate_organs(
    const Evaluation& evaluation,
    const std::vector<std::pair<std::size_t, std::size_t>>& ratios,
    Result& result);

/// The energy budget of each band.
[[nodiscard]] std::vector<BandBudget> evaluate_budget(const Evaluation& evaluation);

/// Fraction of the organs whose absorbed flux has at most `target` relative standard error in every
/// band.
[[nodiscard]] double fraction_at_target(const Evaluation& evaluation, double target);

/// Rays cast in all replicates.
[[nodiscard]] std::uint64_t count_rays(const Replicates& replicates);

}  // namespace quasimc

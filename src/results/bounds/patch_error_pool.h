#pragma once

#include "quasimc/result.h"
#include "scene/scene.h"

namespace quasimc {

/// Pools the differences of organs between two levels of patches. The difference of one organ or
/// group is a single draw: it may be small by chance, as where the light of both levels crosses,
/// while its error is not. So half of its square is its own, and half is the mean square of organs
/// with equal scattered light, split into a part common to all and a part of each organ.
class PatchErrorPool {
  public:
    /// @param scattered  scattered light of the organ, per area
    /// @param difference  between its two levels, per area
    void add(double scattered, double difference);
    PatchErrorPool& operator+=(const PatchErrorPool& other);

    /// The pooled difference of one or several organs, without a sign.
    /// @param scattered  sum over the organs
    /// @param squares  sum of the squares over the organs
    [[nodiscard]] double shrunk(double own, double scattered, double squares) const;
    /// The pooled difference of one organ.
    [[nodiscard]] double shrunk(double own, double scattered) const {
        return shrunk(own, scattered, scattered * scattered);
    }

  private:
    double squares_ = 0, products_ = 0, differences_ = 0;  // of scattered light and differences
};

/// Whether an organ takes part in the pooling.
[[nodiscard]] inline bool is_pooled(const Organ& organ) {
    return organ.measured && !organ.is_ground && organ.area > 0;
}

/// Sets the differences of organs, groups and their ratios from `fine` to their pooled error of
/// patches (PatchErrorPool).
/// @param coarse  result on the coarser level
void pool_patch_errors(
    const Scene& scene, const EvaluationSpec& spec, const Result& fine, Result& coarse);

}  // namespace quasimc

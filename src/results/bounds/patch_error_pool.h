#pragma once

#include "quasimc/result.h"
#include "scene/scene.h"

namespace quasimc {

/// What the differences of organs between two levels of patches have in common. That of an organ,
/// or of a group, is one draw: it may be small by chance, as where the light of both levels
/// crosses, while what is wrong is not. So half of its square is its own, and half is what organs
/// with as much scattered light differ by in the mean: for that much light each by a part that is
/// the same for all, and by a part of its own.
class PatchErrorPool {
  public:
    /// @param scattered  what the light of an organ has of scattered light, per area
    /// @param difference  of its two levels, per area
    void add(double scattered, double difference);
    PatchErrorPool& operator+=(const PatchErrorPool& other);

    /// What counts as the difference of one organ or of several together, without a sign.
    /// @param scattered  sum over the organs
    /// @param squares  sum of its squares
    [[nodiscard]] double shrunk(double own, double scattered, double squares) const;
    /// The same of one organ.
    [[nodiscard]] double shrunk(double own, double scattered) const {
        return shrunk(own, scattered, scattered * scattered);
    }

  private:
    double squares_ = 0, products_ = 0, differences_ = 0;  // of scattered light and differences
};

/// Whether an organ is one of those that tell each other's errors of patches.
[[nodiscard]] inline bool is_pooled(const Organ& organ) {
    return organ.measured && !organ.is_ground && organ.area > 0;
}

/// Lets organs, groups and their ratios differ from `fine` by as much as counts as their error of
/// patches (PatchErrorPool).
/// @param coarse  the same on the coarser level
void pool_patch_errors(
    const Scene& scene, const EvaluationSpec& spec, const Result& fine, Result& coarse);

}  // namespace quasimc

#pragma once

#include <cmath>

#include "quasimc/result.h"
#include "quasimc/sums.h"
#include "scene/scene.h"

namespace quasimc {

/// Whether sums hold light computed with two levels of patches.
[[nodiscard]] inline bool has_two_levels(const Sums& sums) {
    return sums.layout.patch_levels == PatchLevels::two;
}

/// Of sums with two levels of patches those of the coarser one, as sums of their own: of one
/// replicate, which holds the light of all.
[[nodiscard]] Sums coarser_sums(const Sums& sums);

/// The estimate with the error that patches make, told by a difference of the means of two levels:
/// the standard error becomes hypot(standard error, difference), and the interval reaches so much
/// further to either side, but not below 0 where it did not.
[[nodiscard]] Estimate with_patch_error(const Estimate& e, double difference);

/// How much light organs have on two levels of patches, summed up.
struct PatchErrorPool {
    double differences = 0, means = 0;  ///< squares, per area of each organ

    void add(double mean, double difference, double area) {
        differences += difference * difference / (area * area);
        means += mean * mean / (area * area);
    }
    /// Difference of an organ, of which its own is one draw among those of all organs: it may be
    /// small by chance, as where levels cross. Half of its square is that which all have in the
    /// mean. With a sign that does not count.
    [[nodiscard]] double shrunk(double mean, double own) const {
        const double usual = means > 0 ? mean * mean * differences / means : own * own;
        return std::sqrt((own * own + usual) / 2);
    }
};

/// Whether an organ is one of those that tell each other's errors of patches.
[[nodiscard]] inline bool is_pooled(const Organ& organ) {
    return organ.measured && !organ.is_ground && organ.area > 0;
}

/// Adds the error of patches to all estimates.
/// @param coarse  the same, of coarser_sums()
void add_patch_errors(Result coarse, const Scene& scene, Result& result);

/// The estimate with one more error, of a known standard deviation, independent of its own.
[[nodiscard]] Estimate with_error(const Estimate& e, double error);

/// Adds an error to all estimates.
/// @param raised  the same, of light that is more by its error
void add_errors(const Result& raised, Result& result);

}  // namespace quasimc

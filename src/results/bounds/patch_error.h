#pragma once

#include "quasimc/result.h"
#include "quasimc/sums.h"
#include "scene/scene.h"
#include "sums/light_blocks.h"
#include "sums/sum_data.h"

namespace quasimc {

/// Whether sums hold light computed with two levels of patches.
[[nodiscard]] inline bool has_two_levels(const Sums& sums) {
    return ScatteredBlocks(sums->layout, kCoarse).on_surfaces.exists();
}

/// Of sums with two levels of patches those of the coarser one, as sums of their own: of one
/// replicate, which holds the light of all.
[[nodiscard]] Sums coarser_sums(const Sums& sums);

/// The estimate with the error that patches make, told by a difference of the means of two levels:
/// the standard error becomes hypot(standard error, difference), and the interval reaches so much
/// further to either side, but not below 0 where it did not.
[[nodiscard]] Estimate with_patch_error(const Estimate& e, double difference);

/// Adds the error of patches to all estimates.
/// @param coarse  the means of coarser_sums()
void add_patch_errors(
    Result coarse, const Scene& scene, const EvaluationSpec& spec, Result& result);

/// The estimate with one more error, of a known standard deviation, independent of its own.
[[nodiscard]] Estimate with_error(const Estimate& e, double error);

/// Adds an error to all estimates.
/// @param raised  the means of light that is more by its error
void add_errors(const Result& raised, Result& result);

}  // namespace quasimc

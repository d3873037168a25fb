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

/// The sums of the coarser of two levels of patches: one replicate that holds the light of all.
[[nodiscard]] Sums coarser_sums(const Sums& sums);

/// Adds the discretization error of patches, estimated by the difference between two levels, to an
/// estimate: the standard error becomes hypot(standard error, difference), and the interval grows
/// by as much on either side, but not below 0 unless it began there.
[[nodiscard]] Estimate with_patch_error(const Estimate& e, double difference);

/// Adds the error of patches to all estimates.
/// @param coarse  the means of coarser_sums()
void add_patch_errors(
    Result coarse, const Scene& scene, const EvaluationSpec& spec, Result& result);

/// Adds one more independent error of known standard deviation to an estimate.
[[nodiscard]] Estimate with_error(const Estimate& e, double error);

/// Adds an error to all estimates of a result.
/// @param raised  the means of the light plus its error
void add_errors(const Result& raised, Result& result);

}  // namespace quasimc

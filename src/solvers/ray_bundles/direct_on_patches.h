#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "solvers/direct/direct_beams.h"
#include "solvers/ray_bundles/patch_light.h"
#include "solvers/ray_bundles/sky_view.h"

namespace quasimc {

/// What the light of one replicate of a round is solved of.
struct ReplicateInput {
    const Round& round;
    const std::vector<VisibilityTask>& tasks;  ///< of the round
    const CountedStrategies& counted;
    const ScatteredBlocks& coarse;  ///< of the coarser level of patches
    std::uint32_t index = 0;
};

/// Memory that score_and_deposit_direct() uses.
struct DirectScratch {
    DirectBeams::Scratch beams;
    std::vector<TriangleParts::Segment> segments;
};

/// Direct light on patches, and how open sides are as the item buffers of skies see them.
struct DirectOnPatches {
    PatchIrradiance irradiance;
    OpenAreas open;
};

/// Scores the direct light of all sources, and deposits it on patches: that of suns along scan
/// lines, that of skies by pixels. Lamps, and lights of which that would cost too much, are sampled
/// by paths to their first hits.
/// @param memory  of the irradiance
[[nodiscard]] DirectOnPatches score_and_deposit_direct(
    const SolverInput& input,
    const DirectBeams& beams,
    const ReplicateInput& replicate,
    std::unique_ptr<PatchLight> memory,
    DirectScratch& scratch,
    Tally& tally);

}  // namespace quasimc

#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "solvers/direct/direct_beams.h"
#include "solvers/ray_bundles/patch_light.h"
#include "solvers/ray_bundles/sky_view.h"

namespace quasimc {

/// Inputs of the solution of one replicate of a round.
struct ReplicateInput {
    const Round& round;
    const std::vector<VisibilityTask>& tasks;  ///< its tasks
    const CountedStrategies& counted;
    std::uint32_t index = 0;
};

/// Scratch memory of score_and_deposit_direct().
struct DirectScratch {
    DirectBeams::Scratch beams;
    std::vector<TriangleParts::Segment> segments;
};

/// Direct light on patches, and the areas of sides that see the sky, from the item buffers of
/// skies.
struct DirectOnPatches {
    PatchIrradiance irradiance;
    OpenAreas open;
};

/// Scores the direct light of all sources, and deposits it on patches: that of suns along scan
/// lines, that of skies by pixels. Lamps, and lights for which this would be inefficient, are
/// sampled by paths to their first hits.
/// @param memory  of the irradiance
[[nodiscard]] DirectOnPatches score_and_deposit_direct(
    const SolverInput& input,
    const DirectBeams& beams,
    const ReplicateInput& replicate,
    std::unique_ptr<PatchLight> memory,
    DirectScratch& scratch,
    Tally& tally);

}  // namespace quasimc

#pragma once

#include <vector>

#include "solvers/direct/direct_beams.h"
#include "solvers/ray_bundles/open_sides.h"
#include "solvers/ray_bundles/patch_light.h"

namespace quasimc {

/// Of rows of pixels one of each few, that many times as bright, the first of them drawn at random.
struct LaidRows {
    std::uint32_t first = 0, of = 1;
};

/// Direct light of all sources, scored, and laid on patches: that of suns along scan lines, that of
/// skies by pixels, that of lamps and of what is too costly to look at traced to its first hits.
class DirectOnPatches {
  public:
    DirectOnPatches(const SolverInput& input, const DirectBeams& beams, const PatchScene& patches);

    struct Scratch {
        DirectBeams::Scratch beams;
        std::vector<Patches::Stretch> stretches;
    };
    /// What light is to be found.
    struct Task {
        const Round& round;
        const std::vector<VisibilityTask>& tasks;  ///< of the round
        const SumUnits& units;
        std::uint32_t replicate = 0;
    };
    /// Adds all direct light of a replicate. What looks for it along skies sees how open sides are.
    void find(
        const Task& task, Scratch& scratch, PatchLight& light, OpenSides& open, Tally& tally) const;

  private:
    using Work = DirectBeams::Work;
    using Beam = DirectBeams::Beam;

    void find_by_lines(const Work& work, Scratch& scratch, PatchLight& light, Tally& tally) const;
    void lay_line(
        const DirectBeams::LitStrip& lit,
        const LineStrip::Line& line,
        double per_length,
        std::span<const LitBands> bands,
        Scratch& scratch) const;
    void find_by_pixels(
        const Work& work, Scratch& scratch, PatchLight& light, OpenSides& open, Tally& tally) const;
    void score_pixels(const Beam& beam, const DirectBeams::SkyView& view, Tally& tally) const;
    void lay_pixels(
        const Vec3& direction,
        const ItemBuffer& pixels,
        const LaidRows& laid,
        std::span<const LitBands> lit) const;
    void trace(const Round& round, std::uint32_t replicate, PatchLight& light, Tally& tally) const;
    std::uint64_t trace_path(
        const BoundSource& source,
        const Emission& start,
        std::span<const LitBands> lit,
        Tally& tally) const;

    const PreparedScene& prepared_;
    const Sampler& sampler_;
    const RunSpec& spec_;
    std::stop_token stop_;
    const PatchScene& patches_;
    const DirectBeams& beams_;
};

}  // namespace quasimc

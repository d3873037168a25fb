#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

#include "raster/item_buffer.h"
#include "raster/scan_lines.h"
#include "solvers/direct/path_vertices.h"
#include "solvers/direct/sampling_budget.h"
#include "solvers/direct/seen_scene.h"
#include "solvers/light_tracing/light_tracer.h"
#include "solvers/sampling_strategies.h"
#include "solvers/solver.h"
#include "solvers/sum_meaning.h"

namespace quasimc {

/// Direct light of suns and skies, which geometry finds: where beams are placed, what they see, and
/// its score. What becomes of what is lit is the solver's own.
class DirectBeams {
  public:
    explicit DirectBeams(const SolverInput& input, ScatteredBy scattered = ScatteredBy::paths);

    /// A block of a task.
    struct Work {
        const Round& round;
        std::uint32_t replicate;
        std::uint32_t number;  ///< of the task
        const VisibilityTask& task;
        const CountedStrategies& counted;
        std::size_t strategy;  ///< of the light, in `counted`
        std::uint64_t block;   ///< of the task
    };
    /// A beam and the area across it, through which its light enters; local units squared.
    struct Beam : SurfaceBeam {
        double area = 1;
    };
    /// What a worker keeps between blocks.
    struct Scratch {
        ScanLines lines;
        std::optional<std::array<std::uint64_t, 3>> lines_of;  // their task, replicate and round
        ItemBuffer pixels;
    };

    [[nodiscard]] const ProjectedScene& scene() const { return seen_.projected(); }
    [[nodiscard]] const SkyDirections& skies() const { return skies_; }
    [[nodiscard]] bool looks_at_skies() const { return budget_.sees_skies(); }
    /// Lamps, suns that are not cut into lines, and skies that are not seen by pixels.
    [[nodiscard]] const TracedLights& traced() const { return traced_; }
    /// The tasks of a round; tells the sums what each of their contributions is at most.
    [[nodiscard]] std::vector<VisibilityTask> tasks(const Round& round, Sums& sums) const;
    /// Block `block` of all blocks of the tasks.
    [[nodiscard]] static Work work_of(
        const std::vector<VisibilityTask>& tasks,
        const Round& round,
        const CountedStrategies& counted,
        std::uint32_t replicate,
        std::uint64_t block);

    /// The point set number `i` of a task's blocks; number 0 places its beams. Light tracing
    /// has sequence 0.
    [[nodiscard]] Stream stream_of(const Work& work, std::uint64_t i) const;
    /// What places the directions of a task: three dimensions of its first point.
    [[nodiscard]] std::array<double, 3> placing_of(
        const Stream& first, std::uint32_t dimension) const;
    /// A light's share of one of `count` directions, drawn with `density`.
    [[nodiscard]] Beam beam_of(
        const BoundSource& light,
        const Vec3& direction,
        double density,
        const Work& work,
        std::uint32_t count) const;
    /// The beam of a task that is cut into lines.
    [[nodiscard]] Beam beam_of(const Work& work) const;
    /// A block's part of the light of a beam; all parts add up to it.
    [[nodiscard]] static double share_of_block(double paths, const Work& work);

    /// Sets the lines of a task, where they are not yet.
    void set_lines(
        const Work& work, const Beam& beam, const Stream& placing, Scratch& scratch) const;
    /// Scores what a strip of lines found.
    void score_lines(
        const Work& work,
        const SurfaceBeam& share,
        double per_length,
        const ScanLines& lines,
        Tally& tally) const;
    /// How direction `i` of the skies is looked along.
    [[nodiscard]] ItemBuffer::Spec look_of(
        const Work& work, const Stream& placing, std::uint32_t i, const Vec3& direction) const;
    /// Counts what is lit along a direction that brings so many paths' light of all skies.
    void count_finds(
        const Work& work,
        const Vec3& direction,
        double paths,
        const ItemBuffer& pixels,
        Tally& tally) const;

  private:
    const PreparedScene& prepared_;
    const Sampler& sampler_;
    const RunSpec& spec_;
    std::stop_token stop_;
    SkyDirections skies_;
    SeenScene seen_;
    SamplingBudget budget_;
    TracedLights traced_;
};

/// What the sums of direct light mean, found so; of scattered light as in light tracing.
[[nodiscard]] SumMeaning direct_beams_meaning(
    const PreparedScene& prepared, const RunSpec& spec, ScatteredBy scattered = ScatteredBy::paths);

}  // namespace quasimc

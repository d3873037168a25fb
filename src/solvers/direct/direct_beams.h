#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "raster/item_buffer.h"
#include "raster/scan_lines.h"
#include "solvers/direct/path_vertices.h"
#include "solvers/direct/projection_input.h"
#include "solvers/direct/sampling_budget.h"
#include "solvers/light_tracing/light_tracer.h"
#include "solvers/sampling_strategies.h"
#include "solvers/solver.h"
#include "solvers/sum_meaning.h"

namespace quasimc {

/// Direct light of suns and skies by geometry: beams, the surfaces that each lights, and the score.
/// Scattered light is left to the solver.
class DirectBeams {
  public:
    explicit DirectBeams(const SolverInput& input, ScatteredBy scattered = ScatteredBy::paths);

    /// A block of a task.
    struct Work {
        const Round& round;
        std::uint32_t replicate;
        std::uint32_t number;  ///< index of the task
        const VisibilityTask& task;
        const CountedStrategies& counted;
        std::size_t strategy;  ///< index in `counted`
        std::uint64_t block;   ///< index in the task
    };
    /// A beam and the area across it, through which its light enters; local units squared.
    struct Beam : SurfaceBeam {
        double area = 1;
    };
    /// Scratch memory of a worker.
    struct Scratch {
        std::optional<ScanLines> lines;           // cached between the strips of a beam
        std::array<std::uint64_t, 3> lines_of{};  // their task, replicate and round
        LineScratch strip;
        ItemScratch image;
    };
    /// A strip of scan lines across the beam of a sun, with its part of the light of the beam.
    struct LitStrip {
        SurfaceBeam share;
        double per_length = 0;  ///< light per unit length of a segment, as a number of paths
        LineStrip strip;
    };
    /// The view along one direction of the skies.
    struct SkyView {
        DirectionSample from;
        std::vector<Beam> beams;  ///< one for each sky, some without light
        double paths = 0;         ///< sum over the beams
        ItemBuffer image;

        /// Light of a beam on a pixel, as a number of paths.
        [[nodiscard]] double per_pixel(const Beam& beam) const {
            return beam.paths * image.pixel_area() / beam.area;
        }
    };

    [[nodiscard]] const ProjectedScene& scene() const { return projection_input_.projected(); }
    [[nodiscard]] const SkyDirections& skies() const { return skies_; }
    /// The skies whose direct light is sampled by item buffers; null if it is not.
    [[nodiscard]] const SkyDirections* viewed_skies() const {
        return budget_.sees_skies() ? &skies_ : nullptr;
    }
    /// Lights sampled by paths: lamps, suns without scan lines and skies without item buffers.
    [[nodiscard]] const TracedLights& traced() const { return traced_; }
    /// Whether tasks differ between replicates.
    [[nodiscard]] bool picks_suns() const { return budget_.picks_suns(); }
    /// The tasks of one replicate of a round.
    [[nodiscard]] std::vector<VisibilityTask> tasks(
        const Round& round, std::uint32_t replicate) const;
    /// Raises the bounds of contributions in the sums to those of a round.
    void raise_bounds(const Round& round, Sums& sums) const;
    /// Block `block` of all blocks of the tasks.
    [[nodiscard]] static Work work_of(
        const std::vector<VisibilityTask>& tasks,
        const Round& round,
        const CountedStrategies& counted,
        std::uint32_t replicate,
        std::uint64_t block);

    /// The point set number `i` of a task's blocks; number 0 shifts its beams. Light tracing
    /// has sequence 0.
    [[nodiscard]] Stream stream_of(const Work& work, std::uint64_t i) const;

    /// The strip of a block of a sun's task. It refers to the scratch.
    [[nodiscard]] LitStrip lit_strip(const Work& work, Scratch& scratch) const;
    /// Scores the direct light of a strip.
    void score_strip(
        const Work& work,
        const LitStrip& lit,
        std::span<const LineStrip::Visible> visible,
        Tally& tally) const;
    /// The view along direction `i` of the skies' task. It refers to the scratch.
    /// @param with_points  see ItemBuffer::View
    [[nodiscard]] SkyView sky_view(
        const Work& work, std::uint32_t i, bool with_points, Scratch& scratch) const;
    /// Counts the contributions of a direction of the skies.
    void count_contributions(const Work& work, const SkyView& view, Tally& tally) const;

  private:
    [[nodiscard]] Beam beam_of(const Work& work) const;
    [[nodiscard]] Beam beam_along(
        const DirectionSample& from,
        const BoundSource& light,
        double paths,
        std::uint32_t count) const;
    [[nodiscard]] const ScanLines& lines_of(
        const Work& work, const Beam& beam, Scratch& scratch) const;
    [[nodiscard]] std::array<double, 3> placing_of(
        const Stream& first, std::uint32_t dimension) const;

    const PreparedScene& prepared_;
    const Sampler& sampler_;
    const RunSpec& spec_;
    std::stop_token stop_;
    SkyDirections skies_;
    ProjectionInput projection_input_;
    SamplingBudget budget_;
    TracedLights traced_;
};

/// Meaning of the sums of direct light; scattered light as in light tracing.
[[nodiscard]] SumMeaning direct_beams_meaning(
    const PreparedScene& prepared, const RunSpec& spec, ScatteredBy scattered = ScatteredBy::paths);

}  // namespace quasimc

// Direct light by geometry, scattered light by paths from where it falls.
//
// The light of a sun is cut into scan lines, and each line into the segments of surfaces that it
// lights (raster/scan_lines.h): the direct light of every organ, with an error that falls with the
// third power of the number of lines. A sky is a sum of beams from well-spread directions, each
// with an item buffer (raster/item_buffer.h). Paths start on segments and pixels
// (solvers/direct/path_vertices.h) and are traced from there (solvers/first_hits/vertex_tracer.h).
// Light of lamps, and of suns so low above an infinite stand that lines would be inefficient, is
// traced from the sources.

#include "solvers/first_hits/first_hits.h"

#include <algorithm>
#include <span>
#include <stop_token>

#include "base/stop.h"
#include "solvers/block_runner.h"
#include "solvers/direct/direct_beams.h"
#include "solvers/first_hits/vertex_tracer.h"
#include "solvers/light_tracing/light_tracer.h"

namespace quasimc {
namespace {

class FirstHits final : public Solver {
  public:
    explicit FirstHits(const SolverInput& input)
        : prepared_(input.prepared),
          sampler_(input.sampler),
          spec_(input.spec),
          stop_(input.stop),
          roulette_threshold_(roulette_threshold(input)),
          shares_(input.prepared),
          direct_(input),
          runner_(input),
          tracer_(input, direct_.traced()),
          trace_runner_(input) {}

    void solve(const Round& round, Executor& executor, Sums& sums) override {
        direct_.raise_bounds(round, sums);
        const RoundTasks tasks(direct_, round, sums->replicates.size());
        const CountedStrategies counted(*sums);
        const TracedLights& traced = direct_.traced();
        const bool is_traced = std::find(traced.begin(), traced.end(), true) != traced.end();
        const std::uint64_t traced_blocks = is_traced ? LightTracer::blocks(round) : 0;
        TaskRound all = executor.begin((tasks.blocks() + traced_blocks) * sums->replicates.size());
        runner_.run(
            tasks.blocks(), all, sums,
            [&](std::uint32_t replicate, std::uint64_t block, Scratch& scratch, Tally& tally) {
                if (block >= blocks_of(tasks.of(replicate))) {
                    return;  // other replicates have more
                }
                const Work work =
                    DirectBeams::work_of(tasks.of(replicate), round, counted, replicate, block);
                work.task.is_sky ? trace_skies(work, scratch, tally)
                                 : trace_lines(work, scratch, tally);
            });
        trace_runner_.run(
            traced_blocks, all, sums,
            [&](std::uint32_t replicate, std::uint64_t block, LightTracer::Scratch& scratch,
                Tally& tally) { tracer_.trace(round, replicate, block, scratch, tally); });
        sums->paths += round.count;
        sums->samples += samples_of(round);
    }

  private:
    using Work = DirectBeams::Work;
    using Beam = DirectBeams::Beam;

    /// Memory of a worker, reused between blocks.
    struct Scratch {
        explicit Scratch(std::size_t bands) : tracing(bands) {}
        DirectBeams::Scratch direct;
        std::vector<ScatteringPiece> pieces;  // by item of the lines or pixels
        std::vector<SurfaceBeam> beams;
        std::vector<PathVertex> vertices;
        VertexScratch tracing;
    };

    /// The tasks of each replicate of a round.
    class RoundTasks {
      public:
        RoundTasks(const DirectBeams& direct, const Round& round, std::size_t replicates) {
            // Without suns to be picked one list is that of all.
            const std::size_t lists = direct.picks_suns() ? replicates : 1;
            for (std::uint32_t replicate = 0; replicate < lists; ++replicate) {
                lists_.push_back(direct.tasks(round, replicate));
                blocks_ = std::max(blocks_, blocks_of(lists_.back()));
            }
        }
        /// The largest number of blocks of a replicate.
        [[nodiscard]] std::uint64_t blocks() const { return blocks_; }
        [[nodiscard]] const std::vector<VisibilityTask>& of(std::uint32_t replicate) const {
            return lists_[lists_.size() > 1 ? replicate : 0];
        }

      private:
        std::vector<std::vector<VisibilityTask>> lists_;
        std::uint64_t blocks_ = 0;
    };

    [[nodiscard]] PathRules rules_of(const Work& work) const {
        return {
            .prepared = &prepared_,
            .sampler = &sampler_,
            .stream = direct_.stream_of(work, 1 + work.block),
            .scatter_dimension = 0,
            .max_depth = spec_.max_depth,
            .roulette_threshold = roulette_threshold_,
            .stop = &stop_};
    }

    void trace_lines(const Work& work, Scratch& scratch, Tally& tally) const {
        const DirectBeams::LitStrip lit = direct_.lit_strip(work, scratch.direct);
        const Stream placing = direct_.stream_of(work, 0);
        scratch.beams.assign(1, lit.share);
        scratch.vertices.clear();
        scratch.pieces.clear();
        for (const auto [triangle, cosine] : lit.strip.triangles()) {
            scratch.pieces.push_back(
                scattering_piece(prepared_, shares_, lit.share, triangle, cosine, lit.per_length));
        }
        SystematicPlacement placement(
            sampler_.coordinate(placing, placing.first + 1 + work.block, 2));
        const auto visible = lit.strip.for_visible_segments([&](const LineStrip::Line& line) {
            throw_if_stopped(stop_);
            for (const VisibleSegment& segment : line.segments) {
                placement.add_vertices(
                    scratch.pieces[segment.surface], segment.length(), 0,
                    [&](double f) { return lit.strip.point(line, segment, f); }, scratch.vertices);
            }
        });
        direct_.score_strip(work, lit, visible, tally);
        trace_from_vertices(
            rules_of(work), scratch.beams, scratch.vertices, scratch.tracing, tally);
    }

    /// Every n-th direction of the skies for n blocks: one view serves all skies.
    void trace_skies(const Work& work, Scratch& scratch, Tally& tally) const {
        const Stream placing = direct_.stream_of(work, 0);
        scratch.beams.clear();
        scratch.vertices.clear();
        const std::size_t skies = direct_.skies().skies().size();
        std::vector<SystematicPlacement> placements;
        for (std::size_t k = 0; k < skies; ++k) {
            const std::uint64_t point = 1 + work.task.count + work.block * skies + k;
            placements.emplace_back(sampler_.coordinate(placing, placing.first + point, 2));
        }
        for (auto i = static_cast<std::uint32_t>(work.block); i < work.task.count;
             i += static_cast<std::uint32_t>(work.task.blocks)) {
            throw_if_stopped(stop_);
            const DirectBeams::SkyView view = direct_.sky_view(work, i, false, scratch.direct);
            for (std::size_t k = 0; k < skies; ++k) {
                if (view.beams[k].paths > 0) {
                    scratch.beams.push_back(view.beams[k]);
                    light_pixels(view, view.beams[k], placements[k], scratch, tally);
                }
            }
            direct_.count_contributions(work, view, tally);
        }
        trace_from_vertices(
            rules_of(work), scratch.beams, scratch.vertices, scratch.tracing, tally);
    }

    /// Scores the light of a beam, the last of scratch.beams, on pixels, and adds vertices there.
    void light_pixels(
        const DirectBeams::SkyView& view,
        const Beam& beam,
        SystematicPlacement& placement,
        Scratch& scratch,
        Tally& tally) const {
        const ItemBuffer& image = view.image;
        const double amount = view.per_pixel(beam);
        scratch.pieces.assign(image.id_count(), {});
        DirectLightScore::score(prepared_, beam, tally, [&](DirectLightScore& direct) {
            for (const ItemBuffer::Item& item : image.items()) {
                direct.add(item.triangle, item.cosine, amount * item.pixels);
                if (item.id > 0) {
                    scratch.pieces[item.id] = scattering_piece(
                        prepared_, shares_, beam, item.triangle, item.cosine, amount);
                }
            }
        });
        const auto number = static_cast<std::uint32_t>(scratch.beams.size() - 1);
        image.for_each_run([&](const ItemBuffer::Run& run) {
            placement.add_vertices(
                scratch.pieces[run.id], run.count, number,
                [&](double f) {
                    return image.point(run.first + static_cast<std::uint32_t>(f * run.count));
                },
                scratch.vertices);
        });
    }

    const PreparedScene& prepared_;
    const Sampler& sampler_;
    const RunSpec& spec_;
    std::stop_token stop_;
    double roulette_threshold_;
    ScatteredShares shares_;
    DirectBeams direct_;
    BlockRunner<Scratch> runner_;
    LightTracer tracer_;
    BlockRunner<LightTracer::Scratch> trace_runner_;
};

/// The largest scattered light per path: all paths from first hits carry the same, shared among the
/// bands.
std::vector<double> scattered_flux_per_path(const PreparedScene& prepared) {
    std::vector<double> largest = largest_albedos(prepared.scene());
    for (std::size_t b = 0; b < largest.size(); ++b) {
        largest[b] *= prepared.lights().flux()[b];
    }
    return largest;
}

}  // namespace

SumMeaning first_hits_meaning(const PreparedScene& prepared, const RunSpec& spec) {
    SumMeaning meaning = direct_beams_meaning(prepared, spec);
    const bool traces_sources =
        std::ranges::count(meaning.strategies, SampledBy::paths, &SamplingStrategy::by) > 0;
    if (!traces_sources) {
        meaning.bound("scattered").largest = scattered_flux_per_path(prepared);
    }
    return meaning;
}

std::unique_ptr<Solver> make_first_hits(const SolverInput& input) {
    return std::make_unique<FirstHits>(input);
}

}  // namespace quasimc

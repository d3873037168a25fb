// Direct light by geometry, scattered light by paths from where it falls.
//
// A sun is cut into scan lines, and each line into the segments of surfaces that it lights
// (raster/scan_lines.h): the direct light of every organ, with an error that falls with
// the third power of the number of lines. A sky is a sum of beams from well-spread directions, and
// each is seen pixel by pixel (raster/item_buffer.h). Paths start on segments and pixels
// (solvers/direct/path_vertices.h) and are traced from there (solvers/first_hits/vertex_tracer.h).
// Light of lamps, and of suns so low above an endless stand that lines would cost more than they
// bring, is traced from the sources.

#include "solvers/first_hits/first_hits.h"

#include <algorithm>
#include <array>
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
          roulette_threshold_(
              input.spec.roulette_weight * static_cast<double>(input.prepared.bands())),
          shares_(input.prepared),
          direct_(input),
          runner_(input),
          tracer_(input, direct_.traced()),
          trace_runner_(input) {}

    void solve(const Round& round, Executor& executor, Sums& sums) override {
        const std::vector<VisibilityTask> tasks = direct_.tasks(round, sums);
        const TracedLights& traced = direct_.traced();
        const std::uint64_t blocks =
            tasks.empty() ? 0 : tasks.back().first_block + tasks.back().blocks;
        const bool is_traced = std::find(traced.begin(), traced.end(), true) != traced.end();
        const std::uint64_t traced_blocks = is_traced ? LightTracer::blocks(round) : 0;
        TaskRound all = executor.begin((blocks + traced_blocks) * sums.replicates.size());
        runner_.run(
            blocks, all, sums,
            [&](std::uint32_t replicate, std::uint64_t block, Scratch& scratch, Tally& tally) {
                const Work work = DirectBeams::work_of(tasks, round, sums.units, replicate, block);
                work.task.is_sky ? trace_skies(work, scratch, tally)
                                 : trace_lines(work, scratch, tally);
            });
        trace_runner_.run(
            traced_blocks, all, sums,
            [&](std::uint32_t replicate, std::uint64_t block, LightTracer::Scratch& scratch,
                Tally& tally) { tracer_.trace(round, replicate, block, scratch, tally); });
        sums.paths += round.count;
        sums.samples += samples_of(round);
    }

  private:
    using Work = DirectBeams::Work;
    using Beam = DirectBeams::Beam;

    /// What a worker keeps between blocks.
    struct Scratch {
        explicit Scratch(std::size_t bands) : tracing(bands) {}
        DirectBeams::Scratch direct;
        std::vector<ScatteringPiece> pieces;  // by item of the lines or pixels
        std::vector<SurfaceBeam> beams;
        std::vector<PathVertex> vertices;
        VertexScratch tracing;
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
        const Beam beam = direct_.beam_of(work);
        const Stream placing = direct_.stream_of(work, 0);
        direct_.set_lines(work, beam, placing, scratch.direct);
        ScanLines& lines = scratch.direct.lines;
        const SurfaceBeam share{
            beam.light, beam.direction, DirectBeams::share_of_block(beam.paths, work)};
        scratch.beams.assign(1, share);
        scratch.vertices.clear();
        const double per_length = beam.paths * lines.area() / beam.area;
        lines.begin(static_cast<std::uint32_t>(work.block));
        scratch.pieces.clear();
        for (const ScanLines::Item& item : lines.items()) {
            scratch.pieces.push_back(scattering_piece(
                prepared_, shares_, share, item.triangle, item.cosine, per_length));
        }
        SystematicPlacement placement(
            sampler_.coordinate(placing, placing.first + 1 + work.block, 2));
        while (lines.next()) {
            throw_if_stopped(stop_);
            for (const LinePiece& piece : lines.pieces()) {
                placement.place(
                    scratch.pieces[piece.segment], piece.length(), 0,
                    [&](double f) { return lines.place(piece, f); }, scratch.vertices);
            }
        }
        direct_.score_lines(work, share, per_length, lines, tally);
        trace_from_vertices(
            rules_of(work), scratch.beams, scratch.vertices, scratch.tracing, tally);
    }

    /// Every so many-th direction of the skies: what is seen of it serves all of them.
    void trace_skies(const Work& work, Scratch& scratch, Tally& tally) const {
        const Stream placing = direct_.stream_of(work, 0);
        const std::array<double, 3> lattice = direct_.placing_of(placing, 0);
        scratch.beams.clear();
        scratch.vertices.clear();
        const std::span<const BoundSource* const> skies = direct_.skies().skies();
        std::vector<SystematicPlacement> placements;
        for (std::size_t k = 0; k < skies.size(); ++k) {
            const std::uint64_t point = 1 + work.task.count + work.block * skies.size() + k;
            placements.emplace_back(sampler_.coordinate(placing, placing.first + point, 2));
        }
        for (auto i = static_cast<std::uint32_t>(work.block); i < work.task.count;
             i += static_cast<std::uint32_t>(work.task.blocks)) {
            throw_if_stopped(stop_);
            const DrawnDirection from = direct_.skies().direction(i, work.task.count, lattice);
            scratch.direct.pixels.draw(
                direct_.scene(), direct_.look_of(work, placing, i, from.direction));
            double paths = 0;
            for (std::size_t k = 0; k < skies.size(); ++k) {
                const Beam beam =
                    direct_.beam_of(*skies[k], from.direction, from.density, work, work.task.count);
                if (beam.paths > 0) {
                    paths += beam.paths;
                    scratch.beams.push_back(beam);
                    light_pixels(beam, placements[k], scratch, tally);
                }
            }
            direct_.count_finds(work, from.direction, paths, scratch.direct.pixels, tally);
        }
        trace_from_vertices(
            rules_of(work), scratch.beams, scratch.vertices, scratch.tracing, tally);
    }

    /// Scores what a beam, the last of scratch.beams, brings to pixels, and places vertices there.
    void light_pixels(
        const Beam& beam, SystematicPlacement& placement, Scratch& scratch, Tally& tally) const {
        const ItemBuffer& pixels = scratch.direct.pixels;
        const double amount = beam.paths * pixels.pixel_area() / beam.area;
        DirectLightScore direct(prepared_, beam, tally);
        scratch.pieces.assign(pixels.id_count(), {});
        for (const ItemBuffer::Item& item : pixels.items()) {
            direct.add(item.triangle, item.cosine, amount * item.pixels);
            if (item.id > 0) {
                scratch.pieces[item.id] =
                    scattering_piece(prepared_, shares_, beam, item.triangle, item.cosine, amount);
            }
        }
        direct.add_escaped();
        const auto number = static_cast<std::uint32_t>(scratch.beams.size() - 1);
        pixels.for_each_run([&](const ItemBuffer::Run& run) {
            placement.place(
                scratch.pieces[run.id], run.count, number,
                [&](double f) {
                    return pixels.place(run.first + static_cast<std::uint32_t>(f * run.count));
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

/// A path that starts where light falls stands for as much scattered light as others, of which each
/// band has its part.
std::vector<double> scattered_flux_per_path(const PreparedScene& prepared) {
    std::vector<double> largest = largest_albedos(prepared.scene());
    for (std::size_t b = 0; b < largest.size(); ++b) {
        largest[b] *= prepared.flux()[b];
    }
    return largest;
}

}  // namespace

SumMeaning first_hits_meaning(const PreparedScene& prepared, const RunSpec& spec) {
    SumMeaning meaning = direct_beams_meaning(prepared, spec);
    if (meaning.counted_kinds == meaning.units.kinds.size()) {
        meaning.units.scattered_flux_per_find = scattered_flux_per_path(prepared);
    }
    return meaning;
}

std::unique_ptr<Solver> make_first_hits(const SolverInput& input) {
    return std::make_unique<FirstHits>(input);
}

}  // namespace quasimc

// Direct light by geometry, scattered light by paths from where it falls.
//
// A sun is cut into scan lines, and each line into the segments of surfaces that it lights
// (geometry/raster/scan_lines.h): the direct light of every organ, with an error that falls with
// the third power of the number of lines. A sky is a sum of beams from well-spread directions, and
// each is seen pixel by pixel (geometry/raster/item_buffer.h). Paths start on segments and pixels
// (solvers/path_vertices.h) and are traced from there (solvers/vertex_tracer.h). Light of lamps,
// and of suns so low above an endless stand that lines would cost more than they bring, is traced
// from the sources.

#include "solvers/first_hits.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <span>
#include <stop_token>

#include "base/stop.h"
#include "geometry/raster/item_buffer.h"
#include "geometry/raster/scan_lines.h"
#include "solvers/block_runner.h"
#include "solvers/light_kinds.h"
#include "solvers/light_tracer.h"
#include "solvers/light_tracing.h"
#include "solvers/sampling_budget.h"
#include "solvers/vertex_tracer.h"

namespace quasimc {
namespace {

/// By triangle; empty if all are opaque.
std::vector<VisibilityRole> visibility_roles(const PreparedScene& prepared) {
    const RayCaster& caster = prepared.caster();
    const std::uint32_t triangles = caster.mesh().triangle_count();
    const bool repeats = prepared.scene().cell().periodic();
    std::vector<VisibilityRole> roles;
    for (std::uint32_t i = 0; (prepared.has_transparent() || repeats) && i < triangles; ++i) {
        const bool image = repeats && i > 0 && caster.source(i) == caster.source(i - 1);
        const bool sensor = prepared.material(prepared.region(i)).is_transparent();
        roles.push_back(
            image ? VisibilityRole::left_out
                  : (sensor ? VisibilityRole::sensor : VisibilityRole::opaque));
    }
    return roles;
}

/// Lamps, suns that are not cut into lines, and skies that are not seen by pixels.
TracedLights traced_lights(const PreparedScene& prepared, const SamplingBudget& budget) {
    TracedLights traced;
    for (std::size_t i = 0; i < prepared.lights().size(); ++i) {
        const Source& source = *prepared.lights()[i].source;
        traced.push_back(
            source.is_lamp() || !(source.is_sun() ? budget.has_lines(i) : budget.sees_skies()));
    }
    return traced;
}

/// The kind of lights that a task looks at: place in units.kinds.
std::size_t kind_of(const VisibilityTask& task, const SumUnits& units) {
    const FoundBy by = task.is_sky ? FoundBy::directions : FoundBy::lines;
    const auto kind = std::find_if(
        units.kinds.begin(), units.kinds.end(),
        [&](const LightKind& each) { return each.found_by == by; });
    return static_cast<std::size_t>(kind - units.kinds.begin());
}

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
          skies_(input.prepared),
          roles_(visibility_roles(input.prepared)),
          scene_{
              &prepared_.caster().mesh(), prepared_.projection().cell(), roles_,
              prepared_.projection().outline(), &stop_},
          budget_(input.prepared, skies_, scene_, input.spec.paths),
          runner_(input),
          traced_(traced_lights(input.prepared, budget_)),
          tracer_(input, traced_),
          trace_runner_(input) {}

    void solve(const Round& round, Executor& executor, Sums& sums) override {
        const std::vector<VisibilityTask> tasks = budget_.tasks(round);
        const std::uint64_t blocks =
            tasks.empty() ? 0 : tasks.back().first_block + tasks.back().blocks;
        const bool is_traced = std::find(traced_.begin(), traced_.end(), true) != traced_.end();
        const std::uint64_t traced_blocks = is_traced ? LightTracer::blocks(round) : 0;
        executor.announce((blocks + traced_blocks) * sums.replicates.size());
        for (const VisibilityTask& task : tasks) {
            const double brought = budget_.light_per_look(task, round);
            double& most = sums.per_find[kind_of(task, sums.units)];
            most = std::max(most, brought);
        }
        runner_.run(
            blocks, executor, sums,
            [&](std::uint32_t replicate, std::uint64_t block, Scratch& scratch, Tally& tally) {
                const std::uint32_t i = task_of_block(tasks, block);
                const Work work{
                    round,
                    replicate,
                    i,
                    tasks[i],
                    sums.units,
                    kind_of(tasks[i], sums.units),
                    block - tasks[i].first_block};
                tasks[i].is_sky ? trace_skies(work, scratch, tally)
                                : trace_lines(work, scratch, tally);
            });
        trace_runner_.run(
            traced_blocks, executor, sums,
            [&](std::uint32_t replicate, std::uint64_t block, LightTracer::Scratch& scratch,
                Tally& tally) { tracer_.trace(round, replicate, block, scratch, tally); });
        sums.paths += round.count;
        sums.samples += round.count;
    }

  private:
    /// A block of a task.
    struct Work {
        const Round& round;
        std::uint32_t replicate;
        std::uint32_t number;  ///< of the task
        const VisibilityTask& task;
        const SumUnits& units;
        std::size_t kind;     ///< of the light, in units.kinds
        std::uint64_t block;  ///< of the task
    };
    /// A beam and the area across it, through which its light enters; local units squared.
    struct Beam : SurfaceBeam {
        double area = 1;
    };
    /// What a worker keeps between blocks.
    struct Scratch {
        explicit Scratch(std::size_t bands) : tracing(bands) {}
        ScanLines lines;
        std::optional<std::array<std::uint64_t, 3>> lines_of;  // their task, replicate and round
        ItemBuffer pixels;
        std::vector<ScatteringPiece> pieces;  // by item of the lines or pixels
        std::vector<SurfaceBeam> beams;
        std::vector<PathVertex> vertices;
        VertexScratch tracing;
    };

    /// How many paths' light a light brings.
    static double paths_of(const BoundSource& light, const Round& round) {
        return light.probability * static_cast<double>(round.count);
    }

    /// The point set number `i` of a task's blocks; number 0 places its beams. Light tracing
    /// has sequence 0.
    [[nodiscard]] Stream stream_of(const Work& work, std::uint64_t i) const {
        // A block's paths can't be more than the light of the whole task; beams are placed by at
        // most a number for each of them, and for each sky in each block.
        const std::uint64_t placed =
            work.task.count + work.task.blocks * (1 + skies_.skies().size());
        const std::uint64_t most = std::bit_ceil(2 * work.round.count + 2 + placed);
        // Each light has at most so many tasks.
        const std::uint64_t tasks = prepared_.lights().size() * kDiskBeams;
        return {
            spec_.seed, 1 + work.number + tasks * i, work.replicate, work.round.first * 4, most};
    }

    [[nodiscard]] PathRules rules_of(const Work& work) const {
        return {
            .prepared = &prepared_,
            .sampler = &sampler_,
            .stream = stream_of(work, 1 + work.block),
            .scatter_dimension = 0,
            .max_depth = spec_.max_depth,
            .roulette_threshold = roulette_threshold_,
            .stop = &stop_};
    }

    /// What places the directions of a task: three dimensions of its first point.
    [[nodiscard]] std::array<double, 3> placing_of(
        const Stream& first, std::uint32_t dimension) const {
        const auto coordinate = [&](std::uint32_t i) {
            return sampler_.coordinate(first, first.first, dimension + i);
        };
        return {coordinate(0), coordinate(1), coordinate(2)};
    }

    /// A light's share of one of `count` directions, drawn with `density`.
    [[nodiscard]] Beam beam_of(
        const BoundSource& light,
        const Vec3& direction,
        double density,
        const Work& work,
        std::uint32_t count) const {
        const double area = prepared_.projection().entry_box().projected_area(direction);
        const double entering =
            light.source->radiance(-direction) * area / light.source_sampler->flux();
        const double paths = paths_of(light, work.round) * entering / (density * count);
        return {{&light, direction, paths}, area};
    }

    /// The beam of a task that is cut into lines.
    [[nodiscard]] Beam beam_of(const Work& work) const {
        const BoundSource& light = prepared_.lights()[work.task.light];
        if (const auto direction = light.source_sampler->beam_direction()) {
            return {
                {&light, *direction, paths_of(light, work.round)}, light.source_sampler->flux()};
        }
        // All beams of a disk are placed by the same three numbers.
        const Work first{work.round, work.replicate, work.number - work.task.beam,
                         work.task,  work.units,     work.kind,
                         0};
        const Stream placing = stream_of(first, 0);
        const DrawnDirection from =
            lattice_direction(light, work.task.beam, work.task.beams, placing_of(placing, 3));
        return beam_of(light, from.direction, from.density, work, work.task.beams);
    }

    void trace_lines(const Work& work, Scratch& scratch, Tally& tally) const {
        const Beam beam = beam_of(work);
        const Stream placing = stream_of(work, 0);
        set_lines(work, beam, placing, scratch);
        ScanLines& lines = scratch.lines;
        const SurfaceBeam share{beam.light, beam.direction, share_of_block(beam.paths, work)};
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
        score_lines(work, share, per_length, lines, tally);
        trace_from_vertices(
            rules_of(work), scratch.beams, scratch.vertices, scratch.tracing, tally);
    }

    /// Scores what a strip of lines found.
    void score_lines(
        const Work& work,
        const SurfaceBeam& share,
        double per_length,
        const ScanLines& lines,
        Tally& tally) const {
        DirectLightScore direct(prepared_, share, tally);
        const double most = std::min(work.task.count, ScanLines::kStrip);
        FindCounter finds(prepared_, work.units, work.kind, most, tally);
        for (const ScanLines::Item& item : lines.items()) {
            if (item.length > 0) {
                const double amount = per_length * item.length;
                direct.add(item.triangle, item.cosine, amount);
                finds.add(item.triangle, item.cosine, amount, item.pieces);
            }
        }
        finds.finish();
        direct.add_escaped();
    }

    void set_lines(
        const Work& work, const Beam& beam, const Stream& placing, Scratch& scratch) const {
        const std::array<std::uint64_t, 3> key{work.number, work.replicate, work.round.first};
        if (scratch.lines_of != key) {
            scratch.lines.set(
                scene_, {.direction = beam.direction,
                         .rotation = sampler_.coordinate(placing, placing.first, 0),
                         .shift = sampler_.coordinate(placing, placing.first, 1),
                         .lines = work.task.count});
            scratch.lines_of = key;
        }
    }

    /// A block's part of the light of a beam; all parts add up to it.
    static double share_of_block(double paths, const Work& work) {
        const auto until = [&](std::uint64_t i) {
            return from_fixed(
                to_fixed(paths * static_cast<double>(i) / static_cast<double>(work.task.blocks)));
        };
        return until(work.block + 1) - until(work.block);
    }

    /// Every so many-th direction of the skies: what is seen of it serves all of them.
    void trace_skies(const Work& work, Scratch& scratch, Tally& tally) const {
        const Stream placing = stream_of(work, 0);
        const std::array<double, 3> lattice = placing_of(placing, 0);
        scratch.beams.clear();
        scratch.vertices.clear();
        const std::span<const BoundSource* const> skies = skies_.skies();
        std::vector<SystematicPlacement> placements;
        for (std::size_t k = 0; k < skies.size(); ++k) {
            const std::uint64_t point = 1 + work.task.count + work.block * skies.size() + k;
            placements.emplace_back(sampler_.coordinate(placing, placing.first + point, 2));
        }
        for (auto i = static_cast<std::uint32_t>(work.block); i < work.task.count;
             i += static_cast<std::uint32_t>(work.task.blocks)) {
            throw_if_stopped(stop_);
            const DrawnDirection from = skies_.direction(i, work.task.count, lattice);
            draw_pixels(work, placing, i, from.direction, scratch.pixels);
            double paths = 0;
            for (std::size_t k = 0; k < skies.size(); ++k) {
                const Beam beam =
                    beam_of(*skies[k], from.direction, from.density, work, work.task.count);
                if (beam.paths > 0) {
                    paths += beam.paths;
                    scratch.beams.push_back(beam);
                    light_pixels(beam, placements[k], scratch, tally);
                }
            }
            count_finds(work, from.direction, paths, scratch.pixels, tally);
        }
        trace_from_vertices(
            rules_of(work), scratch.beams, scratch.vertices, scratch.tracing, tally);
    }

    /// Counts what is lit along a direction that brings so many paths' light of all skies.
    void count_finds(
        const Work& work,
        const Vec3& direction,
        double paths,
        const ItemBuffer& pixels,
        Tally& tally) const {
        const double area = prepared_.projection().entry_box().projected_area(direction);
        const double amount = paths * pixels.pixel_area() / area;
        FindCounter finds(prepared_, work.units, work.kind, 1, tally);
        for (const ItemBuffer::Item& item : pixels.items()) {
            finds.add(item.triangle, item.cosine, amount * item.pixels);
        }
        finds.finish();
    }

    /// What is seen along direction `i` of the skies.
    void draw_pixels(
        const Work& work,
        const Stream& placing,
        std::uint32_t i,
        const Vec3& direction,
        ItemBuffer& pixels) const {
        const std::uint64_t point = placing.first + 1 + i;
        pixels.draw(
            scene_, {.direction = direction,
                     .rotation = sampler_.coordinate(placing, point, 3),
                     .shift_s = sampler_.coordinate(placing, point, 4),
                     .shift_t = sampler_.coordinate(placing, point, 5),
                     .pixels = work.task.pixels});
    }

    /// Scores what a beam, the last of scratch.beams, brings to pixels, and places vertices there.
    void light_pixels(
        const Beam& beam, SystematicPlacement& placement, Scratch& scratch, Tally& tally) const {
        const ItemBuffer& pixels = scratch.pixels;
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
        for (const ItemBuffer::Run& run : pixels.runs()) {
            placement.place(
                scratch.pieces[run.id], run.count, number,
                [&](double f) {
                    return pixels.place(run.first + static_cast<std::uint32_t>(f * run.count));
                },
                scratch.vertices);
        }
    }

    const PreparedScene& prepared_;
    const Sampler& sampler_;
    const RunSpec& spec_;
    std::stop_token stop_;
    double roulette_threshold_;
    ScatteredShares shares_;
    SkyDirections skies_;
    std::vector<VisibilityRole> roles_;
    ProjectedScene scene_;
    SamplingBudget budget_;
    BlockRunner<Scratch> runner_;
    TracedLights traced_;
    LightTracer tracer_;
    BlockRunner<LightTracer::Scratch> trace_runner_;
};

/// A path that starts where light falls stands for as much scattered light as others, of which each
/// band has its part.
std::vector<double> scattered_flux_per_path(const PreparedScene& prepared) {
    std::vector<double> largest(prepared.bands());
    const std::vector<bool> is_used = used_materials(prepared.scene());
    for (std::size_t m = 0; m < is_used.size(); ++m) {
        const Material& material = prepared.scene().materials()[m];
        for (const SurfaceSide side : kSurfaceSides) {
            for (std::size_t b = 0; is_used[m] && b < largest.size(); ++b) {
                const double albedo = material.side(side).albedo()[b];
                largest[b] = std::max(largest[b], material.is_transparent() ? 0 : albedo);
            }
        }
    }
    for (std::size_t b = 0; b < largest.size(); ++b) {
        largest[b] *= prepared.flux()[b];
    }
    return largest;
}

}  // namespace

SumMeaning first_hits_meaning(const PreparedScene& prepared, const RunSpec& spec) {
    SumMeaning meaning = light_tracing_meaning(prepared, spec);
    const SkyDirections skies(prepared);
    const std::vector<VisibilityRole> roles = visibility_roles(prepared);
    const ProjectedScene seen{
        &prepared.caster().mesh(), prepared.projection().cell(), roles,
        prepared.projection().outline(), nullptr};
    const SamplingBudget budget(prepared, skies, seen, spec.paths);
    const Round first{0, spec.paths};
    std::vector<LightKind> counted;
    double of_line = 0;
    double spacing = 0;
    for (const VisibilityTask& task : budget.tasks(first)) {
        const double step = budget.light_per_look(task, first);
        if (task.is_sky) {
            counted.push_back(kind_by_direction(prepared, task.count, step));
        } else {
            of_line = std::max(of_line, step);
            spacing = std::max(spacing, budget.spacing(task));
        }
    }
    if (of_line > 0) {
        counted.push_back(kind_by_line(prepared, budget.lights_with_lines(), of_line, spacing));
    }
    std::vector<LightKind>& kinds = meaning.units.kinds;
    std::erase_if(kinds, [&](const LightKind& kind) {
        return std::any_of(counted.begin(), counted.end(), [&](const LightKind& each) {
            return each.spectra == kind.spectra;
        });
    });
    meaning.counted_kinds = counted.size();
    if (kinds.empty()) {
        meaning.units.scattered_flux_per_find = scattered_flux_per_path(prepared);
    }
    kinds.insert(kinds.begin(), counted.begin(), counted.end());
    return meaning;
}

std::unique_ptr<Solver> make_first_hits(const SolverInput& input) {
    return std::make_unique<FirstHits>(input);
}

}  // namespace quasimc

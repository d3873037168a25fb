#include "solvers/direct_on_patches.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/distribution.h"
#include "base/stop.h"
#include "transport/surface.h"

namespace quasimc {

DirectOnPatches::DirectOnPatches(
    const SolverInput& input, const DirectBeams& beams, const PatchScene& patches)
    : prepared_(input.prepared),
      sampler_(input.sampler),
      spec_(input.spec),
      stop_(input.stop),
      patches_(patches),
      beams_(beams) {}

void DirectOnPatches::find(
    const Task& task, Scratch& scratch, PatchLight& light, Tally& tally) const {
    const std::uint64_t blocks =
        task.tasks.empty() ? 0 : task.tasks.back().first_block + task.tasks.back().blocks;
    for (std::uint64_t block = 0; block < blocks; ++block) {
        const Work work =
            DirectBeams::work_of(task.tasks, task.round, task.units, task.replicate, block);
        work.task.is_sky ? find_by_pixels(work, scratch, light, tally)
                         : find_by_lines(work, scratch, light, tally);
    }
    const TracedLights& traced = beams_.traced();
    if (std::find(traced.begin(), traced.end(), true) != traced.end()) {
        trace(task.round, task.replicate, light, tally);
    }
}

void DirectOnPatches::find_by_lines(
    const Work& work, Scratch& scratch, PatchLight& light, Tally& tally) const {
    const Beam beam = beams_.beam_of(work);
    beams_.set_lines(work, beam, beams_.stream_of(work, 0), scratch.beams);
    ScanLines& lines = scratch.beams.lines;
    const SurfaceBeam share{
        beam.light, beam.direction, DirectBeams::share_of_block(beam.paths, work)};
    const double per_length = beam.paths * lines.area() / beam.area;
    lines.begin(static_cast<std::uint32_t>(work.block));
    while (lines.next()) {
        throw_if_stopped(stop_);
        lay_line(beam, per_length, scratch, light);
    }
    beams_.score_lines(work, share, per_length, lines, tally);
}

void DirectOnPatches::lay_line(
    const Beam& beam, double per_length, Scratch& scratch, PatchLight& light) const {
    const ScanLines& lines = scratch.beams.lines;
    const LocalMesh& mesh = prepared_.caster().mesh();
    const LitBands bands = lit_bands(beam.light->start_weights);
    for (const LinePiece& piece : lines.pieces()) {
        const ScanLines::Item& item = lines.items()[piece.segment];
        if (prepared_.material(prepared_.region(item.triangle)).is_transparent() ||
            !(piece.length() > 0)) {
            continue;
        }
        const double amount =
            per_length * piece.length() * mesh.exact_share(item.triangle, beam.direction);
        const SurfaceSide side = item.cosine > 0 ? SurfaceSide::lower : SurfaceSide::upper;
        patches_.patches.cut(
            item.triangle, lines.place(piece, 0), lines.place(piece, 1), scratch.stretches,
            [&](std::uint32_t patch, double share) {
                light.add_direct(patch, side, amount * share, bands);
            });
    }
}

void DirectOnPatches::find_by_pixels(
    const Work& work, Scratch& scratch, PatchLight& light, Tally& tally) const {
    const Stream placing = beams_.stream_of(work, 0);
    const std::array<double, 3> lattice = beams_.placing_of(placing, 0);
    const SkyDirections& skies = beams_.skies();
    for (auto i = static_cast<std::uint32_t>(work.block); i < work.task.count;
         i += static_cast<std::uint32_t>(work.task.blocks)) {
        throw_if_stopped(stop_);
        const DrawnDirection from = skies.direction(i, work.task.count, lattice);
        beams_.draw_pixels(work, placing, i, from.direction, scratch.beams.pixels);
        double paths = 0;
        for (const BoundSource* sky : skies.skies()) {
            const Beam beam =
                beams_.beam_of(*sky, from.direction, from.density, work, work.task.count);
            if (beam.paths > 0) {
                paths += beam.paths;
                light_pixels(beam, scratch.beams.pixels, light, tally);
            }
        }
        beams_.count_finds(work, from.direction, paths, scratch.beams.pixels, tally);
    }
}

void DirectOnPatches::light_pixels(
    const Beam& beam, const ItemBuffer& pixels, PatchLight& light, Tally& tally) const {
    const LocalMesh& mesh = prepared_.caster().mesh();
    const double amount = beam.paths * pixels.pixel_area() / beam.area;
    DirectLightScore direct(prepared_, beam, tally);
    std::vector<const ItemBuffer::Item*> by_id(pixels.id_count(), nullptr);
    for (const ItemBuffer::Item& item : pixels.items()) {
        direct.add(item.triangle, item.cosine, amount * item.pixels);
        by_id[item.id] = item.id > 0 ? &item : nullptr;
    }
    direct.add_escaped();
    const LitBands bands = lit_bands(beam.light->start_weights);
    std::vector<ItemBuffer::Places> places(by_id.size());
    for (std::uint32_t id = 0; id < by_id.size(); ++id) {
        places[id] = by_id[id] == nullptr ? ItemBuffer::Places{} : pixels.places(id);
    }
    for (const ItemBuffer::Run& run : pixels.runs()) {
        if (by_id[run.id] == nullptr) {
            continue;
        }
        const ItemBuffer::Item& item = *by_id[run.id];
        const SurfaceSide side = item.cosine > 0 ? SurfaceSide::lower : SurfaceSide::upper;
        const double of_pixel = amount * mesh.exact_share(item.triangle, beam.direction);
        for (std::uint32_t i = 0; i < run.count; ++i) {
            const Point2 at = places[run.id].of(run.first + i);
            light.add_direct(patches_.patches.at(item.triangle, at.s, at.t), side, of_pixel, bands);
        }
    }
}

/// Paths of light tracing, to their first hits.
void DirectOnPatches::trace(
    const Round& round, std::uint32_t replicate, PatchLight& light, Tally& tally) const {
    const Stream stream{spec_.seed, 0, replicate, round.first, round.count};
    std::uint64_t rays = 0;
    for (std::uint64_t point = round.first; point < round.first + round.count; ++point) {
        throw_if_stopped(stop_);
        const double pick = sampler_.coordinate(stream, point, 0);
        const std::size_t number = prepared_.pick_light(pick);
        if (!beams_.traced()[number]) {
            continue;
        }
        const BoundSource& source = prepared_.lights()[number];
        const double u0 = std::clamp((pick - source.before) / source.probability, 0.0, kBelowOne);
        const auto u = [&](std::uint32_t i) { return sampler_.coordinate(stream, point, i); };
        const Emission start = source.source_sampler->emit({u0, u(1), u(2), u(3)});
        if (start.weight > 0) {
            rays += trace_path(source, start, light, tally);
        }
    }
    tally.add(tally.layout().rays(), static_cast<std::int64_t>(rays));
}

/// @returns the rays cast
std::uint64_t DirectOnPatches::trace_path(
    const BoundSource& source, const Emission& start, PatchLight& light, Tally& tally) const {
    const SumLayout& layout = tally.layout();
    const RayCaster& caster = prepared_.caster();
    tally.add(layout.emitted() + source.spectrum, to_fixed(start.weight));
    CastHit at = source.source->is_lamp() ? caster.cast_from_lamp(start.origin, start.direction)
                                          : caster.cast(start.origin, start.direction, kNoTriangle);
    std::uint64_t rays = 1;
    for (; at.end == RayEnd::hit; ++rays) {
        const Surface surface = surface_at(prepared_, at.hit, start.direction);
        const double amount =
            start.weight * caster.mesh().exact_share(surface.triangle, start.direction);
        if (prepared_.in_field_of_view(surface.region, surface.cosine)) {
            tally.add(
                layout.direct(surface.region, surface.side, source.spectrum), to_fixed(amount));
            const double lit = surface.cosine > 0 ? source.lit_area / surface.cosine : 0;
            tally.add(layout.sunlit(surface.region), to_fixed(amount * lit));
        }
        if (!prepared_.material(surface.region).is_transparent()) {
            tally.add_signed(
                layout.escaped_direct() + source.spectrum,
                to_fixed(start.weight) - to_fixed(amount));
            const std::uint32_t triangle = patches_.representative(surface.triangle);
            light.add_direct(
                patches_.patches.at(triangle, at.hit.u, at.hit.v), surface.side, amount,
                lit_bands(source.start_weights));
            return rays;
        }
        at = caster.cast(place_of(prepared_, at.hit), start.direction, surface.triangle);
    }
    if (at.end == RayEnd::escaped) {
        tally.add(layout.escaped_direct() + source.spectrum, to_fixed(start.weight));
        return rays;
    }
    for (std::size_t b = 0; b < layout.bands; ++b) {
        tally.add(layout.cut_off() + b, to_fixed(start.weight * source.start_weights[b]));
    }
    return rays;
}

}  // namespace quasimc

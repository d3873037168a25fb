#include "solvers/ray_bundles/direct_on_patches.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/stop.h"
#include "samplers/hash.h"
#include "transport/surface.h"

namespace quasimc {
namespace {

/// Which of many lines or directions are laid on patches: one of each few, as many times as bright.
/// What falls on organs is scored with all; scattered light comes from many patches, the noise of
/// which hardly counts beside that of bundles, and laying takes longer than looking.
class LaidLooks {
  public:
    /// @param stream  that places them
    /// @param count  for each light
    /// @param most  of which one is laid, where they are very many
    LaidLooks(const Stream& stream, std::uint32_t count, std::uint32_t most)
        : key_(stream_key(stream, 0, 0)),
          of_(count >= kMany ? std::min(most, count / kFewestLaid) : 1) {}

    /// How many times as bright look `i` is laid; 0: not at all.
    [[nodiscard]] std::uint32_t share(std::uint32_t i) const {
        return mix64(key_ ^ mix64(i / of_)) % of_ == i % of_ ? of_ : 0;
    }
    /// Which rows of pixels of look `i` are laid.
    [[nodiscard]] LaidRows rows(std::uint32_t i) const {
        const std::uint32_t of = of_ > 1 ? kRows : 1;
        return {static_cast<std::uint32_t>(mix64(~key_ ^ mix64(i)) % of), of};
    }

  private:
    static constexpr std::uint32_t kMany = 256, kFewestLaid = 64, kRows = 2;
    std::uint64_t key_;
    std::uint32_t of_;
};

constexpr std::uint32_t kLaidLines = 4;
/// Of dark leaves scattered light is a small part of what they get.
constexpr double kDark = 0.5;
constexpr std::uint32_t kLaidDirections = 4, kLaidOnDark = 8;

/// Side `side` of a patch, as PatchSides counts them.
std::size_t side_of(std::uint32_t patch, SurfaceSide side) {
    return std::size_t{2} * patch + index_of(side);
}

void add_to(std::span<const LitBands> lit, std::size_t side, double amount) {
    for (const LitBands& bands : lit) {
        bands.add(side, amount);
    }
}

/// Adds light to patches some additions later than it is told, in the same order: by then what they
/// hold has come from memory, for which each addition would wait.
class LateAdds {
  public:
    explicit LateAdds(std::span<const LitBands> lit) : lit_(lit) {}

    void add(std::size_t side, double amount) {
        for (const LitBands& bands : lit_) {
            bands.fetch(side);
        }
        Add& place = adds_[told_ % kLate];
        if (told_++ >= kLate) {
            add_to(lit_, place.side, place.amount);
        }
        place = {side, amount};
    }
    /// Adds what is left.
    void finish() {
        for (std::size_t i = told_ > kLate ? told_ - kLate : 0; i < told_; ++i) {
            const Add& place = adds_[i % kLate];
            add_to(lit_, place.side, place.amount);
        }
        told_ = 0;
    }

  private:
    static constexpr std::size_t kLate = 16;
    struct Add {
        std::size_t side = 0;
        double amount = 0;
    };
    std::span<const LitBands> lit_;
    std::array<Add, kLate> adds_{};
    std::size_t told_ = 0;
};

/// Adds what a light brings, times a factor, to the weights of bands.
void add_weights(const std::vector<double>& brought, double factor, std::vector<double>& weights) {
    for (std::size_t b = 0; b < weights.size(); ++b) {
        weights[b] += factor * brought[b];
    }
}

}  // namespace

DirectOnPatches::DirectOnPatches(
    const SolverInput& input, const DirectBeams& beams, const PatchScene& patches)
    : prepared_(input.prepared),
      sampler_(input.sampler),
      spec_(input.spec),
      stop_(input.stop),
      patches_(patches),
      beams_(beams) {}

void DirectOnPatches::find(
    const Task& task, Scratch& scratch, PatchLight& light, OpenSides& open, Tally& tally) const {
    const std::uint64_t blocks =
        task.tasks.empty() ? 0 : task.tasks.back().first_block + task.tasks.back().blocks;
    for (std::uint64_t block = 0; block < blocks; ++block) {
        const Work work =
            DirectBeams::work_of(task.tasks, task.round, task.units, task.replicate, block);
        work.task.is_sky ? find_by_pixels(work, scratch, light, open, tally)
                         : find_by_lines(work, scratch, light, tally);
    }
    const TracedLights& traced = beams_.traced();
    if (std::find(traced.begin(), traced.end(), true) != traced.end()) {
        trace(task.round, task.replicate, light, tally);
    }
}

void DirectOnPatches::find_by_lines(
    const Work& work, Scratch& scratch, PatchLight& light, Tally& tally) const {
    const DirectBeams::LitStrip lit = beams_.lit_strip(work, scratch.beams);
    const LaidLooks laid(beams_.stream_of(work, 0), work.task.count, kLaidLines);
    const std::vector<LitBands> bands = light.lit_bands(lit.share.light->start_weights);
    const auto visible = lit.strip.for_visible_segments([&](const LineStrip::Line& line) {
        throw_if_stopped(stop_);
        const std::uint32_t share = laid.share(line.number);
        if (share > 0) {
            lay_line(lit, line, share * lit.per_length, bands, scratch);
        }
    });
    beams_.score_strip(work, lit, visible, tally);
}

void DirectOnPatches::lay_line(
    const DirectBeams::LitStrip& lit,
    const LineStrip::Line& line,
    double per_length,
    std::span<const LitBands> bands,
    Scratch& scratch) const {
    const LocalMesh& mesh = prepared_.caster().mesh();
    for (const VisibleSegment& segment : line.segments) {
        const auto [triangle, cosine] = lit.strip.triangles()[segment.surface];
        if (prepared_.material(prepared_.region(triangle)).is_transparent() ||
            !(segment.length() > 0)) {
            continue;
        }
        const double amount =
            per_length * segment.length() * mesh.exact_share(triangle, lit.share.direction);
        const SurfaceSide side = cosine > 0 ? SurfaceSide::lower : SurfaceSide::upper;
        patches_.patches.cut(
            triangle, lit.strip.point(line, segment, 0), lit.strip.point(line, segment, 1),
            scratch.stretches, [&](std::uint32_t patch, double share) {
                add_to(bands, side_of(patch, side), amount * share);
            });
    }
}

void DirectOnPatches::find_by_pixels(
    const Work& work, Scratch& scratch, PatchLight& light, OpenSides& open, Tally& tally) const {
    const auto of_each = work.task.count / std::max<std::size_t>(beams_.skies().skies().size(), 1);
    const LaidLooks laid(
        beams_.stream_of(work, 0), static_cast<std::uint32_t>(of_each),
        patches_.mean_albedo < kDark ? kLaidOnDark : kLaidDirections);
    for (auto i = static_cast<std::uint32_t>(work.block); i < work.task.count;
         i += static_cast<std::uint32_t>(work.task.blocks)) {
        throw_if_stopped(stop_);
        const std::uint32_t share = laid.share(i);
        const DirectBeams::SkyView view = beams_.sky_view(work, i, share > 0, scratch.beams);
        std::vector<double> weights(prepared_.bands());  // of all skies, per pixel
        for (const Beam& beam : view.beams) {
            if (beam.paths > 0) {
                score_pixels(beam, view, tally);
                const double of_pixel = share * beam.paths * view.image.pixel_area() / beam.area;
                add_weights(beam.light->start_weights, of_pixel, weights);
            }
        }
        if (view.paths > 0 && share > 0) {
            lay_pixels(view.from.direction, view.image, laid.rows(i), light.lit_bands(weights));
        }
        beams_.count_contributions(work, view, tally);
        open.add_seen(view.image, view.from, work.task.count);
    }
}

void DirectOnPatches::score_pixels(
    const Beam& beam, const DirectBeams::SkyView& view, Tally& tally) const {
    DirectLightScore::score(prepared_, beam, tally, [&](DirectLightScore& direct) {
        for (const ItemBuffer::Item& item : view.image.items()) {
            direct.add(item.triangle, item.cosine, view.per_pixel(beam) * item.pixels);
        }
    });
}

/// @param lit  what a pixel brings
void DirectOnPatches::lay_pixels(
    const Vec3& direction,
    const ItemBuffer& pixels,
    const LaidRows& laid,
    std::span<const LitBands> lit) const {
    struct Seen {
        const ItemBuffer::Item* item = nullptr;
        double share = 1;
    };
    const LocalMesh& mesh = prepared_.caster().mesh();
    std::vector<Seen> by_id(pixels.id_count());
    for (const ItemBuffer::Item& item : pixels.items()) {
        if (item.id > 0) {
            by_id[item.id] = {&item, mesh.exact_share(item.triangle, direction)};
        }
    }
    LateAdds adds(lit);
    pixels.for_each_run_of_rows(laid.first, laid.of, [&](const ItemBuffer::RowRun& run) {
        const Seen& seen = by_id[run.id];
        if (seen.item == nullptr) {
            return;
        }
        const SurfaceSide side = seen.item->cosine > 0 ? SurfaceSide::lower : SurfaceSide::upper;
        const ItemBuffer::Points& points = pixels.points(run.id);
        // Pixels next to each other mostly see the same patch.
        std::uint32_t patch = 0, count = 0;
        for (std::uint32_t x = run.x; x < run.x + run.count; ++x) {
            const Point2 at = points.of(x, run.row);
            const std::uint32_t next = patches_.patches.at(seen.item->triangle, at.s, at.t);
            if (count > 0 && next != patch) {
                adds.add(side_of(patch, side), count * seen.share);
                count = 0;
            }
            patch = next;
            count += laid.of;
        }
        adds.add(side_of(patch, side), count * seen.share);
    });
    adds.finish();
}

/// Paths of light tracing, to their first hits.
void DirectOnPatches::trace(
    const Round& round, std::uint32_t replicate, PatchLight& light, Tally& tally) const {
    const Stream stream{spec_.seed, 0, replicate, round.first, round.count};
    std::vector<std::vector<LitBands>> lit;
    for (const BoundSource& source : prepared_.lights()) {
        lit.push_back(light.lit_bands(source.start_weights));
    }
    std::uint64_t rays = 0;
    for (std::uint64_t point = round.first; point < round.first + round.count; ++point) {
        throw_if_stopped(stop_);
        const LightPick pick = prepared_.pick_light(sampler_.coordinate(stream, point, 0));
        if (!beams_.traced()[pick.index]) {
            continue;
        }
        const BoundSource& source = prepared_.lights()[pick.index];
        const auto u = [&](std::uint32_t i) { return sampler_.coordinate(stream, point, i); };
        const Emission start = source.source_sampler->emit({pick.u, u(1), u(2), u(3)});
        if (start.weight > 0) {
            rays += trace_path(source, start, lit[pick.index], tally);
        }
    }
    tally.add(tally.layout().rays(), static_cast<std::int64_t>(rays));
}

/// @returns the rays cast
std::uint64_t DirectOnPatches::trace_path(
    const BoundSource& source,
    const Emission& start,
    std::span<const LitBands> lit,
    Tally& tally) const {
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
            const bool is_sunlit =
                source.lit_area > 0 && surface.cosine > 0 &&
                prepared_.is_sunlit(surface.triangle, start.direction, surface.cosine);
            const double area = is_sunlit ? source.lit_area / surface.cosine : 0;
            tally.add(
                layout.sunlit(surface.region),
                to_fixed(start.weight * prepared_.sunlit_share(surface.triangle) * area));
        }
        if (!prepared_.material(surface.region).is_transparent()) {
            tally.add_signed(
                layout.escaped_direct() + source.spectrum,
                to_fixed(start.weight) - to_fixed(amount));
            const std::uint32_t triangle = patches_.representative(surface.triangle);
            add_to(
                lit, side_of(patches_.patches.at(triangle, at.hit.u, at.hit.v), surface.side),
                amount);
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

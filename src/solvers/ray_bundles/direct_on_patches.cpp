#include "solvers/ray_bundles/direct_on_patches.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "base/stop.h"
#include "samplers/hash.h"
#include "solvers/ray_bundles/deposit.h"
#include "transport/surface.h"

namespace quasimc {
namespace {

/// Every n-th row of pixels with n times the light, from a random first row.
struct DepositedRows {
    std::uint32_t first = 0, of = 4;
};

/// How many samples are deposited: one of every `most`, or as many as leave `fewest` of them.
struct DepositDensity {
    std::uint32_t fewest = 64, most = 4;
};
constexpr DepositDensity kLineDensity;
/// Scattered light is a small part of the light of low-albedo leaves.
constexpr double kDark = 0.5;
constexpr DepositDensity kDirectionDensity{.most = 2}, kDensityOnDark{.fewest = 16};

/// The subset of lines or directions that are deposited on patches: one of every n, with n times
/// the light. Light on organs is scored with all. Scattered light comes from many patches, whose
/// noise is small beside that of bundles, and depositing takes longer than projecting.
class DepositedSamples {
  public:
    /// @param stream  of the samples
    /// @param count  for each light
    DepositedSamples(const Stream& stream, std::uint32_t count, const DepositDensity& density)
        : key_(stream_key(stream, 0, 0)),
          of_(std::clamp(count / density.fewest, 1U, density.most)) {}

    /// The factor for the light of sample `i`; 0: it is not deposited.
    [[nodiscard]] std::uint32_t factor(std::uint32_t i) const {
        return mix64(key_ ^ mix64(i / of_)) % of_ == i % of_ ? of_ : 0;
    }
    /// The rows of pixels of sample `i` that are deposited.
    [[nodiscard]] DepositedRows rows(std::uint32_t i) const {
        DepositedRows rows;
        rows.first = static_cast<std::uint32_t>(mix64(~key_ ^ mix64(i)) % rows.of);
        return rows;
    }

  private:
    std::uint64_t key_;
    std::uint32_t of_;
};

/// Side `side` of a patch, as PatchSides counts them.
std::size_t side_of(std::uint32_t patch, SurfaceSide side) {
    return std::size_t{2} * patch + index_of(side);
}

/// The side that light arrives on. @param along  dot(unit normal of the upper side, its direction)
SurfaceSide lit_side(double along) {
    return along > 0 ? SurfaceSide::lower : SurfaceSide::upper;
}

/// Finds and deposits the direct light of one replicate.
class DirectDeposit {
  public:
    DirectDeposit(
        const SolverInput& input,
        const DirectBeams& beams,
        const ReplicateInput& replicate,
        PatchLight& light,
        DirectScratch& scratch,
        Tally& tally)
        : input_(input),
          prepared_(input.prepared),
          beams_(beams),
          patches_(light.scene()),
          replicate_(replicate),
          light_(light),
          scratch_(scratch),
          tally_(tally),
          open_(beams.viewed_skies() != nullptr ? 2 * patches_.region_areas.size() : 0) {
        for (const VisibilityTask& task : replicate.tasks) {
            picked_lines_ += task.is_picked ? task.count : 0;
        }
    }

    /// @returns the areas of sides that see the sky
    OpenAreas run() {
        const std::vector<VisibilityTask>& tasks = replicate_.tasks;
        for (std::uint64_t block = 0; block < blocks_of(tasks); ++block) {
            const Work work = DirectBeams::work_of(
                tasks, replicate_.round, replicate_.counted, replicate_.index, block);
            work.task.is_sky ? deposit_skies(work) : deposit_strip(work);
        }
        const TracedLights& traced = beams_.traced();
        if (std::find(traced.begin(), traced.end(), true) != traced.end()) {
            trace();
        }
        tally_.count(WorkUnit::piece, pieces_);
        return std::move(open_);
    }

  private:
    using Work = DirectBeams::Work;
    using Beam = DirectBeams::Beam;

    void deposit_strip(const Work& work) {
        const DirectBeams::LitStrip lit = beams_.lit_strip(work, scratch_.beams);
        const DepositedSamples deposited(
            beams_.stream_of(work, 0), work.task.is_picked ? picked_lines_ : work.task.count,
            kLineDensity);
        const std::vector<double> weights = patches_.bands.weights_of(*lit.share.light);
        const std::vector<LitBands> bands = lit_bands(light_, weights);
        const auto visible = lit.strip.for_visible_segments([&](const LineStrip::Line& line) {
            throw_if_stopped(input_.stop);
            const std::uint32_t factor = deposited.factor(line.number);
            if (factor > 0) {
                deposit_line(lit, line, factor * lit.per_length, bands);
            }
        });
        beams_.score_strip(work, lit, visible, tally_);
    }

    void deposit_line(
        const DirectBeams::LitStrip& lit,
        const LineStrip::Line& line,
        double per_length,
        std::span<const LitBands> bands) {
        const LocalMesh& mesh = prepared_.caster().mesh();
        for (const VisibleSegment& segment : line.segments) {
            const auto [triangle, cosine] = lit.strip.triangles()[segment.surface];
            if (prepared_.material(prepared_.region(triangle)).is_transparent() ||
                !(segment.length() > 0)) {
                continue;
            }
            const double amount =
                per_length * segment.length() * mesh.exact_share(triangle, lit.share.direction);
            const SurfaceSide side = lit_side(cosine);
            patches_.patches.cut(
                triangle, lit.strip.point(line, segment, 0), lit.strip.point(line, segment, 1),
                scratch_.segments, [&](std::uint32_t patch, double share) {
                    add_to(bands, side_of(patch, side), amount * share);
                    ++pieces_;
                });
        }
    }

    void deposit_skies(const Work& work) {
        const SkyDirections& skies = beams_.skies();
        const auto of_each = work.task.count / std::max<std::size_t>(skies.skies().size(), 1);
        const DepositedSamples deposited(
            beams_.stream_of(work, 0), static_cast<std::uint32_t>(of_each),
            patches_.mean_albedo < kDark ? kDensityOnDark : kDirectionDensity);
        for (auto i = static_cast<std::uint32_t>(work.block); i < work.task.count;
             i += static_cast<std::uint32_t>(work.task.blocks)) {
            throw_if_stopped(input_.stop);
            const std::uint32_t factor = deposited.factor(i);
            const DirectBeams::SkyView view = beams_.sky_view(work, i, factor > 0, scratch_.beams);
            const std::vector<double> weights = score_skies(view, factor);
            if (view.paths > 0 && factor > 0) {
                const DepositedRows rows = deposited.rows(i);
                deposit_pixels(view, rows, lit_bands(light_, weights));
                tally_.count(
                    WorkUnit::patch_pixel, static_cast<std::uint64_t>(work.task.pixels) / rows.of);
            }
            beams_.count_contributions(work, view, tally_);
            // An exitance of 1 is a radiance of 1 / pi.
            const double open = sky_weight(skies, view.from.direction) /
                                (view.from.density * work.task.count) / std::numbers::pi *
                                view.image.pixel_area();
            add_open_pixels(patches_, view.image, open, open_);
        }
    }

    /// Scores the light of all skies. @returns the weight of a pixel per column, times `factor`
    std::vector<double> score_skies(const DirectBeams::SkyView& view, double factor) {
        std::vector<double> weights(patches_.bands.count());
        for (const Beam& beam : view.beams) {
            if (!(beam.paths > 0)) {
                continue;
            }
            score(view, beam);
            const double of_pixel = factor * beam.paths * view.image.pixel_area() / beam.area;
            const std::vector<double> own = patches_.bands.weights_of(*beam.light);
            for (std::size_t c = 0; c < weights.size(); ++c) {
                weights[c] += of_pixel * own[c];
            }
        }
        return weights;
    }

    void score(const DirectBeams::SkyView& view, const Beam& beam) {
        DirectLightScore::score(prepared_, beam, tally_, [&](DirectLightScore& direct) {
            for (const ItemBuffer::Item& item : view.image.items()) {
                direct.add(item.triangle, item.cosine, view.per_pixel(beam) * item.pixels);
            }
        });
    }

    /// @param lit  by one pixel
    void deposit_pixels(
        const DirectBeams::SkyView& view,
        const DepositedRows& rows,
        std::span<const LitBands> lit) const {
        struct Seen {
            const ItemBuffer::Item* item = nullptr;
            double share = 1;
        };
        const ItemBuffer& image = view.image;
        const LocalMesh& mesh = prepared_.caster().mesh();
        std::vector<Seen> by_id(image.id_count());
        for (const ItemBuffer::Item& item : image.items()) {
            if (item.id > 0) {
                by_id[item.id] = {&item, mesh.exact_share(item.triangle, view.from.direction)};
            }
        }
        const auto deposit_run = [&](const ItemBuffer::RowRun& run, PrefetchedAdds& adds) {
            const Seen& seen = by_id[run.id];
            if (seen.item == nullptr) {
                return;
            }
            const SurfaceSide side = lit_side(seen.item->cosine);
            const ItemBuffer::Points& points = image.points(run.id);
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
                count += rows.of;
            }
            adds.add(side_of(patch, side), count * seen.share);
        };
        PrefetchedAdds::add(lit, [&](PrefetchedAdds& adds) {
            image.for_each_run_of_rows(rows.first, rows.of, [&](const ItemBuffer::RowRun& run) {
                deposit_run(run, adds);
            });
        });
    }

    /// Traces paths from sources, to their first hits.
    void trace() {
        const Round& round = replicate_.round;
        const Sampler& sampler = input_.sampler;
        const Stream stream{input_.spec.seed, 0, replicate_.index, round.first, round.count};
        std::vector<std::vector<double>> weights;
        std::vector<std::vector<LitBands>> lit;
        for (const BoundSource& source : prepared_.lights()) {
            weights.push_back(patches_.bands.weights_of(source));
            lit.push_back(lit_bands(light_, weights.back()));
        }
        std::uint64_t rays = 0;
        for (std::uint64_t point = round.first; point < round.first + round.count; ++point) {
            throw_if_stopped(input_.stop);
            const LightPick pick = prepared_.lights().pick(sampler.coordinate(stream, point, 0));
            if (!beams_.traced()[pick.index]) {
                continue;
            }
            const BoundSource& source = prepared_.lights()[pick.index];
            const auto u = [&](std::uint32_t i) { return sampler.coordinate(stream, point, i); };
            const Emission start = source.source_sampler->emit({pick.u, u(1), u(2), u(3)});
            if (start.weight > 0) {
                rays += trace_path(source, start, lit[pick.index]);
            }
        }
        tally_.count(WorkUnit::ray, rays);
    }

    /// @returns the rays cast
    std::uint64_t trace_path(
        const BoundSource& source, const Emission& start, std::span<const LitBands> lit) {
        const LightBlocks& blocks = tally_.blocks();
        const RayCaster& caster = prepared_.caster();
        tally_.add(blocks.emitted() + source.spectrum, to_fixed(start.weight));
        CastHit at = source.source->is_lamp()
                         ? caster.cast_from_lamp(start.origin, start.direction)
                         : caster.cast(start.origin, start.direction, kNoTriangle);
        std::uint64_t rays = 1;
        for (; at.end == RayEnd::hit; ++rays) {
            const Surface surface = surface_at(prepared_, at.hit, start.direction);
            const double amount =
                start.weight * caster.mesh().exact_share(surface.triangle, start.direction);
            if (prepared_.fields_of_view().contain(surface.region, surface.cosine)) {
                tally_.add(
                    blocks.direct(surface.region, surface.side, source.spectrum), to_fixed(amount));
                const bool is_sunlit = source.lit_area > 0 && surface.cosine > 0 &&
                                       prepared_.rounding().is_sunlit(
                                           surface.triangle, start.direction, surface.cosine);
                const double area = is_sunlit ? source.lit_area / surface.cosine : 0;
                tally_.add_sunlit(
                    surface.region, surface.side,
                    to_fixed(
                        start.weight * prepared_.rounding().area_share(surface.triangle) * area));
            }
            if (!prepared_.material(surface.region).is_transparent()) {
                tally_.add_signed(
                    blocks.escaped_direct() + source.spectrum,
                    to_fixed(start.weight) - to_fixed(amount));
                const std::uint32_t triangle = patches_.representative(surface.triangle);
                add_to(
                    lit, side_of(patches_.patches.at(triangle, at.hit.u, at.hit.v), surface.side),
                    amount);
                return rays;
            }
            at = caster.cast(point_of(prepared_, at.hit), start.direction, surface.triangle);
        }
        if (at.end == RayEnd::escaped) {
            tally_.add(blocks.escaped_direct() + source.spectrum, to_fixed(start.weight));
            return rays;
        }
        for (std::size_t b = 0; b < prepared_.bands(); ++b) {
            tally_.add(
                blocks.cut_off(source.origin) + b,
                to_fixed(start.weight * source.start_weights[b]));
        }
        return rays;
    }

    const SolverInput& input_;
    const PreparedScene& prepared_;
    const DirectBeams& beams_;
    const PatchScene& patches_;
    const ReplicateInput& replicate_;
    PatchLight& light_;
    DirectScratch& scratch_;
    Tally& tally_;
    OpenAreas open_;
    std::uint32_t picked_lines_ = 0;  // of all suns that are picked of many
    std::uint64_t pieces_ = 0;        // of lines on patches
};

}  // namespace

DirectOnPatches score_and_deposit_direct(
    const SolverInput& input,
    const DirectBeams& beams,
    const ReplicateInput& replicate,
    std::unique_ptr<PatchLight> memory,
    DirectScratch& scratch,
    Tally& tally) {
    PatchIrradiance irradiance = no_irradiance(std::move(memory));
    OpenAreas open =
        DirectDeposit(input, beams, replicate, *irradiance.light, scratch, tally).run();
    return {std::move(irradiance), std::move(open)};
}

}  // namespace quasimc

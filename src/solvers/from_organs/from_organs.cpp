// Tracing from the organs: points on every organ look for light.
//
// At a point of the organ, and at every hit of a path that starts there, one direction to a light
// is drawn and tested (next-event estimation). Light that comes by a sharp lobe, or a mirror, is
// hardly ever found so. From a sky it is found by the paths that the lobe sends there; from a sun
// or a lamp from its own side, so a light path follows each point's where a scene has such lobes.
// So does what falls on something next to a lamp (NearLamps): from there points take it, unless
// they are near too (VertexLight). The sets of paths are disjoint by where and how light meets its
// first surfaces, and together complete (PathFilter::left_out).

#include "solvers/from_organs/from_organs.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <stop_token>

#include "base/stop.h"
#include "solvers/block_runner.h"
#include "solvers/from_organs/from_organs_units.h"
#include "solvers/from_organs/look_directions.h"
#include "solvers/from_organs/next_event.h"
#include "solvers/from_organs/organ_points.h"
#include "transport/absorbed_light.h"
#include "transport/light_vertices.h"
#include "transport/near_lamps.h"
#include "transport/organ_shares.h"
#include "transport/particle.h"
#include "transport/surface.h"

namespace quasimc {
namespace {

/// A point of an organ that looks for light, and its number in the point set.
struct Point : OrganPoint {
    std::uint64_t index = 0;
};

class FromOrgans final : public Solver {
  public:
    explicit FromOrgans(const SolverInput& input)
        : prepared_(input.prepared),
          sampler_(input.sampler),
          spec_(input.spec),
          stop_(input.stop),
          roulette_threshold_(
              input.spec.roulette_weight * static_cast<double>(input.prepared.bands())),
          measured_(measured_area(input.prepared.scene())),
          organ_points_(input.prepared),
          looks_(input.prepared),
          near_(input.prepared),
          followed_peak_(followed_peak(input.prepared.scene())),
          next_event_(
              input.prepared,
              input.sampler,
              near_,
              kFinerSteps * measured_.area,
              followed_peak_,
              points_of(input.spec.paths, measured_)),
          vertex_light_(input.prepared, kFinerSteps * measured_.area, followed_peak_),
          needs_companion_(needs_light_paths(input.prepared, near_)),
          runner_(input) {
        points_per_organ_ = points_of(spec_.paths, measured_);
        for (const BoundSource& light : prepared_.lights()) {
            if (!light.is_extended()) {
                start_dimensions_ = light.source_sampler->beam_direction() ? start_dimensions_ : 4U;
            }
        }
        const Scene& scene = prepared_.scene();
        part_of_unit_.assign(scene.regions().size(), 1);
        if (needs_companion_) {
            for (std::size_t i = 0; const double coarser : coarseness_of(scene, measured_)) {
                part_of_unit_[i++] = 1 / coarser;
            }
        }
        for (std::size_t i = 0; i < scene.regions().size(); ++i) {
            const double own = scene.organs()[scene.regions()[i].organ.value].area;
            companion_scale_.push_back(part_of_unit_[i] * units_of_light_path(measured_, own));
            part_of_unit_[i] *=
                OrganPoints::open_part(scene.organs()[scene.regions()[i].organ.value]);
        }
        connected_ = near_.any() ? connected_regions(
                                       prepared_, parts_by_vertices(prepared_, measured_, near_))
                                 : std::vector<char>{};
        has_others_ = std::find(connected_.begin(), connected_.end(), 0) != connected_.end();
    }

    void solve(const Round& round, Executor& executor, Sums& sums) override {
        const std::uint64_t count = blocks(round);
        TaskRound tasks = executor.begin(count * sums.replicates.size());
        runner_.run(
            count, tasks, sums,
            [&](std::uint32_t replicate, std::uint64_t block, Scratch& scratch, Tally& tally) {
                trace(round, replicate, block, scratch, tally);
            });
        sums.paths += round.count;
        sums.samples += samples_of(round);
    }
    [[nodiscard]] std::uint64_t samples_of(const Round& round) const override {
        return points(round.count);
    }

  private:
    struct Scratch {
        explicit Scratch(std::size_t bands)
            : path(bands), companion(bands), fixed(bands), irradiance(bands) {}
        GatherScratch path;
        ParticleScratch companion;
        std::vector<std::int64_t> fixed;  // per band
        std::vector<double> irradiance;   // per band: from a light vertex
    };

    /// Points per organ of so many paths: a power of two, as point sets like it.
    static std::uint64_t points_of(std::uint64_t paths, const MeasuredArea& measured) {
        return std::bit_floor(std::max<std::uint64_t>(1, paths / measured.organs.size()));
    }

    /// Blocks of points and their companions.
    [[nodiscard]] std::uint64_t blocks(const Round& round) const {
        const std::uint64_t each = points(round.count);
        return each >= kPointsPerBlock ? organs() * (each / kPointsPerBlock)
                                       : (organs() * each + kPointsPerBlock - 1) / kPointsPerBlock;
    }

    void trace(
        const Round& round,
        std::uint32_t replicate,
        std::uint64_t block,
        Scratch& scratch,
        Tally& tally) const {
        const std::uint64_t each = points(round.count);
        const std::uint64_t own_streams = prepared_.scene().organs().size();
        std::uint64_t rays = 0;
        const std::uint64_t begin = block * kPointsPerBlock;
        const std::uint64_t end = std::min(begin + kPointsPerBlock, organs() * each);
        const std::uint64_t first = points(round.first);
        for (std::uint64_t i = begin; i < end; ++i) {
            throw_if_stopped(stop_);
            const std::uint64_t organ = measured_.organs[i / each];
            const std::uint64_t index = first + i % each;
            if (needs_companion_) {
                const Stream stream{spec_.seed, own_streams + organ + 1, replicate, first, each};
                rays += trace_companion(stream, index, scratch, tally);
            }
            const Stream stream{spec_.seed, organ + 1, replicate, first, each};
            rays += trace_point(stream, organ, index, scratch, tally);
        }
        tally.add(tally.layout().rays(), static_cast<std::int64_t>(rays));
    }

    [[nodiscard]] std::uint64_t organs() const { return measured_.organs.size(); }
    /// Points per organ after `paths` of the run.
    [[nodiscard]] std::uint64_t points(std::uint64_t paths) const {
        return paths / spec_.paths * points_per_organ_;
    }

    [[nodiscard]] double coordinate(
        const Stream& stream, std::uint64_t point, std::uint32_t dimension) const {
        return sampler_.coordinate(stream, point, dimension);
    }

    std::uint64_t trace_point(
        const Stream& stream,
        std::uint64_t organ_index,
        std::uint64_t index,
        Scratch& scratch,
        Tally& tally) const {
        if (part_of_unit_[prepared_.scene().organs()[organ_index].first_region] <= 0) {
            return 0;  // none of it is open
        }
        const Point point{
            organ_points_.place(
                organ_index, coordinate(stream, index, 0), coordinate(stream, index, 1)),
            index};
        if (connected_.empty() || connected_[point.region] == 0) {
            scratch.companion.vertices.clear();
        }
        return score_direct(stream, point, tally) + score_vertices(point, scratch, tally) +
               score_scattered(stream, point, scratch, tally);
    }

    /// Light that comes to the point straight from the vertices of its light path.
    std::uint64_t score_vertices(const Point& point, Scratch& scratch, Tally& tally) const {
        std::uint64_t rays = 0;
        const LightVertices& vertices = scratch.companion.vertices;
        for (std::size_t i = 0; i < vertices.all().size(); ++i) {
            const LightVertex& vertex = vertices.all()[i];
            const auto [wi, is_asked_for, arrives] = vertex_light_.find(
                vertex, vertices.weights(i), point.place, point.triangle, near_.leg(*vertex.light),
                scratch.irradiance);
            rays += is_asked_for ? 1 : 0;
            const double cosine = dot(wi, point.up);
            if (!arrives || !prepared_.in_field_of_view(point.region, std::abs(cosine))) {
                continue;
            }
            const SurfaceSide side = side_facing(cosine);
            const double factor = part_of_unit_[point.region] * std::abs(cosine);
            for (std::size_t b = 0; b < scratch.fixed.size(); ++b) {
                scratch.fixed[b] = to_fixed(factor * scratch.irradiance[b]);
            }
            tally.add(tally.layout().scattered(point.region, side), scratch.fixed);
            score_absorbed(
                prepared_,
                {point.region, side, std::abs(cosine), LightPart::scattered, factor,
                 scratch.irradiance},
                tally);
        }
        return rays;
    }

    /// Adds to scratch.path.gathered what a surface sends along `out` of the light that comes to it
    /// from the vertices of the light path. Returns the rays cast.
    /// @param depth  hits of the path that runs backwards, this one with them
    std::uint64_t add_vertices(
        const Surface& surface,
        const Vec3& place,
        const Vec3& out,
        std::uint32_t depth,
        Scratch& scratch) const {
        std::uint64_t rays = 0;
        const LightVertices& vertices = scratch.companion.vertices;
        GatherScratch& path = scratch.path;
        for (std::size_t i = 0; i < vertices.all().size(); ++i) {
            const LightVertex& vertex = vertices.all()[i];
            if (spec_.max_depth > 0 && vertex.depth + depth >= spec_.max_depth) {
                continue;
            }
            const auto [wi, is_asked_for, arrives] = vertex_light_.find(
                vertex, vertices.weights(i), place, surface.triangle, near_.leg(*vertex.light),
                scratch.irradiance);
            rays += is_asked_for ? 1 : 0;
            for (std::size_t b = 0; b < path.products.size(); ++b) {
                path.products[b] = path.weights[b] * scratch.irradiance[b];
            }
            if (arrives) {
                prepared_.material(surface.region)
                    .add_reflected(
                        surface.normal, surface.side, out, wi, 1, path.products, path.gathered,
                        followed_peak_);
            }
        }
        return rays;
    }

    std::uint64_t score_direct(const Stream& stream, const Point& point, Tally& tally) const {
        const Sight sight = next_event_.look(
            stream, point.index, 2, point.place, {point.up, prepared_.least_cosine(point.region)});
        const double cosine = dot(sight.to_light, point.up);
        if (cosine == 0 || sight.factor == 0 || NextEvent::is_in_plane(sight, point.up) ||
            near_.lights_near(*sight.light, point.region, point.place) ||
            !prepared_.in_field_of_view(point.region, std::abs(cosine))) {
            return 0;
        }
        const SumLayout& layout = tally.layout();
        const SurfaceSide side = side_facing(-cosine);
        const double part = part_of_unit_[point.region];
        const double amount = part * sight.factor * std::abs(cosine);
        tally.add(layout.unoccluded(point.region, side, sight.light->spectrum), to_fixed(amount));
        if (!prepared_.reaches(point.place, sight.to_light, sight.distance, point.triangle)) {
            return 1;
        }
        tally.add(layout.direct(point.region, side, sight.light->spectrum), to_fixed(amount));
        score_absorbed(
            prepared_,
            {point.region, side, std::abs(cosine), LightPart::direct, amount,
             sight.light->start_weights},
            tally);
        if (sight.light->sun_share > 0 &&
            prepared_.is_sunlit(point.triangle, sight.to_light, cosine)) {
            tally.add(
                layout.sunlit(point.region),
                to_fixed(part * kFinerSteps * sight.light->sun_share / sight.probability));
        }
        return 1;
    }

    /// Light that other surfaces send to the point: a path backwards from it, to one of its
    /// two sides.
    std::uint64_t score_scattered(
        const Stream& stream, const Point& point, Scratch& scratch, Tally& tally) const {
        const std::uint32_t dimension = 2 + next_event_.dimensions();
        const AwayLook look = looks_.draw(
            point, coordinate(stream, point.index, dimension),
            coordinate(stream, point.index, dimension + 1));
        if (look.factor == 0) {
            return 0;
        }
        std::fill(scratch.path.weights.begin(), scratch.path.weights.end(), 1.0);
        std::fill(scratch.path.gathered.begin(), scratch.path.gathered.end(), 0.0);
        const std::uint64_t rays = gather(stream, point, look.away, dimension + 2, scratch);
        const double factor = look.factor * part_of_unit_[point.region];
        for (std::size_t b = 0; b < scratch.fixed.size(); ++b) {
            scratch.fixed[b] = to_fixed(factor * scratch.path.gathered[b]);
        }
        tally.add(tally.layout().scattered(point.region, look.side), scratch.fixed);
        score_absorbed(
            prepared_,
            {point.region, look.side, look.cosine, LightPart::scattered, factor,
             scratch.path.gathered},
            tally);
        return rays;
    }

    /// Sums in scratch.path.gathered the radiance that comes to the point along -away, in cell
    /// units.
    std::uint64_t gather(
        const Stream& stream,
        const Point& point,
        Vec3 away,
        std::uint32_t dimension,
        Scratch& scratch) const {
        Vec3 place = point.place;
        std::uint32_t triangle = point.triangle;
        bool by_sharp = false;
        std::uint64_t rays = 0;
        for (std::uint32_t depth = 1;;) {
            throw_if_stopped(stop_);
            // After the last hit that counts only the sky does, if a sharp lobe shows it.
            const bool is_last = depth == spec_.max_depth;
            if (is_last && !by_sharp) {
                return rays;
            }
            const CastHit at = prepared_.caster().cast(place, away, triangle);
            ++rays;
            if (at.end != RayEnd::hit) {
                if (by_sharp && at.end == RayEnd::escaped) {
                    next_event_.add_sky(away, scratch.path);
                }
                return rays;
            }
            const Surface surface = surface_at(prepared_, at.hit, away);
            const Material& material = prepared_.material(surface.region);
            place = place_of(prepared_, at.hit);
            triangle = surface.triangle;
            if (material.is_transparent()) {
                continue;
            }
            if (is_last) {
                return rays;
            }
            const Sight sight = next_event_.look(stream, point.index, dimension, place);
            rays += next_event_.add_light(sight, surface, place, -away, scratch.path);
            rays += add_vertices(surface, place, -away, depth, scratch);
            dimension += next_event_.dimensions();
            const auto from = material.gather(
                surface.normal, surface.side, -away,
                {coordinate(stream, point.index, dimension),
                 coordinate(stream, point.index, dimension + 1), roulette_threshold_},
                scratch.path.weights);
            if (!from) {
                return rays;
            }
            dimension += 2;
            ++depth;
            by_sharp = from->sharp;
            away = -from->wi;
        }
    }

    /// A light path for what points do not look for: light of a sun or a lamp whose first
    /// scattering is by a sharp lobe, or that falls on something near the lamp.
    std::uint64_t trace_companion(
        const Stream& stream, std::uint64_t index, Scratch& scratch, Tally& tally) const {
        scratch.companion.vertices.clear();
        const LightPick pick = prepared_.pick_light(coordinate(stream, index, 0));
        const BoundSource& light = prepared_.lights()[pick.index];
        if (light.is_extended()) {
            return 0;
        }
        const bool is_beam = light.source_sampler->beam_direction().has_value();
        const std::array<double, 4> u{
            pick.u, coordinate(stream, index, 1), is_beam ? 0 : coordinate(stream, index, 2),
            is_beam ? 0 : coordinate(stream, index, 3)};
        const Emission emission = light.source_sampler->emit(u);
        const PathRules rules{
            .prepared = &prepared_,
            .sampler = &sampler_,
            .stream = stream,
            .scatter_dimension = start_dimensions_,
            .max_depth = spec_.max_depth,
            .roulette_threshold = roulette_threshold_,
            .filter = PathFilter::left_out,
            .scales = companion_scale_,
            .stop = &stop_,
            .near = &near_,
            .sharp_from = followed_peak_,
            .connected = connected_,
            .has_others = has_others_};
        const CastHit at =
            light.source->is_lamp()
                ? prepared_.caster().cast_from_lamp(emission.origin, emission.direction)
                : prepared_.caster().cast(emission.origin, emission.direction, kNoTriangle);
        return 1 + trace_particle(
                       rules, {&light, index, emission.direction, emission.weight}, at,
                       FirstHit::to_score, scratch.companion, tally);
    }

    const PreparedScene& prepared_;
    const Sampler& sampler_;
    const RunSpec& spec_;
    std::stop_token stop_;
    double roulette_threshold_;
    MeasuredArea measured_;
    std::uint64_t points_per_organ_ = 1;
    OrganPoints organ_points_;
    LookDirections looks_;
    NearLamps near_;
    double followed_peak_;
    NextEvent next_event_;
    VertexLight vertex_light_;
    bool needs_companion_;
    std::vector<char> connected_;  // by region; empty: none is
    bool has_others_ = true;       // some measured region is not
    BlockRunner<Scratch> runner_;
    std::uint32_t start_dimensions_ = 2;  // of a companion: 2 if all sources are beams
    // By region, what a point stands for: 1 over coarseness_of(), of the organ's open part.
    std::vector<double> part_of_unit_;
    std::vector<double> companion_scale_;  // by region: from flux per light path to units
};

}  // namespace

std::unique_ptr<Solver> make_from_organs(const SolverInput& input) {
    return std::make_unique<FromOrgans>(input);
}

bool do_from_organs_rounds_add_up(const Scene& scene, std::uint64_t first_paths) {
    return first_paths >= measured_area(scene).organs.size();
}

}  // namespace quasimc

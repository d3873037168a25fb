// Backward tracing: points on every organ sample the light that they receive.
//
// At a point of an organ, and at every vertex of the backward path from there, one direction to a
// light is sampled and tested for occlusion (next-event estimation). This hardly ever samples light
// that comes by a narrow lobe, or a mirror. From a sky such light is sampled by backward paths
// through the lobe; from a sun or a lamp by a light subpath, one for each point if a scene has such
// lobes. Light subpaths also sample the near field of lamps (LampNearField): points are connected
// with their vertices, unless they are near too (VertexLight). The classes of paths are disjoint,
// and together complete (path_class.h).

#include "solvers/from_organs/from_organs.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stop_token>

#include "base/additive_recurrence.h"
#include "base/distribution.h"
#include "base/stop.h"
#include "solvers/block_runner.h"
#include "solvers/direct/visibility.h"
#include "solvers/from_organs/backward_path.h"
#include "solvers/from_organs/from_organs_units.h"
#include "solvers/from_organs/gather_directions.h"
#include "solvers/from_organs/light_subpath.h"
#include "solvers/from_organs/next_event.h"
#include "solvers/from_organs/organ_points.h"
#include "transport/organ_shares.h"
#include "transport/score.h"

namespace quasimc {
namespace {

/// A point of an organ or a sensor, and its number in the point set.
struct Point : OrganPoint {
    std::uint64_t index = 0;

    /// Its surface, as light from a direction meets it. The cosine is the weight of the light, 1
    /// for a sphere.
    [[nodiscard]] Surface surface(const Vec3& to_light) const {
        if (receiver == Receiver::sphere) {
            return {triangle, region, SurfaceSide::upper, to_light, 1};
        }
        const double cosine = dot(to_light, up);
        const SurfaceSide side = side_facing(-cosine);
        return {triangle, region, side, side == SurfaceSide::upper ? up : -up, std::abs(cosine)};
    }
};

class FromOrgans final : public Solver {
  public:
    explicit FromOrgans(const SolverInput& input)
        : prepared_(input.prepared),
          sampler_(input.sampler),
          spec_(input.spec),
          stop_(input.stop),
          measured_(measured_area(input.prepared.scene())),
          points_per_organ_(points_of(input.spec.paths, measured_)),
          organ_points_(input.prepared),
          gather_directions_(input.prepared),
          near_(input.prepared),
          followed_peak_(followed_peak(input.prepared.scene())),
          next_event_(
              input.prepared,
              input.sampler,
              near_,
              kFinerQuanta * measured_.area,
              followed_peak_,
              points_per_organ_),
          vertex_light_(input.prepared, kFinerQuanta * measured_.area, followed_peak_),
          backward_paths_(input, next_event_, vertex_light_, near_, followed_peak_),
          subpaths_(input, measured_, near_, followed_peak_),
          part_of_unit_(parts_of_unit(input.prepared, measured_, near_)),
          runner_(input) {
        const Scene& scene = prepared_.scene();
        for (std::size_t i = 0; i < part_of_unit_.size(); ++i) {
            part_of_unit_[i] *=
                OrganPoints::open_part(scene.organs()[scene.regions()[i].organ.value]);
        }
    }

    void solve(const Round& round, Executor& executor, Sums& sums) override {
        const std::uint64_t count = blocks(round);
        const SideBlocks unoccluded(sums->layout, "unoccluded");
        TaskRound tasks = executor.begin(count * sums->replicates.size());
        runner_.run(
            count, tasks, sums,
            [&](std::uint32_t replicate, std::uint64_t block, Scratch& scratch, Tally& tally) {
                scratch.unoccluded = unoccluded;
                trace(round, replicate, block, scratch, tally);
            });
        sums->paths += round.count;
        sums->samples += samples_of(round);
    }
    [[nodiscard]] std::uint64_t samples_of(const Round& round) const override {
        return points(round.count);
    }

  private:
    struct Scratch {
        explicit Scratch(std::size_t bands) : path(bands), subpath(bands) {}
        GatherScratch path;
        LightSubpathScratch subpath;
        SideBlocks unoccluded;  // unoccluded light
    };

    /// Points per organ for a number of paths: a power of two, which suits point sets best.
    static std::uint64_t points_of(std::uint64_t paths, const MeasuredArea& measured) {
        return std::bit_floor(std::max<std::uint64_t>(1, paths / measured.organs.size()));
    }

    /// Blocks of points and their light subpaths.
    [[nodiscard]] std::uint64_t blocks(const Round& round) const {
        return block_count(organs() * points(round.count), kPointsPerBlock);
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
        const auto [begin, end] = block_range(organs() * each, kPointsPerBlock, block);
        const std::uint64_t first = points(round.first);
        for (std::uint64_t i = begin; i < end; ++i) {
            throw_if_stopped(stop_);
            const std::uint64_t organ = measured_.organs[i / each];
            const std::uint64_t index = first + i % each;
            if (subpaths_.any()) {
                const Stream stream{spec_.seed, own_streams + organ + 1, replicate, first, each};
                rays += subpaths_.trace(stream, index, scratch.subpath, tally);
            }
            const Stream stream{spec_.seed, organ + 1, replicate, first, each};
            rays += trace_point(stream, organ, index, scratch, tally);
        }
        tally.count(WorkUnit::ray, rays);
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
            organ_points_.point(
                organ_index, coordinate(stream, index, 0), coordinate(stream, index, 1)),
            index};
        if (!subpaths_.are_connected_with(point.region)) {
            scratch.subpath.vertices.clear();
        }
        return sample_direct(stream, point, scratch.unoccluded, tally) +
               sample_vertices(point, scratch, tally) +
               sample_surfaces(stream, point, scratch, tally);
    }

    /// Adds the direct light of the point. That of a sensor is sampled several times, since its
    /// other light costs more rays and is known better. The samples are shifted by the additive
    /// recurrence R2 (Roberts 2018).
    std::uint64_t sample_direct(
        const Stream& stream,
        const Point& point,
        const SideBlocks& unoccluded,
        Tally& tally) const {
        constexpr std::uint32_t kOfSensor = 8;
        constexpr auto kShifts = kPlaneSteps;
        const bool is_random = next_event_.dimensions() > 0;
        double u0 = is_random ? coordinate(stream, point.index, 2) : 0;
        double u1 = is_random ? coordinate(stream, point.index, 3) : 0;
        const std::uint32_t count = point.is_sensor() && is_random ? kOfSensor : 1;
        const FieldOfView view{point.up, prepared_.fields_of_view().least_cosine(point.region)};
        std::uint64_t rays = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const LightSample sample = next_event_.sample_light(u0, u1, point.p, view);
            rays += add_direct(point, sample, 1. / count, unoccluded, tally);
            u0 = std::min(u0 + kShifts[0] - (u0 + kShifts[0] < 1 ? 0 : 1), kBelowOne);
            u1 = std::min(u1 + kShifts[1] - (u1 + kShifts[1] < 1 ? 0 : 1), kBelowOne);
        }
        return rays;
    }

    /// Adds a share of the light of a sampled source, if it reaches the point.
    std::uint64_t add_direct(
        const Point& point,
        const LightSample& sample,
        double share,
        const SideBlocks& unoccluded,
        Tally& tally) const {
        const Surface surface = point.surface(sample.to_light);
        if (surface.cosine == 0 || sample.factor == 0 ||
            NextEvent::is_in_plane(sample, surface.normal) ||
            (!point.is_sensor() && near_.lights_near(*sample.light, point.region, point.p)) ||
            !prepared_.fields_of_view().contain(point.region, surface.cosine)) {
            return 0;
        }
        const double part = share * part_of_unit_[point.region];
        const double amount = part * sample.factor * surface.cosine;
        tally.add(
            unoccluded.bin(point.region, surface.side, sample.light->spectrum), to_fixed(amount));
        if (!is_visible_source(
                prepared_, point.p, sample.to_light, sample.distance, point.triangle)) {
            return 1;
        }
        score_direct(prepared_, surface, *sample.light, amount, tally);
        if (sample.light->sun_share > 0 && is_sunlit(point, sample.to_light)) {
            tally.add_sunlit(
                point.region, surface.side,
                to_fixed(part * kFinerQuanta * sample.light->sun_share / sample.probability));
        }
        return 1;
    }

    [[nodiscard]] bool is_sunlit(const Point& point, const Vec3& to_light) const {
        return point.is_sensor() ||
               prepared_.rounding().is_sunlit(point.triangle, to_light, dot(to_light, point.up));
    }

    /// Adds the light that the point receives from the vertices of its light subpath. No subpath
    /// meets a sensor, so that all connections with it count, even short ones.
    std::uint64_t sample_vertices(const Point& point, Scratch& scratch, Tally& tally) const {
        std::uint64_t rays = 0;
        const LightVertices& vertices = scratch.subpath.vertices;
        for (std::size_t i = 0; i < vertices.all().size(); ++i) {
            const LightVertex& vertex = vertices.all()[i];
            const auto [wi, is_traced, arrives] = vertex_light_.connect(
                vertex, vertices.weights(i), point.p, point.triangle,
                point.is_sensor() ? 0 : near_.min_connection_distance(*vertex.light),
                scratch.path.irradiance);
            rays += is_traced ? 1 : 0;
            const Surface surface = point.surface(-wi);
            if (!arrives || !prepared_.fields_of_view().contain(point.region, surface.cosine)) {
                continue;
            }
            score_scattered(
                prepared_, surface, vertex.light->origin,
                part_of_unit_[point.region] * surface.cosine, scratch.path.irradiance, tally);
        }
        return rays;
    }

    /// Adds the light that the point receives from other surfaces: a backward path from one of its
    /// two sides.
    std::uint64_t sample_surfaces(
        const Stream& stream, const Point& point, Scratch& scratch, Tally& tally) const {
        const std::uint32_t dimension = 2 + next_event_.dimensions();
        const GatherSample sample = gather_directions_.draw(
            point, coordinate(stream, point.index, dimension),
            coordinate(stream, point.index, dimension + 1));
        if (sample.factor == 0) {
            return 0;
        }
        const std::uint64_t rays = backward_paths_.gather(
            {stream, point.index, dimension + 2}, point, sample.away, scratch.subpath.vertices,
            scratch.path);
        const Surface surface{
            point.triangle, point.region, sample.side,
            sample.side == SurfaceSide::upper ? point.up : -point.up, sample.cosine};
        for (std::size_t origin = 0; origin < prepared_.lights().origin_count(); ++origin) {
            score_scattered(
                prepared_, surface, origin, sample.factor * part_of_unit_[point.region],
                scratch.path.gathered_from(origin), tally);
        }
        return rays;
    }

    const PreparedScene& prepared_;
    const Sampler& sampler_;
    const RunSpec& spec_;
    std::stop_token stop_;
    MeasuredArea measured_;
    std::uint64_t points_per_organ_;
    OrganPoints organ_points_;
    GatherDirections gather_directions_;
    LampNearField near_;
    double followed_peak_;
    NextEvent next_event_;
    VertexLight vertex_light_;
    BackwardPaths backward_paths_;
    LightSubpaths subpaths_;
    std::vector<double> part_of_unit_;  // by region: light of a point, for the organ's open part
    BlockRunner<Scratch> runner_;
};

}  // namespace

std::unique_ptr<Solver> make_from_organs(const SolverInput& input) {
    return std::make_unique<FromOrgans>(input);
}

bool do_from_organs_rounds_add_up(const Scene& scene, std::uint64_t first_paths) {
    return first_paths >= measured_area(scene).organs.size();
}

}  // namespace quasimc

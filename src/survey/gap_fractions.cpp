#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/angles.h"
#include "base/executor.h"
#include "base/parallel.h"
#include "geometry/cast/ray_caster.h"
#include "geometry/cast/rounding.h"
#include "quasimc/gap_fraction.h"
#include "results/organ_values.h"
#include "samplers/catalogue.h"
#include "scene/scene.h"
#include "survey/gap_counts.h"

namespace quasimc {
namespace {

/// Whether each region blocks the view: those of sensors never do.
std::vector<bool> blocking_regions(const Scene& scene, const std::string& where) {
    const std::optional<WhereExpression> condition =
        where.empty() ? std::nullopt : std::optional(WhereExpression(where));
    const OrganValues values(scene, {});
    std::vector<bool> blocks(scene.regions().size());
    for (const Organ& organ : scene.organs()) {
        const bool is_meant = organ.is_ground || !condition || values.holds(*condition, organ);
        for (std::size_t i = 0; i < organ.region_count; ++i) {
            const std::size_t region = organ.first_region + i;
            blocks[region] =
                is_meant && !data_of(scene).material(scene.regions()[region]).is_transparent();
        }
    }
    return blocks;
}

/// The directions of a position: uniform in solid angle within each bin.
class GapRays {
  public:
    GapRays(const GapFractionSpec& spec, const Orientation& axes)
        : spec_(spec), north_(axes.towards(0, 0)), east_(axes.towards(90, 0)) {}

    /// @param u, v  in [0, 1)
    [[nodiscard]] Vec3 direction(std::size_t bin, double u, double v) const {
        const std::size_t ring = bin / spec_.azimuths, sector = bin % spec_.azimuths;
        const double high = std::cos(spec_.rings_deg[ring] * kRadians);
        const double low = std::cos(spec_.rings_deg[ring + 1] * kRadians);
        const double up = high + u * (low - high);
        const double flat = std::sqrt(std::max(0.0, 1 - up * up));
        const double around =
            2 * std::numbers::pi * (static_cast<double>(sector) + v) / spec_.azimuths;
        return flat * (std::cos(around) * north_ + std::sin(around) * east_) + Vec3{0, 0, up};
    }

  private:
    const GapFractionSpec& spec_;
    Vec3 north_, east_;
};

/// Casts rays from points in the canopy.
class ViewCaster {
  public:
    ViewCaster(const Scene& scene, const std::string& where, const std::stop_token& stop)
        : scene_(scene),
          caster_(data_of(scene).geometry, scene.cell(), Accelerator::embree, stop),
          blocks_(blocking_regions(scene, where)) {}

    /// Whether nothing that blocks lies in a direction. The position may lie on a surface.
    [[nodiscard]] bool is_open(const Vec3& from, const Vec3& direction) const {
        CastHit at = caster_.cast_from_lamp(caster_.mesh().to_local(from), direction);
        while (at.end == RayEnd::hit && !blocks(at.hit.triangle)) {
            const Vec3 behind = caster_.mesh().point(at.hit.triangle, at.hit.u, at.hit.v) +
                                4 * static_cast<double>(kNear) * direction;
            at = caster_.cast(behind, direction, at.hit.triangle);
        }
        return at.end != RayEnd::hit;
    }

  private:
    [[nodiscard]] bool blocks(std::uint32_t triangle) const {
        return blocks_[data_of(scene_).region_of(caster_.source(triangle)).value];
    }

    const Scene& scene_;
    RayCaster caster_;
    std::vector<bool> blocks_;
};

GapCounts count_gaps(const Scene& scene, const GapFractionSpec& spec, const std::stop_token& stop) {
    GapCounts counts{spec.positions.size(), spec.rings(), spec.azimuths, spec.replicates, 0, {}};
    counts.rays = static_cast<std::uint32_t>((spec.rays + counts.bins() - 1) / counts.bins());
    counts.open.resize(counts.replicates * counts.positions * counts.bins());
    const ViewCaster caster(scene, spec.where, stop);
    const GapRays rays(spec, scene.orientation());
    const auto sampler = make_sampler("sobol");
    Executor(thread_count(spec.threads), {.stop = stop})
        .run(counts.replicates * counts.positions, [&](std::uint64_t task, unsigned) {
            const std::size_t replicate = task / counts.positions,
                              position = task % counts.positions;
            const Vec3 from = scene.orientation().inward(spec.positions[position]);
            std::vector<double> u(counts.rays), v(counts.rays);
            for (std::size_t bin = 0; bin < counts.bins(); ++bin) {
                const Stream stream{
                    .seed = spec.seed,
                    .sequence = position * counts.bins() + bin,
                    .replicate = static_cast<std::uint32_t>(replicate),
                    .count = counts.rays};
                sampler->coordinates(stream, 0, 0, u);
                sampler->coordinates(stream, 0, 1, v);
                for (std::size_t i = 0; i < u.size(); ++i) {
                    const bool is_open = caster.is_open(from, rays.direction(bin, u[i], v[i]));
                    counts.at(replicate, position, bin) += is_open ? 1 : 0;
                }
            }
        });
    return counts;
}

}  // namespace

GapFractions gap_fractions(
    const Scene& scene, const GapFractionSpec& spec, const std::stop_token& stop) {
    Faults faults;
    check_gap_fraction(scene, spec, faults);
    faults.throw_if_any();
    const GapCounts counts = count_gaps(scene, spec, stop);
    GapFractions found{spec, gaps_of(counts), gap_indices(spec, counts, 0, counts.positions), {}};
    for (std::size_t position = 0; position < counts.positions; ++position) {
        found.by_position.push_back(gap_indices(spec, counts, position, 1));
    }
    return found;
}

}  // namespace quasimc

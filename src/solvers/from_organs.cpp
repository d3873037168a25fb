// Tracing from the organs: points on every organ look for light.
//
// At a point of the organ, and at every hit of a path that starts there, one direction to a light
// is drawn and tested (next-event estimation). BoundSource that comes by a lobe of one direction
// can't be found so. From a sky it is found by the paths that a mirror sends there; from a sun or a
// lamp only from its own side, so a light path follows each point's where a scene has such lobes
// (PathFilter::delta_first). The two sets of paths are disjoint by their first scattering and
// together complete.
//
// A cell holds, for one element of an organ of area A, A_ref / flux times the mean irradiance, per
// point.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/distribution.h"
#include "solvers/estimator.h"
#include "sources/hemisphere.h"
#include "transport/next_event.h"
#include "transport/organ_points.h"
#include "transport/particle.h"
#include "transport/surface.h"

namespace quasimc {
namespace {

/// Points a block holds: of one organ, or of several if they have few each.
constexpr std::uint64_t kBlock = 8192;
/// Steps of the fixed point are finer by this: weights of big organs are small (2^40 steps a unit,
/// 2^23 units).
constexpr double kGain = 4096;

/// A point of an organ that looks for light, and its number in the point set.
struct Point : OrganPoint {
    std::uint64_t index = 0;
};

class BackwardEstimator final : public Estimator {
  public:
    BackwardEstimator(const PreparedScene& prepared, const Sampler& sampler, const RunSpec& spec)
        : prepared_(prepared),
          sampler_(sampler),
          spec_(spec),
          roulette_threshold_(spec.roulette_weight * static_cast<double>(prepared.bands())),
          organ_points_(prepared) {
        const std::vector<Organ>& all = prepared.scene().organs();
        for (std::uint32_t i = 0; i < all.size(); ++i) {
            if (measures(all[i])) {
                measured_.push_back(i);
                reference_area_ += all[i].area;
            }
        }
        next_event_.emplace(prepared, sampler, kGain * reference_area_);
        const std::uint64_t share = std::max<std::uint64_t>(1, spec.paths / organs());
        points_per_organ_ = std::bit_floor(share);
        const auto& lights = prepared.lights();
        for (const BoundSource& light : lights) {
            if (!light.is_extended()) {
                hides_from_mirrors_ = true;
                start_dimensions_ = light.source_sampler->beam_direction() ? start_dimensions_ : 4U;
            }
        }
        for (const Region& region : prepared.scene().regions()) {
            const double own = prepared.scene().organs()[region.organ.value].area;
            companion_scale_.push_back(
                own > 0 ? kGain * reference_area_ / (own * static_cast<double>(organs())) : 0);
        }
    }

    [[nodiscard]] std::uint64_t blocks(const Round& round) const override {
        const std::uint64_t each = points(round.count);
        const std::uint64_t own =
            each >= kBlock ? organs() * (each / kBlock) : (organs() * each + kBlock - 1) / kBlock;
        return own * (needs_companion() ? 2 : 1);
    }

    void trace(
        const Round& round,
        std::uint32_t replicate,
        std::uint64_t block,
        Workspace& workspace,
        Tally& tally) const override {
        const std::uint64_t each = points(round.count);
        const std::uint64_t own = blocks(round) / (needs_companion() ? 2 : 1);
        const bool companion = block >= own;
        const std::uint64_t piece = companion ? block - own : block;
        std::uint64_t rays = 0;
        const std::uint64_t begin = piece * kBlock;
        const std::uint64_t end = std::min(begin + kBlock, organs() * each);
        const std::uint64_t first = points(round.first);
        for (std::uint64_t i = begin; i < end; ++i) {
            const std::uint64_t organ = measured_[i / each];
            const Stream stream{
                spec_.seed, (companion ? prepared_.scene().organs().size() : 0) + organ + 1,
                replicate, first, each};
            rays += companion ? trace_companion(stream, first + i % each, workspace, tally)
                              : trace_point(stream, organ, first + i % each, workspace, tally);
        }
        tally.add(tally.layout().rays(), static_cast<std::int64_t>(rays));
    }

    [[nodiscard]] double flux_per_unit(
        std::uint32_t region, std::size_t band, std::uint64_t paths) const override {
        return prepared_.flux()[band] / reference_area_ * organ_area(region) / kGain /
               static_cast<double>(points(paths));
    }
    [[nodiscard]] double sunlit_area_per_unit(
        std::uint32_t region, std::uint64_t paths) const override {
        return organ_area(region) / kGain / static_cast<double>(points(paths));
    }
    [[nodiscard]] double flux_per_find(
        std::uint32_t region, std::size_t band, std::uint64_t paths) const override {
        double irradiance = 0;
        for (const BoundSource& light : prepared_.lights()) {
            irradiance += light.source->spectrum()[band] * light.usual_irradiance;
        }
        return irradiance * organ_area(region) / static_cast<double>(points(paths));
    }
    [[nodiscard]] double sunlit_area_per_find(
        std::uint32_t region, std::uint64_t paths) const override {
        return organ_area(region) / static_cast<double>(points(paths));
    }
    [[nodiscard]] bool measures(const Organ& organ) const override { return organ.measured; }
    [[nodiscard]] bool counts_escapes() const override { return false; }

  private:
    [[nodiscard]] std::uint64_t organs() const { return measured_.size(); }
    /// Points per organ after `paths` of the run.
    [[nodiscard]] std::uint64_t points(std::uint64_t paths) const {
        return paths / spec_.paths * points_per_organ_;
    }
    [[nodiscard]] double organ_area(std::uint32_t region) const {
        return prepared_.scene().organs()[prepared_.scene().regions()[region].organ.value].area;
    }
    [[nodiscard]] bool needs_companion() const {
        return hides_from_mirrors_ && prepared_.has_delta();
    }

    [[nodiscard]] double number(
        const Stream& stream, std::uint64_t point, std::uint32_t dimension) const {
        return sampler_.coordinate(stream, point, dimension);
    }

    std::uint64_t trace_point(
        const Stream& stream,
        std::uint64_t organ_index,
        std::uint64_t index,
        Workspace& workspace,
        Tally& tally) const {
        const Organ& organ = prepared_.scene().organs()[organ_index];
        if (organ.area <= 0) {
            return 0;
        }
        const Point point{
            organ_points_.place(organ_index, number(stream, index, 0), number(stream, index, 1)),
            index};
        return score_direct(stream, point, tally) +
               score_scattered(stream, point, workspace, tally);
    }

    std::uint64_t score_direct(const Stream& stream, const Point& point, Tally& tally) const {
        const Sight sight = next_event_->look(stream, point.index, 2, point.place);
        const double cosine = dot(sight.to_light, point.up);
        if (cosine == 0 || sight.factor == 0 ||
            !prepared_.in_field_of_view(point.region, std::abs(cosine))) {
            return 0;
        }
        if (!prepared_.reaches(point.place, sight.to_light, sight.distance, point.triangle)) {
            return 1;
        }
        const TallyLayout& layout = tally.layout();
        tally.add(
            layout.direct(point.region, cosine < 0, sight.light->spectrum),
            to_fixed(sight.factor * std::abs(cosine)));
        if (sight.light->sun_share > 0) {
            tally.add(
                layout.sunlit(point.region),
                to_fixed(kGain * sight.light->sun_share / sight.light->probability));
        }
        return 1;
    }

    /// BoundSource that other surfaces send to the point: a path backwards from it, to one of its
    /// two sides.
    std::uint64_t score_scattered(
        const Stream& stream, const Point& point, Workspace& workspace, Tally& tally) const {
        const std::uint32_t dimension = 2 + next_event_->dimensions();
        const double side = 2 * number(stream, point.index, dimension);
        const bool lower = side >= 1;
        const Vec3 normal = lower ? -point.up : point.up;
        // Of the square of the sine; less than 1 for sensors with a narrow field of view.
        const double part = 1 - std::pow(prepared_.least_cosine(point.region), 2);
        const Vec3 away = cosine_direction_about(
            normal, part * (lower ? side - 1 : side), number(stream, point.index, dimension + 1));
        std::fill(workspace.weights.begin(), workspace.weights.end(), 1.0);
        std::fill(workspace.gathered.begin(), workspace.gathered.end(), 0.0);
        const std::uint64_t rays = gather(stream, point, away, dimension + 2, workspace);
        for (std::size_t b = 0; b < workspace.fixed.size(); ++b) {
            // pi for the cosine law, 2 for the choice of a side.
            workspace.fixed[b] = to_fixed(2 * std::numbers::pi * part * workspace.gathered[b]);
        }
        tally.add(tally.layout().scattered(point.region, lower), workspace.fixed);
        return rays;
    }

    /// Sums in workspace.gathered the radiance that comes to the point along -away, in cell units.
    std::uint64_t gather(
        const Stream& stream,
        const Point& point,
        Vec3 away,
        std::uint32_t dimension,
        Workspace& workspace) const {
        Vec3 place = point.place;
        std::uint32_t triangle = point.triangle;
        bool by_delta = false;
        std::uint64_t rays = 0;
        for (std::uint32_t depth = 1;;) {
            // After the last hit that counts only the sky does, if a mirror shows it.
            const bool is_last = depth == spec_.max_depth;
            if (is_last && !by_delta) {
                return rays;
            }
            const CastHit at = prepared_.caster().cast(place, away, triangle);
            ++rays;
            if (at.end != RayEnd::hit) {
                if (by_delta && at.end == RayEnd::escaped) {
                    next_event_->add_sky(away, workspace);
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
            const Sight sight = next_event_->look(stream, point.index, dimension, place);
            rays += next_event_->add_light(sight, surface, place, -away, workspace);
            dimension += next_event_->dimensions();
            const auto from = material.gather(
                surface.normal, surface.upper, -away,
                {number(stream, point.index, dimension), number(stream, point.index, dimension + 1),
                 roulette_threshold_},
                workspace.weights);
            if (!from) {
                return rays;
            }
            dimension += 2;
            ++depth;
            by_delta = from->delta;
            away = -from->wi;
        }
    }

    /// A light path for what points can't find: light of a sun or a lamp whose first scattering is
    /// in one direction.
    std::uint64_t trace_companion(
        const Stream& stream, std::uint64_t index, Workspace& workspace, Tally& tally) const {
        const double u0 = number(stream, index, 0);
        const BoundSource& light = prepared_.lights()[prepared_.pick_light(u0)];
        if (light.is_extended()) {
            return 0;
        }
        const bool is_beam = light.source_sampler->beam_direction().has_value();
        const std::array<double, 4> u{
            std::clamp((u0 - light.before) / light.probability, 0.0, kBelowOne),
            number(stream, index, 1), is_beam ? 0 : number(stream, index, 2),
            is_beam ? 0 : number(stream, index, 3)};
        const Emission emission = light.source_sampler->emit(u);
        const PathRules rules{
            &prepared_,
            &sampler_,
            stream,
            start_dimensions_,
            spec_.max_depth,
            roulette_threshold_,
            PathFilter::delta_first,
            companion_scale_};
        const CastHit at =
            prepared_.caster().cast(emission.origin, emission.direction, kNoTriangle);
        return 1 + follow(
                       rules, {&light, index, emission.direction, emission.weight}, at,
                       FirstHit::to_score, workspace, tally);
    }

    const PreparedScene& prepared_;
    const Sampler& sampler_;
    const RunSpec& spec_;
    double roulette_threshold_;
    std::vector<std::uint32_t> measured_;  // organs that points are placed on
    std::uint64_t points_per_organ_ = 1;
    OrganPoints organ_points_;
    std::uint32_t start_dimensions_ = 2;   // of a companion: 2 if all lights are beams
    bool hides_from_mirrors_ = false;      // some light is a sun or a lamp
    std::vector<double> companion_scale_;  // by element: from flux per light path to cell units
    double reference_area_ = 0;
    std::optional<NextEvent> next_event_;
};

}  // namespace

std::unique_ptr<Estimator> make_backward_estimator(
    const PreparedScene& prepared, const Sampler& sampler, const RunSpec& spec) {
    return std::make_unique<BackwardEstimator>(prepared, sampler, spec);
}

}  // namespace quasimc

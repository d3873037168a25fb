// Tracing from the organs: points on every organ look for light.
//
// At a point of the organ, and at every hit of a path that starts there, one direction to a light
// is drawn and tested (next-event estimation). Light that comes by a lobe of one direction can't be
// found so. From a sky it is found by the paths that a mirror sends there; from a sun or a lamp
// only from its own side, so a light path follows each point's where a scene has such lobes
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

#include "quasimc/tracing/estimator.h"
#include "quasimc/tracing/organ_points.h"
#include "quasimc/tracing/path.h"
#include "quasimc/tracing/surface.h"

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
    BackwardEstimator(const Stage& stage, const Sampler& sampler, const RunSpec& spec)
        : stage_(stage),
          sampler_(sampler),
          spec_(spec),
          enough_(spec.roulette_weight * static_cast<double>(stage.bands())),
          organ_points_(stage) {
        const std::vector<Organ>& all = stage.scene().organs();
        for (std::uint32_t i = 0; i < all.size(); ++i) {
            if (measures(all[i])) {
                measured_.push_back(i);
                reference_area_ += all[i].area;
            }
        }
        const std::uint64_t share = std::max<std::uint64_t>(1, spec.paths / organs());
        points_per_organ_ = std::bit_floor(share);
        const auto& lights = stage.lights();
        light_dimensions_ = lights.size() == 1 && lights[0].source->is_directional() ? 0U : 2U;
        for (const Light& light : lights) {
            if (!light.is_found_by_chance()) {
                hides_from_mirrors_ = true;
                start_dimensions_ = light.emitter->beam_direction() ? start_dimensions_ : 4U;
            }
        }
        for (const Element& element : stage.scene().elements()) {
            const double own = stage.scene().organs()[element.organ.value].area;
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
                spec_.seed, (companion ? stage_.scene().organs().size() : 0) + organ + 1, replicate,
                first, each};
            rays += companion ? trace_companion(stream, first + i % each, workspace, tally)
                              : trace_point(stream, organ, first + i % each, workspace, tally);
        }
        tally.add(tally.layout().rays(), static_cast<std::int64_t>(rays));
    }

    [[nodiscard]] double flux_per_unit(
        std::uint32_t element, std::size_t band, std::uint64_t paths) const override {
        return stage_.flux()[band] / reference_area_ * organ_area(element) / kGain /
               static_cast<double>(points(paths));
    }
    [[nodiscard]] double sunlit_area_per_unit(
        std::uint32_t element, std::uint64_t paths) const override {
        return organ_area(element) / kGain / static_cast<double>(points(paths));
    }
    [[nodiscard]] double flux_per_find(
        std::uint32_t element, std::size_t band, std::uint64_t paths) const override {
        double irradiance = 0;
        for (const Light& light : stage_.lights()) {
            irradiance += light.source->spectrum()[band] * light.usual_irradiance;
        }
        return irradiance * organ_area(element) / static_cast<double>(points(paths));
    }
    [[nodiscard]] double sunlit_area_per_find(
        std::uint32_t element, std::uint64_t paths) const override {
        return organ_area(element) / static_cast<double>(points(paths));
    }
    [[nodiscard]] bool measures(const Organ& organ) const override { return organ.measured; }
    [[nodiscard]] bool counts_escapes() const override { return false; }

  private:
    [[nodiscard]] std::uint64_t organs() const { return measured_.size(); }
    /// Points per organ after `paths` of the run.
    [[nodiscard]] std::uint64_t points(std::uint64_t paths) const {
        return paths / spec_.paths * points_per_organ_;
    }
    [[nodiscard]] double organ_area(std::uint32_t element) const {
        return stage_.scene().organs()[stage_.scene().elements()[element].organ.value].area;
    }
    [[nodiscard]] bool needs_companion() const { return hides_from_mirrors_ && stage_.has_delta(); }

    [[nodiscard]] double number(
        const Stream& stream, std::uint64_t point, std::uint32_t dimension) const {
        return sampler_.number(stream, point, dimension);
    }

    /// A light and a direction to it. `factor` times start weights and cosine is what it brings, in
    /// cell units.
    struct Sight {
        const Light* light = nullptr;
        Vec3 to_light;
        double factor = 0;
        double distance = 0;  // local units
    };
    [[nodiscard]] Sight look(
        const Stream& stream,
        std::uint64_t point,
        std::uint32_t dimension,
        const Vec3& place) const {
        double u0 = 0;
        double u1 = 0;
        if (light_dimensions_ > 0) {
            u0 = number(stream, point, dimension);
            u1 = number(stream, point, dimension + 1);
        }
        const Light& light = stage_.lights()[stage_.pick_light(u0)];
        u0 = std::clamp((u0 - light.before) / light.probability, 0.0, 1.0);
        const Illumination seen = light.source->illuminate(stage_.to_world(place), u0, u1);
        return {
            &light, seen.to_light, seen.weight * scale_of(light),
            seen.distance * stage_.caster().mesh().scale};
    }

    /// Irradiance of spectrum 1 in cell units, over the probability of the light.
    [[nodiscard]] double scale_of(const Light& light) const {
        return kGain * reference_area_ / (light.emitter->flux() * stage_.world_area());
    }

    std::uint64_t trace_point(
        const Stream& stream,
        std::uint64_t organ_index,
        std::uint64_t index,
        Workspace& workspace,
        Tally& tally) const {
        const Organ& organ = stage_.scene().organs()[organ_index];
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
        const Sight sight = look(stream, point.index, 2, point.place);
        const double cosine = dot(sight.to_light, point.up);
        if (cosine == 0 || sight.factor == 0 ||
            !stage_.counts(point.element, std::abs(cosine))) {
            return 0;
        }
        if (!stage_.reaches(point.place, sight.to_light, sight.distance, point.triangle)) {
            return 1;
        }
        const TallyLayout& layout = tally.layout();
        tally.add(
            layout.direct(point.element, cosine < 0, sight.light->spectrum),
            to_fixed(sight.factor * std::abs(cosine)));
        if (sight.light->sun_share > 0) {
            tally.add(
                layout.sunlit(point.element),
                to_fixed(kGain * sight.light->sun_share / sight.light->probability));
        }
        return 1;
    }

    /// Light that other surfaces send to the point: a path backwards from it, to one of its two
    /// sides.
    std::uint64_t score_scattered(
        const Stream& stream, const Point& point, Workspace& workspace, Tally& tally) const {
        const std::uint32_t dimension = 2 + light_dimensions_;
        const double side = 2 * number(stream, point.index, dimension);
        const bool lower = side >= 1;
        const Vec3 normal = lower ? -point.up : point.up;
        // Of the square of the sine; less than 1 for sensors with a narrow field of view.
        const double part = 1 - std::pow(stage_.least_cosine(point.element), 2);
        const Vec3 away = cosine_direction(
            normal, part * (lower ? side - 1 : side), number(stream, point.index, dimension + 1));
        std::fill(workspace.weights.begin(), workspace.weights.end(), 1.0);
        std::fill(workspace.gathered.begin(), workspace.gathered.end(), 0.0);
        const std::uint64_t rays = gather(stream, point, away, dimension + 2, workspace);
        for (std::size_t b = 0; b < workspace.fixed.size(); ++b) {
            // pi for the cosine law, 2 for the choice of a side.
            workspace.fixed[b] = to_fixed(2 * std::numbers::pi * part * workspace.gathered[b]);
        }
        tally.add(tally.layout().scattered(point.element, lower), workspace.fixed);
        return rays;
    }

    static Vec3 cosine_direction(const Vec3& normal, double u0, double u1) {
        const Frame frame = frame_about(normal);
        const double radius = std::sqrt(u0);
        const double around = 2 * std::numbers::pi * u1;
        const double height = std::sqrt(std::max(0.0, 1 - u0));
        return radius * std::cos(around) * frame.s + radius * std::sin(around) * frame.t +
               height * normal;
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
            const CastHit at = stage_.caster().cast(place, away, triangle);
            ++rays;
            if (at.end != RayEnd::hit) {
                if (by_delta && at.end == RayEnd::escaped) {
                    add_sky(away, workspace);
                }
                return rays;
            }
            const Surface surface = surface_at(stage_, at.hit, away);
            const Material& material = stage_.material(surface.element);
            place = place_of(stage_, at.hit);
            triangle = surface.triangle;
            if (material.is_transparent()) {
                continue;
            }
            if (is_last) {
                return rays;
            }
            const Sight sight = look(stream, point.index, dimension, place);
            rays += add_light(sight, surface, place, -away, workspace);
            dimension += light_dimensions_;
            const auto from = material.gather(
                surface.normal, surface.upper, -away,
                {number(stream, point.index, dimension), number(stream, point.index, dimension + 1),
                 enough_},
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

    /// What a light sends by the surface along `out`. Returns the rays cast.
    std::uint64_t add_light(
        const Sight& sight,
        const Surface& surface,
        const Vec3& place,
        const Vec3& out,
        Workspace& workspace) const {
        const bool same_side = dot(sight.to_light, surface.normal) > 0;
        const bool arrives_upper = same_side == surface.upper;
        const Material& material = stage_.material(surface.element);
        if (material.side(arrives_upper).lobes().empty() || sight.factor == 0 ||
            !stage_.reaches(place, sight.to_light, sight.distance, surface.triangle)) {
            return 0;
        }
        for (std::size_t b = 0; b < workspace.weights.size(); ++b) {
            workspace.products[b] = workspace.weights[b] * sight.light->start_weights[b];
        }
        material.add_reflected(
            surface.normal, surface.upper, out, -sight.to_light, sight.factor, workspace.products,
            workspace.gathered);
        return 1;
    }

    /// The sky that a mirror shows in direction `to_light`.
    void add_sky(const Vec3& to_light, Workspace& workspace) const {
        for (const Light& light : stage_.lights()) {
            const double radiance = light.is_found_by_chance()
                                        ? light.source->radiance(to_light) * light.probability
                                        : 0;
            for (std::size_t b = 0; radiance > 0 && b < workspace.weights.size(); ++b) {
                workspace.gathered[b] +=
                    workspace.weights[b] * light.start_weights[b] * radiance * scale_of(light);
            }
        }
    }

    /// A light path for what points can't find: light of a sun or a lamp whose first scattering is
    /// in one direction.
    std::uint64_t trace_companion(
        const Stream& stream, std::uint64_t index, Workspace& workspace, Tally& tally) const {
        const double u0 = number(stream, index, 0);
        const Light& light = stage_.lights()[stage_.pick_light(u0)];
        if (light.is_found_by_chance()) {
            return 0;
        }
        const bool is_beam = light.emitter->beam_direction().has_value();
        const std::array<double, 4> u{
            std::clamp((u0 - light.before) / light.probability, 0.0, 0x1.fffffffffffffp-1),
            number(stream, index, 1), is_beam ? 0 : number(stream, index, 2),
            is_beam ? 0 : number(stream, index, 3)};
        const Emission emission = light.emitter->emit(u);
        const PathRules rules{
            &stage_,
            &sampler_,
            stream,
            start_dimensions_,
            spec_.max_depth,
            enough_,
            PathFilter::delta_first,
            companion_scale_};
        const CastHit at = stage_.caster().cast(emission.origin, emission.direction, kNoTriangle);
        return 1 + follow(
                       rules, {&light, index, emission.direction, emission.weight}, at,
                       FirstHit::to_score, workspace, tally);
    }

    const Stage& stage_;
    const Sampler& sampler_;
    const RunSpec& spec_;
    double enough_;
    std::vector<std::uint32_t> measured_;  // organs that points are placed on
    std::uint64_t points_per_organ_ = 1;
    OrganPoints organ_points_;
    std::uint32_t light_dimensions_ = 2;
    std::uint32_t start_dimensions_ = 2;   // of a companion: 2 if all lights are beams
    bool hides_from_mirrors_ = false;      // some light is a sun or a lamp
    std::vector<double> companion_scale_;  // by element: from flux per light path to cell units
    double reference_area_ = 0;
};

}  // namespace

std::unique_ptr<Estimator> make_backward_estimator(
    const Stage& stage, const Sampler& sampler, const RunSpec& spec) {
    return std::make_unique<BackwardEstimator>(stage, sampler, spec);
}

}  // namespace quasimc

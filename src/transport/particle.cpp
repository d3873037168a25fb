#include "transport/particle.h"

#include <algorithm>

#include "base/stop.h"
#include "transport/absorbed_light.h"

namespace quasimc {
namespace {

/// The light of a path as it leaves the source.
void set_start_weights(const Particle& path, std::span<double> weights) {
    for (std::size_t b = 0; b < weights.size(); ++b) {
        weights[b] = path.light->start_weights[b] * path.weight;
    }
}

/// What a surface would have scattered is cut off.
void tally_cut_off(const Side& side, double cosine, std::span<const double> weights, Tally& tally) {
    for (std::size_t b = 0; b < weights.size(); ++b) {
        const std::int64_t fixed = to_fixed(weights[b] * side.albedo(b, cosine));
        tally.add(tally.blocks().scattered_out() + b, fixed);
        tally.add(tally.blocks().cut_off() + b, fixed);
    }
}

/// A light path under way: the physics of light tracing.
///
/// At every hit the light that falls on the side is scored, in all bands; what the organ absorbs
/// follows from it, or is summed (score_absorbed). Then one number decides between the lobes of the
/// material and the end of the path, so that a path lives on with the surface's albedo and carries
/// on with its weight (Side::scatter). Fixed-point copies of the weights are made once for each
/// flight, so that what leaves one surface is, to the last bit, what arrives at the next or
/// escapes.
class ParticleTracer {
  public:
    ParticleTracer(
        const PathRules& rules, const Particle& path, ParticleScratch& scratch, Tally& tally)
        : rules_(rules),
          prepared_(*rules.prepared),
          path_(path),
          direction_(path.direction),
          weights_(scratch.weights),
          fixed_(scratch.fixed),
          vertices_(scratch.vertices),
          tally_(tally) {}

    std::uint64_t trace_all(const CastHit& first_hit, FirstHit first) {
        return trace(first_hit, 0, first == FirstHit::to_score);
    }

    std::uint64_t trace_scattered(const ScatteredRay& from, std::span<const double> weights) {
        std::copy(weights.begin(), weights.end(), weights_.begin());
        direction_ = from.direction;
        score_scattered();
        return 1 + trace(prepared_.caster().cast(from.place, direction_, from.triangle), 1, true);
    }

  private:
    /// Traces light that was scattered `depth` times to all its further hits.
    std::uint64_t trace(const CastHit& first_hit, std::uint32_t depth, bool to_score) {
        std::uint64_t rays = 0;
        CastHit next;
        const CastHit* at = &first_hit;
        for (; at->end == RayEnd::hit; ++rays) {
            if (rules_.stop != nullptr) {
                throw_if_stopped(*rules_.stop);
            }
            const Surface surface = surface_at(prepared_, at->hit, direction_);
            const Material& material = prepared_.material(surface.region);
            const Vec3 place = place_of(prepared_, at->hit);
            if (to_score) {
                score(surface, place);
            }
            to_score = true;
            if (!material.is_transparent()) {
                ++depth;
                if (!scatter(material.side(surface.side), surface, place, depth)) {
                    return rays;
                }
            }
            next = prepared_.caster().cast(place, direction_, surface.triangle);
            at = &next;
        }
        end_path(at->end);
        return rays;
    }

    /// Adds what falls on the surface.
    void score(const Surface& surface, const Vec3& place) {
        const LightBlocks& blocks = tally_.blocks();
        if (!prepared_.in_field_of_view(surface.region, surface.cosine)) {
            return;
        }
        const double share = prepared_.exact_share(surface.triangle, direction_, surface.cosine);
        if (share != 1) [[unlikely]] {
            let_pass(surface, 1 - share);
        }
        if (!direct_) {
            if (is_looked_for(surface.region, place)) {
                return;
            }
            const std::size_t bins = blocks.scattered(surface.region, surface.side);
            const double scale = share * scale_of(surface.region);
            scale == 1 ? tally_.add(bins, fixed_) : add_weights(bins, scale);
            score_absorbed(
                prepared_,
                {surface.region, surface.side, surface.cosine, LightPart::scattered, scale,
                 weights_},
                tally_);
            return;
        }
        if (rules_.filter == PathFilter::left_out &&
            !rules_.near->lights_near(*path_.light, surface.region, place)) {
            return;
        }
        const double amount = share * path_.weight * scale_of(surface.region);
        tally_.add(
            blocks.direct(surface.region, surface.side, path_.light->spectrum), to_fixed(amount));
        score_absorbed(
            prepared_,
            {surface.region, surface.side, surface.cosine, LightPart::direct, amount,
             path_.light->start_weights},
            tally_);
        if (path_.light->lit_area > 0 && surface.cosine > 0 &&
            prepared_.is_sunlit(surface.triangle, direction_, surface.cosine)) {
            tally_.add(
                blocks.sunlit(surface.region),
                to_fixed(
                    prepared_.sunlit_share(surface.triangle) * path_.weight *
                    path_.light->lit_area / surface.cosine));
        }
    }

    /// Of a thin triangle, whose area rounding changes: what does not fall on the triangle as given
    /// goes by, and escapes (a negative part: what misses the rounded one).
    void let_pass(const Surface& surface, double part) {
        if (rules_.filter != PathFilter::all ||
            prepared_.material(surface.region).is_transparent()) {
            return;
        }
        const LightBlocks& blocks = tally_.blocks();
        if (direct_) {
            tally_.add_signed(
                blocks.escaped_direct() + path_.light->spectrum,
                to_fixed(path_.weight) - to_fixed((1 - part) * path_.weight));
            return;
        }
        for (std::size_t b = 0; b < weights_.size(); ++b) {
            tally_.add_signed(
                blocks.escaped_scattered() + b, fixed_[b] - to_fixed((1 - part) * weights_[b]));
        }
    }

    /// Draws where the light goes from its `depth`-th hit. False if it goes nowhere.
    bool scatter(const Side& side, const Surface& surface, const Vec3& place, std::uint32_t depth) {
        if (direct_) {
            set_start_weights(path_, weights_);
        }
        if (depth == rules_.max_depth) {
            cut_off(side, surface.cosine);
            return false;
        }
        const std::uint32_t dimension = rules_.scatter_dimension + 2 * (depth - 1);
        const bool is_parted =
            rules_.filter == PathFilter::left_out && (direct_ || is_from_vertex_);
        const bool is_near = is_parted && scatters_near(place);
        const bool only_sharp = is_parted && !is_near && (direct_ || !rules_.has_others);
        if (only_sharp && side.sharpest_peak() < rules_.sharp_from) {
            return false;
        }
        const bool is_vertex = is_near && !rules_.connected.empty();
        if (is_vertex) {
            vertices_.add({path_.light, place, surface, direction_, depth}, weights_);
        }
        const Draw draw{
            rules_.sampler->coordinate(rules_.stream, path_.point, dimension), 0,
            rules_.roulette_threshold};
        const LobeTable::Choice choice = side.choose(surface.normal, direction_, draw, weights_);
        const bool is_sharp = choice.row != nullptr && choice.row->peak >= rules_.sharp_from;
        if (choice.row == nullptr || (only_sharp && !is_sharp)) {
            return false;
        }
        const bool is_alone = only_sharp || is_vertex || is_from_vertex_;
        is_connected_ = is_connected_ || (is_from_vertex_ && !is_near && !is_sharp);
        is_from_vertex_ = is_vertex && !is_sharp;
        vertex_ = place;
        const double u1 = rules_.sampler->coordinate(rules_.stream, path_.point, dimension + 1);
        direction_ =
            (is_alone ? side.scatter_by_alone(choice, surface.normal, direction_, u1, weights_)
                      : side.scatter_by(choice, surface.normal, direction_, u1, weights_))
                .wo;
        score_scattered();
        return true;
    }

    /// Whether light that comes straight from its lamp, or the last vertex, falls near that.
    [[nodiscard]] bool scatters_near(const Vec3& place) const {
        return direct_ ? rules_.near->scatters_near(*path_.light, place)
                       : length(place - vertex_) < rules_.near->leg(*path_.light);
    }

    /// Whether points of a region find scattered light that comes to a place of it like this.
    [[nodiscard]] bool is_looked_for(std::uint32_t region, const Vec3& place) const {
        return (is_connected_ || (is_from_vertex_ && !scatters_near(place))) &&
               rules_.connected[region] != 0;
    }

    /// Scattered light leaves a surface.
    void score_scattered() {
        direct_ = false;
        for (std::size_t b = 0; b < weights_.size(); ++b) {
            fixed_[b] = to_fixed(weights_[b]);
        }
        if (rules_.filter == PathFilter::all) {
            tally_.add(tally_.blocks().scattered_out(), fixed_);
        }
    }

    /// Ends the path at the user's limit.
    void cut_off(const Side& side, double cosine) {
        if (rules_.filter == PathFilter::all) {
            tally_cut_off(side, cosine, weights_, tally_);
        }
    }

    /// The path has left the scene, or is lost between the layers of a periodic one.
    void end_path(RayEnd end) {
        const LightBlocks& blocks = tally_.blocks();
        if (rules_.filter == PathFilter::left_out) {
            return;
        }
        if (!direct_) {
            if (end == RayEnd::lost) {
                tally_.add(blocks.cut_off(), fixed_);
                return;
            }
            tally_.add(blocks.escaped_scattered(), fixed_);
            tell_detectors();
        } else if (end == RayEnd::escaped) {
            tally_.add(blocks.escaped_direct() + path_.light->spectrum, to_fixed(path_.weight));
        } else {
            set_start_weights(path_, weights_);
            add_weights(blocks.cut_off(), 1);
        }
    }

    /// Scattered light has escaped.
    void tell_detectors() {
        const auto& detectors = prepared_.detectors();
        for (std::size_t i = 0; i < detectors.size(); ++i) {
            detectors[i]->on_escape(direction_, fixed_, tally_.blocks().detector(i), tally_);
        }
    }

    [[nodiscard]] double scale_of(std::uint32_t region) const {
        return rules_.scales.empty() ? 1 : rules_.scales[region];
    }

    void add_weights(std::size_t cells, double factor) {
        for (std::size_t b = 0; b < weights_.size(); ++b) {
            tally_.add(cells + b, to_fixed(weights_[b] * factor));
        }
    }

    const PathRules& rules_;
    const PreparedScene& prepared_;
    const Particle& path_;
    Vec3 direction_;
    std::span<double> weights_;
    std::span<std::int64_t> fixed_;
    LightVertices& vertices_;
    Tally& tally_;
    bool direct_ = true;
    bool is_from_vertex_ = false;  // from the last place of scattering, by no sharp lobe
    bool is_connected_ = false;    // has gone a way that is looked for, and on by no sharp lobe
    Vec3 vertex_;                  // the last place of scattering
};

}  // namespace

std::uint64_t trace_particle(
    const PathRules& rules,
    const Particle& path,
    const CastHit& at,
    FirstHit first,
    ParticleScratch& scratch,
    Tally& tally) {
    return ParticleTracer(rules, path, scratch, tally).trace_all(at, first);
}

std::optional<Vec3> scatter_first(
    const PathRules& rules,
    const Particle& path,
    const Surface& surface,
    const std::array<double, 2>& numbers,
    std::span<double> weights,
    Tally& tally) {
    const Side& side = rules.prepared->material(surface.region).side(surface.side);
    set_start_weights(path, weights);
    if (rules.max_depth == 1) {
        tally_cut_off(side, surface.cosine, weights, tally);
        return std::nullopt;
    }
    const auto scattered =
        side.scatter(surface.normal, path.direction, {numbers[0], numbers[1], 0}, weights);
    return scattered ? std::optional(scattered->wo) : std::nullopt;
}

std::uint64_t trace_scattered(
    const PathRules& rules,
    const Particle& path,
    const ScatteredRay& from,
    std::span<const double> weights,
    ParticleScratch& scratch,
    Tally& tally) {
    return ParticleTracer(rules, path, scratch, tally).trace_scattered(from, weights);
}

}  // namespace quasimc

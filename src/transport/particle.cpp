#include "transport/particle.h"

#include <algorithm>

#include "transport/scatter.h"
#include "transport/score.h"

namespace quasimc {
namespace {

/// Traces one light path: the physics of light tracing.
///
/// At every hit the incident light is scored, in all bands; absorbed light follows from it, or is
/// summed as well (score_absorbed). Then one random number chooses a lobe of the material or the
/// end of the path, so that a path survives with the probability of the surface's albedo and keeps
/// its weight (Side::scatter). Fixed-point copies of the weights are made once for each flight, so
/// that the light that leaves one surface arrives at the next, or escapes, to the last bit.
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
          tally_(tally) {}

    /// Traces light that was scattered `depth` times from its next hit, or its escape, to its end.
    std::uint64_t trace(const CastHit& first_hit, std::uint32_t depth, FirstHit first) {
        std::uint64_t rays = 0;
        CastHit next;
        const CastHit* at = &first_hit;
        for (; at->end == RayEnd::hit; ++rays) {
            throw_if_stopped(rules_);
            const Surface surface = surface_at(prepared_, at->hit, direction_);
            const Material& material = prepared_.material(surface.region);
            if (first == FirstHit::to_score || rays > 0) {
                score(surface);
            }
            if (!material.is_transparent() &&
                !scatter(material.side(surface.side), surface, ++depth)) {
                return rays;
            }
            next =
                prepared_.caster().cast(point_of(prepared_, at->hit), direction_, surface.triangle);
            at = &next;
        }
        score_end(at->end);
        return rays;
    }

    std::uint64_t trace_scattered(const ScatteredRay& from, std::span<const double> weights) {
        std::copy(weights.begin(), weights.end(), weights_.begin());
        direction_ = from.direction;
        leave_surface();
        const CastHit at = prepared_.caster().cast(from.p, direction_, from.triangle);
        return 1 + trace(at, 1, FirstHit::to_score);
    }

  private:
    /// Adds the light on the surface.
    void score(const Surface& surface) {
        if (!prepared_.fields_of_view().contain(surface.region, surface.cosine)) {
            return;
        }
        const double share =
            prepared_.rounding().light_share(surface.triangle, direction_, surface.cosine);
        if (share != 1) [[unlikely]] {
            score_sliver_miss(surface, 1 - share);
        }
        if (direct_) {
            score_direct(prepared_, surface, *path_.light, share * path_.weight, tally_);
            score_sunlit(surface);
        } else {
            score_scattered(prepared_, surface, path_.light->origin, share, weights_, tally_);
        }
    }

    /// Adds the area that the sun of the path lights.
    void score_sunlit(const Surface& surface) {
        if (path_.light->lit_area > 0 && surface.cosine > 0 &&
            prepared_.rounding().is_sunlit(surface.triangle, direction_, surface.cosine)) {
            tally_.add_sunlit(
                surface.region, surface.side,
                to_fixed(
                    prepared_.rounding().area_share(surface.triangle) * path_.weight *
                    path_.light->lit_area / surface.cosine));
        }
    }

    /// Adds the fraction of the light that meets a sliver with rounded corners but misses the given
    /// one: it escapes. A negative fraction meets the given triangle only.
    void score_sliver_miss(const Surface& surface, double part) {
        if (prepared_.material(surface.region).is_transparent()) {
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
                blocks.escaped_scattered(path_.light->origin) + b,
                fixed_[b] - to_fixed((1 - part) * weights_[b]));
        }
    }

    /// Samples the direction after the `depth`-th hit. False if the path ends there.
    bool scatter(const Side& side, const Surface& surface, std::uint32_t depth) {
        if (direct_) {
            set_start_weights(path_, weights_);
        }
        if (depth == rules_.max_depth) {
            score_cut_off(side, surface.cosine, path_.light->origin, weights_, tally_);
            return false;
        }
        const double u = scatter_number(rules_, path_, depth, ScatterNumber::lobe);
        const LobeTable::Choice lobe =
            side.choose(surface.normal, direction_, {u, 0, rules_.roulette_threshold}, weights_);
        if (lobe.row == nullptr) {
            return false;
        }
        const double u1 = scatter_number(rules_, path_, depth, ScatterNumber::azimuth);
        direction_ = side.scatter_by(lobe, surface.normal, direction_, u1, weights_).wo;
        leave_surface();
        return true;
    }

    /// Adds scattered light that leaves a surface.
    void leave_surface() {
        direct_ = false;
        for (std::size_t b = 0; b < weights_.size(); ++b) {
            fixed_[b] = to_fixed(weights_[b]);
        }
        tally_.add(tally_.blocks().scattered_out(path_.light->origin), fixed_);
    }

    /// Adds light that has left the scene, or is lost between the layers of a periodic one.
    void score_end(RayEnd end) {
        const LightBlocks& blocks = tally_.blocks();
        const std::size_t origin = path_.light->origin;
        if (direct_ && end == RayEnd::escaped) {
            tally_.add(blocks.escaped_direct() + path_.light->spectrum, to_fixed(path_.weight));
        } else if (direct_) {
            set_start_weights(path_, weights_);
            for (std::size_t b = 0; b < weights_.size(); ++b) {
                tally_.add(blocks.cut_off(origin) + b, to_fixed(weights_[b]));
            }
        } else if (end == RayEnd::escaped) {
            tally_.add(blocks.escaped_scattered(origin), fixed_);
            score_detectors();
        } else {
            tally_.add(blocks.cut_off(origin), fixed_);
        }
    }

    void score_detectors() {
        const auto& detectors = prepared_.detectors();
        for (std::size_t i = 0; i < detectors.size(); ++i) {
            detectors[i]->on_escape(
                direction_, fixed_, tally_.blocks().detector(i, path_.light->origin), tally_);
        }
    }

    const PathRules& rules_;
    const PreparedScene& prepared_;
    const Particle& path_;
    Vec3 direction_;
    std::span<double> weights_;
    std::span<std::int64_t> fixed_;
    Tally& tally_;
    bool direct_ = true;
};

}  // namespace

std::uint64_t trace_particle(
    const PathRules& rules,
    const Particle& path,
    const CastHit& at,
    FirstHit first,
    ParticleScratch& scratch,
    Tally& tally) {
    return ParticleTracer(rules, path, scratch, tally).trace(at, 0, first);
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

#include "solvers/from_organs/light_subpath.h"

#include <algorithm>

#include "solvers/from_organs/path_class.h"
#include "transport/particle.h"
#include "transport/scatter.h"
#include "transport/score.h"

namespace quasimc {
namespace {

/// Traces one light subpath, as in light tracing, but scores only the light of some classes. Where
/// points sample the incident light, the path continues by narrow lobes only.
class LightSubpathTracer {
  public:
    LightSubpathTracer(
        const PathRules& walk,
        const LightSubpaths::Rules& rules,
        const Particle& path,
        LightSubpathScratch& scratch,
        Tally& tally)
        : walk_(walk),
          rules_(rules),
          prepared_(*walk.prepared),
          path_(path),
          direction_(path.direction),
          weights_(scratch.weights),
          vertices_(scratch.vertices),
          tally_(tally) {}

    std::uint64_t trace(CastHit at) {
        std::uint64_t rays = 0;
        for (std::uint32_t depth = 0; at.end == RayEnd::hit; ++rays) {
            throw_if_stopped(walk_);
            const Surface surface = surface_at(prepared_, at.hit, direction_);
            const Material& material = prepared_.material(surface.region);
            const Vec3 p = point_of(prepared_, at.hit);
            if (counts_on(surface, p)) {
                score(surface);
            }
            if (!material.is_transparent() &&
                !scatter(material.side(surface.side), surface, p, ++depth)) {
                return rays;
            }
            at = prepared_.caster().cast(p, direction_, surface.triangle);
        }
        return rays;
    }

  private:
    /// Whether no points sample the light that arrives at `p` on a surface.
    [[nodiscard]] bool counts_on(const Surface& surface, const Vec3& p) const {
        if (!prepared_.fields_of_view().contain(surface.region, surface.cosine)) {
            return false;
        }
        switch (class_) {
            case PathClass::from_source:
                return rules_.near.lights_near(*path_.light, surface.region, p);
            case PathClass::from_light_vertex:
                return rules_.connected[surface.region] == 0 || is_near(p);
            case PathClass::connected:
                return rules_.connected[surface.region] == 0;
            case PathClass::sampled_from_source:
                return true;
        }
        return true;
    }

    /// Whether light from its source, or its last light vertex, is scattered so near that at `p`
    /// points do not sample it.
    [[nodiscard]] bool is_near(const Vec3& p) const {
        return class_ == PathClass::from_source
                   ? rules_.near.scatters_near(*path_.light, p)
                   : length(p - vertex_) < rules_.near.min_connection_distance(*path_.light);
    }

    void score(const Surface& surface) {
        const double factor =
            prepared_.rounding().light_share(surface.triangle, direction_, surface.cosine) *
            (class_ == PathClass::from_source ? path_.weight : 1) * rules_.scales[surface.region];
        class_ == PathClass::from_source
            ? score_direct(prepared_, surface, *path_.light, factor, tally_)
            : score_scattered(prepared_, surface, path_.light->origin, factor, weights_, tally_);
    }

    /// Samples the direction after the `depth`-th hit. False if none of the light beyond counts.
    bool scatter(const Side& side, const Surface& surface, const Vec3& p, std::uint32_t depth) {
        if (class_ == PathClass::from_source) {
            set_start_weights(path_, weights_);
        }
        if (depth == walk_.max_depth) {
            return false;
        }
        const bool is_near_field = meets_points(class_) && is_near(p);
        const bool is_vertex = is_near_field && !rules_.connected.empty();
        const bool only_by_narrow = goes_on_by_narrow_alone(is_near_field);
        if (only_by_narrow && side.largest_peak() < rules_.narrow_from) {
            return false;
        }
        if (is_vertex) {
            vertices_.add({path_.light, p, surface, direction_, depth}, weights_);
        }
        const double u = scatter_number(walk_, path_, depth, ScatterNumber::lobe);
        const LobeTable::Choice lobe =
            side.choose(surface.normal, direction_, {u, 0, walk_.roulette_threshold}, weights_);
        const bool is_narrow = lobe.row != nullptr && lobe.row->peak >= rules_.narrow_from;
        if (lobe.row == nullptr || (only_by_narrow && !is_narrow)) {
            return false;
        }
        // If the lobe decides the class, its light is not weighted with that of other lobes.
        const bool by_lobe_alone =
            only_by_narrow || is_vertex || class_ == PathClass::from_light_vertex;
        const double u1 = scatter_number(walk_, path_, depth, ScatterNumber::azimuth);
        direction_ =
            (by_lobe_alone ? side.scatter_by_alone(lobe, surface.normal, direction_, u1, weights_)
                           : side.scatter_by(lobe, surface.normal, direction_, u1, weights_))
                .wo;
        class_ = class_after(is_near_field, is_narrow);
        vertex_ = p;
        return true;
    }

    /// Whether points sample all counted light that broad lobes scatter from here.
    [[nodiscard]] bool goes_on_by_narrow_alone(bool is_near_field) const {
        return !is_near_field &&
               (class_ == PathClass::from_source ||
                (class_ == PathClass::from_light_vertex && !rules_.has_unconnected));
    }

    /// The class of the light after a surface that scatters it.
    [[nodiscard]] PathClass class_after(bool is_near_field, bool is_narrow) const {
        if (!meets_points(class_)) {
            return class_;
        }
        if (is_narrow || rules_.connected.empty()) {
            return PathClass::sampled_from_source;
        }
        return is_near_field ? PathClass::from_light_vertex : PathClass::connected;
    }

    const PathRules& walk_;
    const LightSubpaths::Rules& rules_;
    const PreparedScene& prepared_;
    const Particle& path_;
    Vec3 direction_;
    std::span<double> weights_;
    LightVertices& vertices_;
    Tally& tally_;
    PathClass class_ = PathClass::from_source;
    Vec3 vertex_;  // the last hit that scattered the light
};

LightSubpaths::Rules rules_of(
    const PreparedScene& prepared,
    const MeasuredArea& measured,
    const LampNearField& near,
    double narrow_from) {
    const Scene& scene = prepared.scene();
    LightSubpaths::Rules rules{
        near, narrow_from, parts_of_unit(prepared, measured, near), {}, true};
    for (std::size_t i = 0; i < scene.regions().size(); ++i) {
        const double own = scene.organs()[scene.regions()[i].organ.value].area;
        rules.scales[i] *= units_of_light_path(measured, own);
    }
    if (near.any()) {
        rules.connected = connected_regions(prepared, parts_by_vertices(prepared, measured, near));
    }
    rules.has_unconnected =
        std::find(rules.connected.begin(), rules.connected.end(), 0) != rules.connected.end();
    return rules;
}

/// Random numbers that start a subpath.
std::uint32_t start_dimensions(const PreparedScene& prepared) {
    const auto& lights = prepared.lights();
    const bool only_beams = std::all_of(lights.begin(), lights.end(), [](const BoundSource& light) {
        return light.is_extended() || light.source_sampler->beam_direction();
    });
    return only_beams ? 2 : 4;
}

}  // namespace

LightSubpaths::LightSubpaths(
    const SolverInput& input,
    const MeasuredArea& measured,
    const LampNearField& near,
    double narrow_from)
    : prepared_(input.prepared),
      sampler_(input.sampler),
      stop_(input.stop),
      max_depth_(input.spec.max_depth),
      roulette_threshold_(roulette_threshold(input)),
      rules_(rules_of(input.prepared, measured, near, narrow_from)),
      any_(needs_light_paths(input.prepared, near)),
      start_dimensions_(start_dimensions(input.prepared)) {}

std::uint64_t LightSubpaths::trace(
    const Stream& stream, std::uint64_t index, LightSubpathScratch& scratch, Tally& tally) const {
    scratch.vertices.clear();
    const auto u = [&](std::uint32_t dimension) {
        return sampler_.coordinate(stream, index, dimension);
    };
    const LightPick pick = prepared_.lights().pick(u(0));
    const BoundSource& light = prepared_.lights()[pick.index];
    if (light.is_extended()) {
        return 0;
    }
    const bool is_beam = light.source_sampler->beam_direction().has_value();
    const Emission emission =
        light.source_sampler->emit({pick.u, u(1), is_beam ? 0 : u(2), is_beam ? 0 : u(3)});
    const PathRules walk{
        .prepared = &prepared_,
        .sampler = &sampler_,
        .stream = stream,
        .scatter_dimension = start_dimensions_,
        .max_depth = max_depth_,
        .roulette_threshold = roulette_threshold_,
        .stop = &stop_};
    const Particle path{&light, index, emission.direction, emission.weight};
    return 1 + LightSubpathTracer(walk, rules_, path, scratch, tally)
                   .trace(cast_from_source(prepared_, light, emission));
}

}  // namespace quasimc

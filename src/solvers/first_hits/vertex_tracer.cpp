#include "solvers/first_hits/vertex_tracer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "transport/scatter.h"

namespace quasimc {
namespace {

class VertexTracer {
  public:
    VertexTracer(
        const PathRules& rules,
        std::span<const SurfaceBeam> beams,
        std::span<const PathVertex> vertices,
        VertexScratch& scratch,
        Tally& tally)
        : rules_(rules),
          prepared_(*rules.prepared),
          beams_(beams),
          vertices_(vertices),
          scratch_(scratch),
          tally_(tally) {
        rules_.stream.count = std::bit_ceil(vertices.size() + 1);
        // A subset of a lattice must be spread over all of it. Its first coordinate grows with the
        // index and is not used: a surface would scatter all its light in one direction.
        is_spread_ = rules_.sampler->needs_power_of_two();
        rules_.scatter_dimension = is_spread_ ? 1 : 0;
    }

    /// Returns the rays cast.
    std::uint64_t trace() {
        order_by_position(vertices_, prepared_.caster().mesh().triangle_count(), scratch_.order);
        // Batches that fit into the cache.
        constexpr std::size_t kMaxAtOnce = 512, kWeightsAtOnce = 8192;
        const std::size_t at_once =
            std::clamp<std::size_t>(kWeightsAtOnce / prepared_.bands(), 1, kMaxAtOnce);
        std::uint64_t rays = 0;
        for (std::size_t first = 0; first < vertices_.size(); first += at_once) {
            throw_if_stopped(rules_);
            scatter_batch(first, std::min(first + at_once, vertices_.size()));
            for (std::size_t i = 0; i < scratch_.rays.size(); ++i) {
                const ScatteredRay& ray = scratch_.rays[i];
                rays += trace_scattered(
                    rules_, path_of(ray.vertex), ray, weights_of(i), scratch_.particle, tally_);
            }
        }
        return rays;
    }

  private:
    /// The path from vertex `i`, in order.
    [[nodiscard]] Particle path_of(std::size_t i) const {
        const PathVertex& vertex = vertices_[scratch_.order.order[i]];
        const SurfaceBeam& beam = beams_[vertex.beam];
        const std::uint64_t index = is_spread_ ? i * rules_.stream.count / vertices_.size() : i;
        return {beam.light, rules_.stream.first + index, beam.direction, vertex.weight};
    }

    /// The weights of a ray of the batch, per band.
    [[nodiscard]] std::span<double> weights_of(std::size_t ray) {
        return std::span(scratch_.ray_weights).subspan(ray * prepared_.bands(), prepared_.bands());
    }

    /// Scatters at some vertices, one right after the other, before any ray is traced: arithmetic
    /// that does not wait for rays overlaps in the processor.
    void scatter_batch(std::size_t first, std::size_t end) {
        const LocalMesh& mesh = prepared_.caster().mesh();
        scratch_.rays.clear();
        scratch_.ray_weights.resize((end - first) * prepared_.bands());
        draw_numbers(first, end);
        Surface at;
        Vec3 up;
        for (std::size_t i = first; i < end; ++i) {
            const PathVertex& vertex = vertices_[scratch_.order.order[i]];
            if (vertex.triangle != at.triangle) {
                at.triangle = vertex.triangle;
                at.region = prepared_.region(vertex.triangle);
                up = normalized(mesh.across(vertex.triangle));
            }
            const Particle path = path_of(i);
            const double along = dot(up, path.direction);
            at.side = side_facing(along);
            at.cosine = std::abs(along);
            at.normal = at.side == SurfaceSide::upper ? up : -up;
            const Draw draw{scratch_.u0[i - first], scratch_.u1[i - first], 0};
            const auto scattered = scatter(path, at, draw, weights_of(scratch_.rays.size()));
            if (scattered) {
                scratch_.rays.push_back(
                    {mesh.point(at.triangle, vertex.u, vertex.v), scattered->wo, at.triangle, i});
            }
        }
    }

    /// Scatters the light of a path at its first vertex. Light that is absorbed there starts no
    /// path: with a roulette threshold of 0 the path always survives, with a reduced weight.
    /// @param weights  of the scattered light, per band
    std::optional<Side::Scattered> scatter(
        const Particle& path, const Surface& at, const Draw& draw, std::span<double> weights) {
        const Side& side = prepared_.material(at.region).side(at.side);
        set_start_weights(path, weights);
        if (rules_.max_depth == 1) {
            score_cut_off(side, at.cosine, path.light->origin, weights, tally_);
            return std::nullopt;
        }
        return side.scatter(at.normal, path.direction, draw, weights);
    }

    void draw_numbers(std::size_t first, std::size_t end) {
        const std::size_t count = end - first;
        scratch_.u0.resize(count);
        scratch_.u1.resize(count);
        const Sampler& sampler = *rules_.sampler;
        const std::uint32_t dimension = rules_.scatter_dimension;
        if (!is_spread_) {
            const std::uint64_t point = rules_.stream.first + first;
            sampler.coordinates(rules_.stream, point, dimension, scratch_.u0);
            sampler.coordinates(rules_.stream, point, dimension + 1, scratch_.u1);
            return;
        }
        for (std::size_t k = 0; k < count; ++k) {
            const std::uint64_t point = path_of(first + k).point;
            scratch_.u0[k] = sampler.coordinate(rules_.stream, point, dimension);
            scratch_.u1[k] = sampler.coordinate(rules_.stream, point, dimension + 1);
        }
    }

    PathRules rules_;
    const PreparedScene& prepared_;
    std::span<const SurfaceBeam> beams_;
    std::span<const PathVertex> vertices_;
    VertexScratch& scratch_;
    Tally& tally_;
    bool is_spread_ = false;  // points over all of the set
};

}  // namespace

void trace_from_vertices(
    PathRules rules,
    std::span<const SurfaceBeam> beams,
    std::span<const PathVertex> vertices,
    VertexScratch& scratch,
    Tally& tally) {
    const std::uint64_t rays = VertexTracer(rules, beams, vertices, scratch, tally).trace();
    tally.count(WorkUnit::ray, rays);
}

}  // namespace quasimc

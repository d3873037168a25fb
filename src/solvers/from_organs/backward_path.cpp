#include "solvers/from_organs/backward_path.h"

#include <algorithm>

#include "base/stop.h"

namespace quasimc {

BackwardPaths::BackwardPaths(
    const SolverInput& input,
    const NextEvent& next_event,
    const VertexLight& vertex_light,
    const LampNearField& near,
    double narrow_from)
    : prepared_(input.prepared),
      sampler_(input.sampler),
      next_event_(next_event),
      vertex_light_(vertex_light),
      near_(near),
      stop_(input.stop),
      max_depth_(input.spec.max_depth),
      roulette_threshold_(roulette_threshold(input)),
      narrow_from_(narrow_from) {}

std::uint64_t BackwardPaths::gather(
    PathNumbers numbers,
    const OrganPoint& point,
    Vec3 away,
    const LightVertices& vertices,
    GatherScratch& path) const {
    auto& [stream, index, dimension] = numbers;
    std::fill(path.weights.begin(), path.weights.end(), 1.0);
    path.clear_gathered(prepared_.lights().origin_count());
    Vec3 p = point.p;
    std::uint32_t triangle = point.triangle;
    bool by_narrow = false;
    std::uint64_t rays = 0;
    for (std::uint32_t depth = 1;;) {
        throw_if_stopped(stop_);
        // Beyond the last hit only the sky counts, through a narrow lobe.
        const bool is_last = depth == max_depth_;
        if (is_last && !by_narrow) {
            return rays;
        }
        const CastHit at = prepared_.caster().cast(p, away, triangle);
        ++rays;
        if (at.end != RayEnd::hit) {
            if (by_narrow && at.end == RayEnd::escaped) {
                next_event_.add_sky(away, path);
            }
            return rays;
        }
        const Surface surface = surface_at(prepared_, at.hit, away);
        const Material& material = prepared_.material(surface.region);
        p = point_of(prepared_, at.hit);
        triangle = surface.triangle;
        if (material.is_transparent()) {
            continue;
        }
        if (is_last) {
            return rays;
        }
        const LightSample light = next_event_.sample_light(stream, index, dimension, p);
        rays += next_event_.add_light(light, surface, p, -away, path);
        rays += add_vertices(vertices, surface, p, -away, depth, path);
        dimension += next_event_.dimensions();
        const auto from = material.gather(
            surface.normal, surface.side, -away,
            {sampler_.coordinate(stream, index, dimension),
             sampler_.coordinate(stream, index, dimension + 1), roulette_threshold_},
            path.weights);
        if (!from) {
            return rays;
        }
        dimension += 2;
        ++depth;
        by_narrow = from->narrow;
        away = -from->wi;
    }
}

/// Adds to path.gathered the light of connected light vertices that a surface scatters along `out`.
/// Returns the rays cast.
/// @param depth  hits of the backward path, including this one
std::uint64_t BackwardPaths::add_vertices(
    const LightVertices& vertices,
    const Surface& surface,
    const Vec3& p,
    const Vec3& out,
    std::uint32_t depth,
    GatherScratch& path) const {
    std::uint64_t rays = 0;
    for (std::size_t i = 0; i < vertices.all().size(); ++i) {
        const LightVertex& vertex = vertices.all()[i];
        if (max_depth_ > 0 && vertex.depth + depth >= max_depth_) {
            continue;
        }
        const auto [wi, is_traced, arrives] = vertex_light_.connect(
            vertex, vertices.weights(i), p, surface.triangle,
            near_.min_connection_distance(*vertex.light), path.irradiance);
        rays += is_traced ? 1 : 0;
        for (std::size_t b = 0; b < path.products.size(); ++b) {
            path.products[b] = path.weights[b] * path.irradiance[b];
        }
        if (arrives) {
            prepared_.material(surface.region)
                .add_reflected(
                    surface.normal, surface.side, out, wi, 1, path.products,
                    path.gathered_from(vertex.light->origin), narrow_from_);
        }
    }
    return rays;
}

}  // namespace quasimc

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solvers/direct/path_vertices.h"
#include "transport/particle.h"

namespace quasimc {

/// Memory of a worker, reused between calls of trace_from_vertices().
struct VertexScratch {
    explicit VertexScratch(std::size_t bands) : particle(bands) {}
    VertexOrder order;
    std::vector<double> u0, u1;       // random numbers of a batch
    std::vector<ScatteredRay> rays;   // of a batch
    std::vector<double> ray_weights;  // per band of each
    ParticleScratch particle;
};

/// Traces paths from their first vertices, surface after surface, so that the directions in which
/// one scatters are neighbours in the point set. Scores all but the direct light, and counts the
/// rays.
/// @param rules  stream and limits; the number of points and the dimensions are set here
void trace_from_vertices(
    PathRules rules,
    std::span<const SurfaceBeam> beams,
    std::span<const PathVertex> vertices,
    VertexScratch& scratch,
    Tally& tally);

}  // namespace quasimc

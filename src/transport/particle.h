#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "base/parallel.h"
#include "samplers/sampler.h"
#include "sums/tally.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// Settings shared by all light paths of a block.
struct PathRules {
    const PreparedScene* prepared = nullptr;
    const Sampler* sampler = nullptr;
    Stream stream;
    std::uint32_t scatter_dimension = 0;  ///< at the first hit; two more for each further hit
    std::uint32_t max_depth = 0;          ///< hits; 0: no limit
    double roulette_threshold = 1;        ///< Draw::roulette_threshold
    /// Checked at every hit, as paths in a closed box that absorbs nothing do not end.
    const std::stop_token* stop = nullptr;
};

/// The light of one path, from its start at a source to its end. The weight of band b is
/// start_weights[b] of its source at first and changes at every scattering.
struct Particle {
    const BoundSource* light = nullptr;
    std::uint64_t point = 0;  ///< index in the point set that gives its random numbers
    Vec3 direction;
    double weight = 1;  ///< Emission::weight
};

/// Light that was scattered at a surface and has not met the next one.
struct ScatteredRay {
    Vec3 p, direction;
    std::uint32_t triangle = 0;  ///< where it was scattered
    std::size_t vertex = 0;      ///< number of its path in the block
};

/// Weights of the current path. Each worker reuses them, so that tracing allocates nothing.
struct ParticleScratch {
    explicit ParticleScratch(std::size_t bands) {
        resize_apart(weights, bands);
        resize_apart(fixed, bands);
    }
    std::vector<double> weights;      // per band
    std::vector<std::int64_t> fixed;  // the same in fixed point
};

/// Whether a path's first hit has been scored.
enum class FirstHit { to_score, scored };

/// Traces a path from `at`, its first hit or its escape, to its end, and scores all hits. Returns
/// the number of rays cast.
/// @throws StopRequested  if rules.stop says so
/// @param first  whether light that came straight from the source is to be scored at `at`
std::uint64_t trace_particle(
    const PathRules& rules,
    const Particle& path,
    const CastHit& at,
    FirstHit first,
    ParticleScratch& scratch,
    Tally& tally);

/// Traces light that was scattered at its first hit, as trace_particle() does.
/// @param weights  of that light, per band
std::uint64_t trace_scattered(
    const PathRules& rules,
    const Particle& path,
    const ScatteredRay& from,
    std::span<const double> weights,
    ParticleScratch& scratch,
    Tally& tally);

}  // namespace quasimc

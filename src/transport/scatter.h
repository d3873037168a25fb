#pragma once

// Interaction of a path with a surface, for all methods.

#include <cstdint>
#include <span>

#include "base/stop.h"
#include "samplers/sampler.h"
#include "sums/tally.h"
#include "transport/particle.h"
#include "transport/surface.h"

namespace quasimc {

/// Sets the light of a path, per band, to that with which it left its source.
inline void set_start_weights(const Particle& path, std::span<double> weights) {
    for (std::size_t b = 0; b < weights.size(); ++b) {
        weights[b] = path.light->start_weights[b] * path.weight;
    }
}

/// The first hit of a path as it leaves its source.
[[nodiscard]] inline CastHit cast_from_source(
    const PreparedScene& prepared, const BoundSource& light, const Emission& start) {
    return light.source->is_lamp()
               ? prepared.caster().cast_from_lamp(start.origin, start.direction)
               : prepared.caster().cast(start.origin, start.direction, kNoTriangle);
}

/// The random numbers that scatter a path at its hit number `depth`, 1 for the first: the first
/// chooses the lobe or the end of the path, and the angle from the lobe's axis, the second the
/// azimuth.
enum class ScatterNumber : std::uint32_t { lobe, azimuth };
[[nodiscard]] inline double scatter_number(
    const PathRules& rules, const Particle& path, std::uint32_t depth, ScatterNumber which) {
    const std::uint32_t first = rules.scatter_dimension + 2 * (depth - 1);
    return rules.sampler->coordinate(
        rules.stream, path.point, first + static_cast<std::uint32_t>(which));
}

/// Adds the light that a side would scatter beyond the largest depth, which is cut off there.
inline void score_cut_off(
    const Side& side,
    double cosine,
    std::size_t origin,
    std::span<const double> weights,
    Tally& tally) {
    for (std::size_t b = 0; b < weights.size(); ++b) {
        const std::int64_t fixed = to_fixed(weights[b] * side.albedo(b, cosine));
        tally.add(tally.blocks().scattered_out(origin) + b, fixed);
        tally.add(tally.blocks().cut_off(origin) + b, fixed);
    }
}

/// Stops a walk at a hit if a stop was requested.
/// @throws StopRequested
inline void throw_if_stopped(const PathRules& rules) {
    if (rules.stop != nullptr) {
        throw_if_stopped(*rules.stop);
    }
}

}  // namespace quasimc

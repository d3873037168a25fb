#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "samplers/sampler.h"
#include "solvers/estimator.h"
#include "sums/tally.h"
#include "transport/prepared_scene.h"
#include "transport/surface.h"

namespace quasimc {

/// Which paths count.
enum class PathFilter {
    all,
    /// Only those whose first scattering is by a lobe of one direction; light straight from the
    /// source is not scored. What tracing from the organs can't find.
    delta_first,
};

/// What all light paths of a block have in common.
struct PathRules {
    const PreparedScene* prepared = nullptr;
    const Sampler* sampler = nullptr;
    Stream stream;
    std::uint32_t scatter_dimension = 0;  ///< of the first hit; two more for each further hit
    std::uint32_t max_depth = 0;          ///< hits; 0: no limit
    double roulette_threshold = 1;        ///< Draw::enough: sum of weights that roulette plays for
    PathFilter filter = PathFilter::all;
    std::span<const double> scales = {};  ///< factor on what each element scores; empty: 1
};

/// The light of one path, from its start at a source to its end. The weight of band b is
/// start_weights[b] of its light at first and changes at every scattering.
struct Particle {
    const BoundSource* light = nullptr;
    std::uint64_t point = 0;
    Vec3 direction;
    double weight = 1;  ///< Emission::weight
};

/// What of a path's first hit is still to be done.
enum class FirstHit { to_score, scored };

/// Scores `at`, the first hit of `path` or its escape, and all that follow. Returns the number of
/// rays cast.
/// @param first   whether light that came straight from the source is to be scored at `at`
std::uint64_t follow(
    const PathRules& rules,
    const Particle& path,
    const CastHit& at,
    FirstHit first,
    Workspace& workspace,
    Tally& tally);

/// Lets the light of `path` go on from its first hit, which was scored and for which roulette was
/// played: it is sure to be scattered, and weighted down.
/// @param surface  where that is; its cosine does not matter
/// @param numbers  that decide how: the first two of path.point
/// @param weights  the light that goes on, or with max_depth 1 is cut off, per band
/// @return its direction; none if it goes nowhere
[[nodiscard]] std::optional<Vec3> depart(
    const PathRules& rules,
    const Particle& path,
    const Surface& surface,
    const std::array<double, 2>& numbers,
    std::span<double> weights,
    Tally& tally);

/// Follows light that has departed, as follow() does.
std::uint64_t follow_on(
    const PathRules& rules,
    const Particle& path,
    const ScatteredRay& from,
    std::span<const double> weights,
    Workspace& workspace,
    Tally& tally);

}  // namespace quasimc

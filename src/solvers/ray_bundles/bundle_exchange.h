#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "solvers/ray_bundles/line_cache.h"
#include "solvers/ray_bundles/patch_light.h"
#include "transport/sky_directions.h"

namespace quasimc {

/// Directions of one step, and the density of lines along each.
struct BundleGroup {
    std::uint32_t directions = 2;  ///< even
    double line_area = 1;          ///< requested, across each direction; local units squared
    std::uint64_t key = 0;         ///< seed of their random shift
    double segments = 0;           ///< requested number of line segments
};

/// Direction `i` of a group, on the upper half of the sphere: a spiral of the golden angle, turned
/// and shifted at random. Each is uniform in its layer of the hemisphere, and the heights of two
/// neighbours have a constant sum: every group represents horizontal areas exactly.
[[nodiscard]] Vec3 bundle_direction(const BundleGroup& group, std::uint32_t i);

/// Options of an exchange.
struct ExchangeOptions {
    unsigned threads = 1;  ///< at most; the light does not depend on it
    /// Skies for which LineStatistics::open is measured; null: none.
    const SkyDirections* skies = nullptr;
    /// Is called with light that leaves the scene, direction by direction in their order: flux in
    /// each column.
    std::function<void(const Vec3& direction, std::span<const double> flux)> on_escape = {};
};

/// Scratch memory of exchange() for one calling thread, which may start more.
class BundleScratch {
    friend class BundleExchange;

    /// A direction, and the flux that one of its lines takes from a patch of exitance 1.
    struct Beam {
        Vec3 direction;
        double weight = 0;
    };
    /// Light that leaves the scene along a direction.
    struct Leaving {
        std::vector<double> forwards, backwards;  // by band
        /// Sides, [2 * patch + side], from which lines leave, line by line: the first end_count.
        std::vector<std::uint32_t> ends;
        std::size_t end_count = 0;
    };

    struct Thread {
        LineHitScratch scratch;
        LineHits lines;
    };

    std::vector<std::unique_ptr<Thread>> threads_;
    Leaving leaving_;  // along lines that are not cached
    LineCache cache_;
    std::vector<Beam> cached_beams_;
};

/// E = T B: exchanges light between patches along bundles of parallel lines.
///
/// All light that leaves Lambertian patches goes along lines to the next patch, both ways. Along a
/// line that represents the area a and the solid angle w, a patch of exitance B sends the flux B a
/// w / pi.
[[nodiscard]] PatchIrradiance exchange(
    PatchExitance exitance,
    const BundleGroup& group,
    const ExchangeOptions& options,
    BundleScratch& scratch);

}  // namespace quasimc

#pragma once

#include <cstdint>
#include <span>

#include "sums/tally.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// Whether light came straight from a source: from a sun (the beam), or from another one.
enum class LightPart { beam, direct, scattered };

/// The part of light that comes straight from a source.
[[nodiscard]] inline LightPart direct_part(const BoundSource& light) {
    return light.source->is_sun() ? LightPart::beam : LightPart::direct;
}

/// Light that falls on a side of a region, per band `factor` times weights[b].
struct Arrival {
    std::uint32_t region = 0;
    SurfaceSide side = SurfaceSide::upper;
    double cosine = 1;  ///< between the light and the normal, >= 0
    LightPart part = LightPart::direct;
    std::size_t origin = 0;
    double factor = 1;
    std::span<const double> weights;
};

/// Adds the light that the surface absorbs, if it is summed separately (LightBlocks::has_absorbed);
/// otherwise it follows from the incident light.
void score_absorbed(const PreparedScene& prepared, const Arrival& arrival, Tally& tally);

}  // namespace quasimc

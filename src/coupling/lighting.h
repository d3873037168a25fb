#pragma once

#include <optional>
#include <vector>

#include "coupling/vlab/specification.h"
#include "quasimc/run.h"

namespace quasimc {

/// A part of the light, as if it came from one direction.
struct LightShare {
    Vec3 travel;       ///< unit, z up
    double share = 0;  ///< of the irradiance of all; the shares add up to 1
};

/// The sources of a specification. Together they send the stated irradiance: the sum, over all
/// directions, of the irradiance on a plane that faces the light from there.
struct Lighting {
    /// Of all bands together or, if each has rays of its own, of every band by itself. Empty lists:
    /// it is night.
    std::vector<Sources> sources;
    std::vector<LightShare> shares;  ///< all sources; of a sky some directions that stand for it

    /// Irradiance on the horizontal over the irradiance of all sources.
    [[nodiscard]] double on_horizontal() const;
};

/// How the specification's axes lie: y up, north against x.
[[nodiscard]] Orientation plant_orientation();

/// A table of radiance without light, with cells as sky files have them: azimuths from -180 degrees
/// on, where 0 is south and 90 west.
[[nodiscard]] SkyTable plant_sky_table(std::size_t azimuths, std::size_t elevations);

/// The light of a specification.
/// @param sky  the sky of the day as it is now, if the specification has one
[[nodiscard]] Lighting make_lighting(const Specification& spec, const std::optional<SkyOfDay>& sky);

}  // namespace quasimc

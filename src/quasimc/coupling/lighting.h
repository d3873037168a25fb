#pragma once

#include <optional>
#include <vector>

#include "quasimc/coupling/specification.h"
#include "quasimc/tracing/run.h"

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

/// The light of a specification.
/// @param sky  the sky of the day as it is now, if the specification has one
[[nodiscard]] Lighting make_lighting(
    const Specification& spec, const std::optional<SkyOfDay>& sky);

/// Where the sun stands: unit vector, z up, and its elevation.
struct SunPlace {
    Vec3 to_sun;
    double elevation = 0;  ///< radians
};

/// The sun at a standard time of the zone whose meridian, a multiple of 15 degrees, is the nearest.
/// Declination and equation of time as in Preetham, Shirley and Smits (1999), appendix A.6, with
/// longitudes counted to the east.
[[nodiscard]] SunPlace sun_place(const SkyOfDay& sky, double hour);

}  // namespace quasimc

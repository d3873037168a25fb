#pragma once

#include <optional>
#include <vector>

#include "coupling/vlab/specification.h"
#include "quasimc/run.h"

namespace quasimc {

/// A part of the light, treated as parallel light.
struct LightShare {
    Vec3 travel;       ///< unit, z up
    double share = 0;  ///< fraction of the total irradiance
};

/// The sources of a specification. Together they have the given irradiance: the sum over all
/// directions of the irradiance on a plane that faces the direction.
struct Lighting {
    /// One entry for all bands or, if each band has its own rays, one per band. Empty lists at
    /// night.
    std::vector<Sources> sources;
    std::vector<LightShare> shares;  ///< all sources; a sky is represented by some directions

    /// Irradiance on the horizontal over the irradiance of all sources.
    [[nodiscard]] double on_horizontal() const;
};

/// The axes of a specification: y up, north against x.
[[nodiscard]] Orientation plant_orientation();

/// A table of zero radiances with the cells of sky files: azimuths from -180 degrees on, where 0 is
/// south and 90 west.
[[nodiscard]] SkyTable plant_sky_table(std::size_t azimuths, std::size_t elevations);

/// The light of a specification.
[[nodiscard]] Lighting make_lighting(const Specification& spec, const std::optional<SkyOfDay>& sky);

}  // namespace quasimc

#pragma once

#include <string>
#include <vector>

#include "light/models/sky_table.h"
#include "quasimc/source.h"

namespace quasimc::test {

/// A sky with a name for its test.
struct NamedSky {
    std::string name;
    SkyShape shape;
};

/// Skies of every row of the catalogue under a high and a low sun: all fifteen of the CIE, the
/// all-weather sky in each of its ranges of clearness; moreover tables and a sum over a day.
[[nodiscard]] std::vector<NamedSky> all_skies();

/// One sky of each kind, and the disk of the sun: for tests that take long.
/// @param spectrum  on the horizontal; the sun's: on the plane that faces it
[[nodiscard]] std::vector<std::shared_ptr<const Source>> sample_of_skies(
    const std::vector<double>& spectrum);

/// Towards the sun at a height, north-east of the scene.
[[nodiscard]] Vec3 sun_at(double elevation_deg);

/// A table whose cells all differ.
[[nodiscard]] SkyTable uneven_table(std::size_t azimuths, std::size_t elevations);

}  // namespace quasimc::test

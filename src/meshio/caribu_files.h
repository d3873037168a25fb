#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "base/vec3.h"
#include "text/table_reader.h"

// The files of Caribu other than its scenes (meshio/read_can.cpp). Each reader reports all faults.

namespace quasimc {

/// Reflectance and transmittance of light that falls on a side.
struct CaribuSide {
    double reflectance = 0, transmittance = 0;
};

/// The optics of one species in one band. Stems are opaque.
struct CaribuSpecies {
    CaribuSide stem, upper, lower;
};

/// A file of optics (.opt): the soil and the species, of one band.
struct CaribuOptics {
    std::optional<double> soil;
    std::vector<CaribuSpecies> species;
};
[[nodiscard]] CaribuOptics read_caribu_optics(std::string_view bytes, Reporter& reporter);

/// A line of a file of light (.light): irradiance on the horizontal, and direction of travel.
struct CaribuLight {
    double irradiance = 0;
    Vec3 travel;  ///< direction of any length, downwards
};
[[nodiscard]] std::vector<CaribuLight> read_caribu_light(
    std::string_view bytes, Reporter& reporter);

/// A file of a pattern (.8): low x, low y, high x, high y. Empty after a fault.
[[nodiscard]] std::optional<std::array<double, 4>> read_caribu_pattern(
    std::string_view bytes, Reporter& reporter);

}  // namespace quasimc

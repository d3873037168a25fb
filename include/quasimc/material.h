#pragma once

// Optical properties of surfaces.

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/error.h"

namespace quasimc {

/// Given numbers of a model, by the names of its parameters.
using BsdfParameters = std::map<std::string, double, std::less<>>;

/// A parameter of a lobe model.
struct BsdfParameter {
    std::string_view name;          ///< in run files: `reflection_<name>`, `transmission_<name>`
    double low, high;               ///< its domain, ends included
    std::optional<double> usual;    ///< its default; none: it must be given
    std::string_view summary;       ///< a few words for the manual
    std::string_view suggestion{};  ///< advice if a value is outside the domain
};

/// Optics of one side of a surface in one waveband, for light that arrives on this side. Models are
/// those of the catalogue, with their parameters by name; parameters of other models are ignored.
struct SideOptics {
    double reflectance = 0;  ///< rho, 0..1; fraction that leaves on the side of arrival
    double transmittance =
        0;  ///< tau, 0..1; fraction that leaves on the other side; rho + tau <= 1
    std::string reflection_model = "lambertian";
    BsdfParameters reflection_parameters = {};
    std::string transmission_model = "lambertian";
    BsdfParameters transmission_parameters = {};

    friend bool operator==(const SideOptics&, const SideOptics&) = default;
};

/// The specification of a material; one SideOptics per band.
struct MaterialSpec {
    std::string name;
    std::vector<SideOptics> upper, lower;

    friend bool operator==(const MaterialSpec&, const MaterialSpec&) = default;
};

/// Returns a Lambertian material with equal sides.
/// @param reflectance    per band, 0 to 1
/// @param transmittance  per band, 0 to 1; empty: none
[[nodiscard]] MaterialSpec lambertian(
    std::string name, std::vector<double> reflectance, std::vector<double> transmittance = {});

/// Checks the specification of a material (every number finite and in range, rho + tau <= 1 in each
/// band and side, known model names, every parameter given and in its domain, `bands` entries a
/// side); adds every fault to `faults`, at "where, upper side, band 2". Bands count from 1.
/// @param where  location of the material; empty for "material 'name'"
void check_material(
    const MaterialSpec& spec, std::size_t bands, const std::string& where, Faults& faults);

}  // namespace quasimc

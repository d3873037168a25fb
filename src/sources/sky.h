#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/input_error.h"
#include "sources/source.h"

namespace quasimc {

/// Relative radiance of a sky towards `to_light` (unit, z up, z > 0): finite and not negative.
using Radiance = std::function<double(const Vec3& to_light)>;

/// How a radiance runs inside the cells that the borders of a shape make.
enum class InsideCells { smooth, constant };

/// How the radiance of a sky is spread over the upper hemisphere, without its amount. Immutable.
struct SkyShape {
    Radiance radiance;
    /// Borders of cells inside which the radiance is smooth; none if it is smooth everywhere above
    /// the horizon. Azimuths from the x axis towards y, radians; sines of elevation, 0 to 1.
    std::vector<double> azimuths, sines;
    InsideCells inside = InsideCells::smooth;
};

/// The state of a sky, as far as models ask for it.
struct SkyState {
    Vec3 to_sun{0, 0, 1};             ///< unit, z up
    int cie_type = 12;                ///< 1 to 15, of CIE S 011 (ISO 15469)
    double turbidity = 3;             ///< 1.7 to 10: 2 very clear, 3 clear, 6 hazy
    double direct_normal = 0;         ///< irradiance, all wavelengths, W m-2
    double diffuse_horizontal = 100;  ///< irradiance, all wavelengths, W m-2
    double distance_au = 1;           ///< of the sun
};

/// What a model asks for of a SkyState.
enum class SkyNeeds { nothing, sun, sun_and_type, sun_and_turbidity, sun_and_weather };

/// One row of the table of models.
struct SkyEntry {
    std::string_view name;
    std::string_view summary;  ///< one line
    SkyNeeds needs;
    /// @param state  fields within their ranges
    SkyShape (*make)(const SkyState& state);
};
/// uniform, cie_overcast, cie_clear, cie_general, perez, preetham.
[[nodiscard]] std::span<const SkyEntry> sky_catalogue();
[[nodiscard]] const SkyEntry* find_sky(std::string_view name);

[[nodiscard]] SkyShape uniform_sky_shape();
/// (1 + 2 sin elevation) / 3: CIE 110 (1994); Moon and Spencer 1942.
[[nodiscard]] SkyShape cie_overcast_shape();
/// CIE 110 (1994), clear sky; Kittler 1967.
[[nodiscard]] SkyShape cie_clear_shape(const Vec3& to_sun);
/// The general skies of CIE S 011 / ISO 15469. @param type  1 to 15
[[nodiscard]] SkyShape cie_general_shape(int type, const Vec3& to_sun);
/// The all-weather sky of Perez, Seals and Michalsky 1993.
/// @throws InputError  if the sun is below the horizon or the irradiances are not possible
[[nodiscard]] SkyShape perez_shape(const SkyState& state);
/// What the all-weather sky goes by.
struct PerezWeather {
    double clearness = 1;   ///< epsilon: 1 overcast, over 6.2 clear
    double brightness = 0;  ///< Delta: diffuse light through the sun's air mass, over that of space
};
/// @throws InputError  as perez_shape
[[nodiscard]] PerezWeather perez_weather(const SkyState& state);
/// Luminance of Preetham, Shirley and Smits 1999.
[[nodiscard]] SkyShape preetham_shape(double turbidity, const Vec3& to_sun);
/// Below the lowest the fit gives a zenith of negative luminance.
inline constexpr double kLowestTurbidity = 1.7;
inline constexpr double kHighestTurbidity = 10;

/// A sky of such a shape at infinity. It is integrated when its light is first asked for, which
/// takes about half a millisecond: a sky that is never traced costs nothing.
/// @param horizontal_irradiance  per band, on the horizontal: exact, whatever the shape
/// @throws InputError  if the shape is dark everywhere
[[nodiscard]] std::shared_ptr<const Source> make_sky(
    std::string name, const SkyShape& shape, std::vector<double> horizontal_irradiance);

/// Irradiance on the horizontal under a shape as it stands, to a relative 1e-7.
[[nodiscard]] double horizontal_irradiance(const SkyShape& shape);

/// The sun as a disk of uniform radiance, of which `angular_radius_deg` is seen (solar_radius_deg).
/// @param to_sun  unit, to its centre, z up
/// @param facing_irradiance  per band, on a plane that faces its centre
[[nodiscard]] std::shared_ptr<const Source> make_sun_disk(
    std::string name,
    const Vec3& to_sun,
    double angular_radius_deg,
    std::vector<double> facing_irradiance);
/// Seen radius of the sun at a distance: 959.63 seconds of arc at 1 au (Auwers 1891).
[[nodiscard]] double solar_radius_deg(double distance_au);

}  // namespace quasimc

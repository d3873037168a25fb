#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "light/daylight/clear_sky.h"
#include "light/daylight/daylight.h"
#include "light/daylight/diffuse_fraction.h"
#include "quasimc/mesh.h"
#include "quasimc/source.h"

namespace quasimc {

/// The sun during an hour, or another time short against a day: its positions in the middle of
/// equal intervals.
struct SunPath {
    std::vector<SunPosition> steps;

    [[nodiscard]] static bool is_up(const SunPosition& sun) { return sun.elevation_deg > 0; }
    /// Mean sine of the elevation over all positions, 0 while the sun is down.
    [[nodiscard]] double mean_sine() const;
    /// The middle one of the positions with the sun up, or of all.
    [[nodiscard]] const SunPosition& middle() const;
    [[nodiscard]] double highest_deg() const;
    /// Irradiance outside the atmosphere facing the sun, W m-2.
    [[nodiscard]] double outside() const;
};

/// @param seconds  duration; 0: an instant
/// @param step     between sun positions, seconds; 0: one position, in the middle
[[nodiscard]] SunPath sun_path(
    const Site& site, const CivilTime& start, double seconds, double step);

/// A measured mean over the time, in one unit: enough to separate direct and diffuse light, or
/// global light alone.
struct Reading {
    std::optional<double> global = {}, direct_horizontal = {}, beam_normal = {}, diffuse = {};
};

/// Implausible properties of a reading, which are corrected without changing the global light.
enum class ReadingNote {
    none,
    // By at most a tenth, or the error of instruments.
    more_direct_than_global,   ///< all light then counts as direct
    more_diffuse_than_global,  ///< all light then counts as diffuse
    beam_too_strong,  ///< direct light with the sun down, or of a beam more than twice as strong as
                      ///< under a clear sky: the rest counts as diffuse
    more_direct_than_outside,  ///< stronger than outside the atmosphere, with the sun high: all of
                               ///< it counts as diffuse
    negative_by_day,  ///< global or diffuse light below zero with the sun up: it counts as 0
    light_at_night,   ///< light with the sun far down, as little as sensors are off: it counts as 0
    /// Redundant amounts differ by more than a tenth and the error of instruments:
    /// direct_horizontal counts as direct light, the sum of the parts as global light.
    parts_disagree,
};
/// Errors of a reading.
enum class ReadingFault { none, incomplete, negative, part_exceeds_global, light_at_night };

/// Daylight of an hour: suns and one sky.
struct HourLight {
    Daylight daylight;           ///< mean over the hour, full spectrum
    std::vector<double> facing;  ///< irradiance facing the sun at each position of the path, W m-2
    ReadingNote note = ReadingNote::none;
    ReadingFault fault = ReadingFault::none;
};

/// Light from a reading: the beam is constant while the sun is up.
/// @param air  of the clear sky; no beam exceeds twice the beam of that sky
[[nodiscard]] HourLight measured_light(
    const SunPath& path,
    const Reading& reading,
    LightUnit unit,
    DiffuseModel model,
    const DaylightSpectra& spectra,
    const ClearAir& air = {});

/// Light without clouds, position by position.
[[nodiscard]] HourLight clear_light(const SunPath& path, const ClearAir& air);

/// How daylight becomes sources.
struct DaylightSources {
    std::vector<SpectralSpan> bands;
    DaylightSpectra spectra;
    std::string sky = "perez";                  ///< of sky_catalogue()
    std::string overcast_sky = "cie_overcast";  ///< when there is no direct light
    SkyState state;                             ///< parameters of the sky's model besides the sun
    Orientation orientation;
};

/// Light sources of an hour: its suns, each with its part of the hour, and the sky with the sun in
/// the middle. Directions are unit, z up; spectra are by band.
struct HourParts {
    struct Sun {
        Vec3 to_sun;
        std::vector<double> facing;  ///< irradiance on a plane facing the sun
    };
    std::vector<Sun> suns;
    std::optional<SkyShape> sky;  ///< nothing without diffuse light
    std::vector<double> sky_horizontal;
    /// Descriptions of directions and shapes: equal texts mean equal shapes.
    std::string suns_text, sky_text;
};
[[nodiscard]] HourParts make_hour_parts(
    const SunPath& path, const HourLight& light, const DaylightSources& how);

/// Sources of an hour, and a text that identifies their shapes (TimeStep::directional_key).
struct HourSources {
    std::vector<std::shared_ptr<const Source>> sources;
    std::string directional_key;
};
[[nodiscard]] HourSources make_hour_sources(HourParts parts);

}  // namespace quasimc

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

/// The sun in the course of an hour, or of any time short against a day: seen at the middles of
/// equal steps.
struct SunPath {
    std::vector<SunPosition> steps;

    [[nodiscard]] static bool is_up(const SunPosition& sun) { return sun.elevation_deg > 0; }
    /// Mean over the steps of the sine of the elevation, 0 while the sun is down.
    [[nodiscard]] double mean_sine() const;
    /// The middle one of the steps with the sun up, or of all.
    [[nodiscard]] const SunPosition& middle() const;
    [[nodiscard]] double highest_deg() const;
    /// Irradiance outside the atmosphere facing the sun, W m-2.
    [[nodiscard]] double outside() const;
};

/// @param seconds  how long; 0: an instant
/// @param step     of the sun, seconds; 0: one, in the middle
[[nodiscard]] SunPath sun_path(
    const Site& site, const CivilTime& start, double seconds, double step);

/// What was measured, mean over the time, in one unit. Enough of it to tell direct from diffuse
/// light, or global light alone.
struct Reading {
    std::optional<double> global = {}, direct_horizontal = {}, beam_normal = {}, diffuse = {};
};

/// What is odd about a reading, and was settled so that the global light is kept.
enum class ReadingNote {
    none,
    // By a tenth, or what instruments are off, or less.
    more_direct_than_global,   ///< all light is then direct
    more_diffuse_than_global,  ///< all light is then diffuse
    beam_too_strong,  ///< direct light with the sun down, or of a beam more than twice as strong as
                      ///< under a clear sky: the rest counts as diffuse
    more_direct_than_outside,  ///< stronger than outside the atmosphere, with the sun high: all of
                               ///< it counts as diffuse
    negative_by_day,  ///< global or diffuse light below zero with the sun up: it counts as 0
    light_at_night,   ///< light with the sun far down, as little as sensors are off: it counts as 0
    /// More is given than is needed, and is off by more than a tenth and what instruments are: of
    /// direct light direct_horizontal counts, of the global light the sum of its parts.
    parts_disagree,
};
/// What is wrong with a reading.
enum class ReadingFault { none, incomplete, negative, part_exceeds_global, light_at_night };

/// Daylight of an hour: suns and one sky.
struct HourLight {
    Daylight daylight;           ///< mean over the hour, full spectrum
    std::vector<double> facing;  ///< of each step of the path: irradiance facing the sun, W m-2
    ReadingNote note = ReadingNote::none;
    ReadingFault fault = ReadingFault::none;
};

/// Light from a reading: the beam is equally strong while the sun is up.
/// @param air  of the clear sky, of which no beam is more than twice as strong
[[nodiscard]] HourLight measured_light(
    const SunPath& path,
    const Reading& reading,
    LightUnit unit,
    DiffuseModel model,
    const DaylightSpectra& spectra,
    const ClearAir& air = {});

/// Light without clouds, step by step.
[[nodiscard]] HourLight clear_light(const SunPath& path, const ClearAir& air);

/// How daylight becomes sources.
struct DaylightSources {
    std::vector<SpectralSpan> bands;
    DaylightSpectra spectra;
    std::string sky = "perez";                  ///< of sky_catalogue()
    std::string overcast_sky = "cie_overcast";  ///< when there is no direct light
    SkyState state;                             ///< what the sky's model asks for besides the sun
    Orientation orientation;
};

/// What shines in an hour: its suns, each with its part of the hour, and the sky with the sun in
/// the middle. Directions are unit, z up; spectra are by band.
struct HourParts {
    struct Sun {
        Vec3 to_sun;
        std::vector<double> facing;  ///< irradiance on a plane that faces it
    };
    std::vector<Sun> suns;
    std::optional<SkyShape> sky;  ///< nothing without diffuse light
    std::vector<double> sky_horizontal;
    /// Texts that tell directions and shapes: equal texts, equal shapes.
    std::string suns_text, sky_text;
};
[[nodiscard]] HourParts make_hour_parts(
    const SunPath& path, const HourLight& light, const DaylightSources& how);

/// Sources of an hour, and a text that tells their shapes (TimeStep::directional_key).
struct HourSources {
    std::vector<std::shared_ptr<const Source>> sources;
    std::string directional_key;
};
[[nodiscard]] HourSources make_hour_sources(HourParts parts);

}  // namespace quasimc

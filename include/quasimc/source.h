#pragma once

// Sources of light: parallel light, the sun, skies and lamps; and the position of the sun.

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "quasimc/error.h"
#include "quasimc/mesh.h"

namespace quasimc {

inline constexpr double kSecondsADay = 86400;

/// A site on the Earth.
struct Site {
    double latitude_deg = 0;        ///< -90 to 90, north positive
    double longitude_deg = 0;       ///< -180 to 180, east positive
    double elevation_m = 0;         ///< above the sea
    double pressure_hpa = 1013.25;  ///< yearly mean; for refraction
    double temperature_c = 12;      ///< yearly mean; for refraction
};

/// A civil date and time.
struct CivilTime {
    int year = 2000;  ///< 1900 to 2100
    int month = 1;    ///< 1 to 12
    int day = 1;      ///< from 1
    int hour = 0;     ///< 0 to 23
    int minute = 0;   ///< 0 to 59
    double second =
        0;  ///< 0 to below 60; to below 61 in a leap second, at the end of a month of UTC
    double utc_offset_hours = 0;  ///< clock time less UTC, -14 to 14; east of Greenwich positive

    friend bool operator==(const CivilTime&, const CivilTime&) = default;
};

inline constexpr int kFirstYear = 1900;
inline constexpr int kLastYear = 2100;

/// Reports the errors of a site. @param where  for the messages
void check_site(const Site& site, std::string_view where, Faults& faults);
/// Reports the errors of a time: fields out of range, days that no calendar has, impossible leap
/// seconds.
void check_time(const CivilTime& time, std::string_view where, Faults& faults);

/// Pressure of the standard atmosphere [hPa] at a height above the sea (ISO 2533), for sites of
/// unknown pressure; -2000 to 11000 m.
[[nodiscard]] double standard_pressure_hpa(double elevation_m);

[[nodiscard]] int days_in_month(int year, int month);
/// 1 for the 1st of January.
[[nodiscard]] int day_of_year(const CivilTime& time);

/// Julian day of a time: days of UTC since noon of 1 January -4712, with fractions. A leap second
/// has the Julian day of the second after it.
[[nodiscard]] double julian_day(const CivilTime& time);
/// The civil time of a Julian day in a time zone, to 0.1 ms.
[[nodiscard]] CivilTime civil_time(double julian_day, double utc_offset_hours);
/// The time `seconds` later (earlier if negative), in the same time zone.
[[nodiscard]] CivilTime later(const CivilTime& time, double seconds);

/// Terrestrial time less universal time [s]: polynomials of Espenak and Meeus (2006), "Five
/// millennium canon of solar eclipses"; some seconds off after 2006.
[[nodiscard]] double delta_t_seconds(const CivilTime& time);

/// Intermediate results of the solar position algorithm, named as in Reda and Andreas (2004);
/// degrees unless named otherwise. For tests and verification.
struct SunIntermediates {
    double julian_day = 0;
    double earth_longitude_deg = 0;  ///< L, heliocentric
    double earth_latitude_deg = 0;   ///< B, heliocentric
    double nutation_longitude_deg = 0;
    double nutation_obliquity_deg = 0;
    double obliquity_deg = 0;           ///< true obliquity of the ecliptic
    double apparent_longitude_deg = 0;  ///< lambda of the sun
    double sidereal_time_deg = 0;       ///< apparent, at Greenwich
    double right_ascension_deg = 0;     ///< geocentric
    double declination_deg = 0;         ///< geocentric
    double hour_angle_deg = 0;          ///< at the site, west positive, 0 to 360
    double topocentric_right_ascension_deg = 0;
    double topocentric_declination_deg = 0;
    double topocentric_hour_angle_deg = 0;
};

/// Position of the sun in the sky of a site.
struct SunPosition {
    double azimuth_deg = 0;           ///< clockwise from north, 0 to 360
    double elevation_deg = 0;         ///< apparent, with refraction
    double true_elevation_deg = 0;    ///< without refraction
    double distance_au = 1;           ///< from the Earth's centre to the sun's, astronomical units
    double declination_deg = 0;       ///< geocentric
    double equation_of_time_min = 0;  ///< sundial less clock, -20 to 20
    SunIntermediates intermediates;

    [[nodiscard]] double zenith_deg() const { return 90 - elevation_deg; }
};

/// Position of the sun by the solar position algorithm of NREL, good to 0.0003 degrees.
///
/// Reda and Andreas (2004), "Solar position algorithm for solar radiation applications", Solar
/// Energy 76, 577-589; NREL/TP-560-34302 (revised 2008).
/// @param site, time  without faults (check_site, check_time)
/// @param delta_t_s  terrestrial less universal time [s]; default: delta_t_seconds(time)
[[nodiscard]] SunPosition sun_position(
    const Site& site, const CivilTime& time, std::optional<double> delta_t_s = std::nullopt);

/// Kinds of days by sunrise and sunset.
enum class DayKind {
    ordinary,     ///< the sun rises and sets
    polar_day,    ///< the sun does not set
    polar_night,  ///< the sun does not rise
};

/// Rise, transit and set of the sun that belong together: those around the transit of one day. In
/// high latitudes a sun that sets after midnight has a sunset of the next date.
struct SunDay {
    DayKind kind = DayKind::ordinary;
    CivilTime transit;                         ///< on the requested date
    std::optional<CivilTime> sunrise, sunset;  ///< none unless kind is ordinary
    double transit_elevation_deg = 0;          ///< without refraction; below 0 in a polar night
};

/// The day of the sun on the date of `date` (its time of day does not count, its time zone does).
/// Rise and set: the sun's centre is 0.8333 degrees below the horizon, for its radius and the
/// refraction there.
[[nodiscard]] SunDay sun_day(
    const Site& site, const CivilTime& date, std::optional<double> delta_t_s = std::nullopt);

/// The simple model of the original program, for plant simulators: declination, equation of time
/// (Iqbal 1983, as in Preetham et al. 1999) and hour angle.
struct SimpleSun {
    double azimuth_deg = 0;  ///< clockwise from north
    double elevation_deg = 0;
};
/// @param day_of_year  1 to 366
/// @param clock_hours  0 to 24, on a clock that is `utc_offset_hours` ahead of UTC
[[nodiscard]] SimpleSun simple_sun_position(
    double latitude_deg,
    double longitude_deg,
    double day_of_year,
    double clock_hours,
    double utc_offset_hours);
/// The time zone of a longitude: its nearest multiple of 15 degrees, in hours.
[[nodiscard]] double nautical_utc_offset(double longitude_deg);

/// Properties of a source by which solvers choose sampling strategies.
struct SourceTraits {
    /// All light comes from one direction, a point of the sky. No ray hits it, and radiance() is 0.
    bool delta = false;
    /// Infinitely far away: the same from all points, and rays that leave the scene may hit it.
    /// Other sources are lamps, which have a position and are not hit by rays.
    bool at_infinity = true;
    /// Wide enough for rays that leave the scene to hit it, as a sky. Other sources at infinity are
    /// suns: surfaces with their direct light count as sunlit, and their illuminate() samples with
    /// equal weights.
    bool extended = true;

    /// Whether surfaces with direct light of the source count as sunlit.
    [[nodiscard]] constexpr bool is_sun() const { return at_infinity && !extended; }
    friend bool operator==(const SourceTraits&, const SourceTraits&) = default;
};

/// The sun as a point, or parallel light from elsewhere.
inline constexpr SourceTraits kBeamTraits{.delta = true, .at_infinity = true, .extended = false};
/// The sun as a disk.
inline constexpr SourceTraits kSunDiskTraits{
    .delta = false, .at_infinity = true, .extended = false};
inline constexpr SourceTraits kSkyTraits{.delta = false, .at_infinity = true, .extended = true};
inline constexpr SourceTraits kLampTraits{.delta = false, .at_infinity = false, .extended = false};

/// Smaller irradiances count as 0, such as direct light of the sun at the horizon on a foggy day:
/// the squares of their errors would underflow.
inline constexpr double kMinIrradiance = 1e-60;

/// A source of light: spectrum_b times a directional distribution that is the same in all bands. (A
/// source with a spectrum that varies over it is several sources.) Positions and directions are in
/// the world with z up; immutable. The functions below make sources.
class Source {
  public:
    virtual ~Source() = default;
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;

    [[nodiscard]] const std::string& name() const { return name_; }
    /// Amount of light per band (>= 0): an irradiance in the unit of the run, on a plane that
    /// depends on the source; for a lamp, its flux (irradiance unit x square world unit).
    [[nodiscard]] std::span<const double> spectrum() const { return spectrum_; }
    [[nodiscard]] const SourceTraits& traits() const { return traits_; }
    /// Irradiance on the horizontal, upper side, for a spectrum of 1; NaN for a lamp, whose
    /// irradiance varies in space.
    [[nodiscard]] double horizontal_irradiance() const { return horizontal_irradiance_; }

    /// traits().delta
    [[nodiscard]] bool is_directional() const { return traits_.delta; }
    /// traits().is_sun()
    [[nodiscard]] bool is_sun() const { return traits_.is_sun(); }
    /// !traits().at_infinity
    [[nodiscard]] bool is_lamp() const { return !traits_.at_infinity; }

  private:
    friend class SourceModel;  // src/light/models/source.h: base of all sources
    Source(
        std::string name,
        std::vector<double> spectrum,
        SourceTraits traits,
        double horizontal_irradiance);

    std::string name_;
    std::vector<double> spectrum_;
    SourceTraits traits_;
    double horizontal_irradiance_;
};

using Sources = std::vector<std::shared_ptr<const Source>>;

/// Parallel light. @param travel  the unit direction in which it travels, z up
/// @param facing_irradiance  per band, on a plane facing the light
[[nodiscard]] std::shared_ptr<const Source> make_directional_source(
    std::string name, const Vec3& travel, std::vector<double> facing_irradiance);

/// A hemisphere at infinity of uniform radiance.
/// @param horizontal_irradiance  per band, on the horizontal
[[nodiscard]] std::shared_ptr<const Source> make_uniform_sky(
    std::string name, std::vector<double> horizontal_irradiance);

/// A source with its light times a factor, 0 or more; the source itself for 1.
[[nodiscard]] std::shared_ptr<const Source> make_dimmed(
    std::shared_ptr<const Source> source, double factor);

/// Relative radiance of a sky towards `to_light` (unit, z up, z > 0): finite and not negative.
using Radiance = std::function<double(const Vec3& to_light)>;

/// Radiance inside the cells between the borders of a shape.
enum class InsideCells { smooth, constant };

/// The relative distribution of a sky's radiance over the upper hemisphere. Immutable.
struct SkyShape {
    Radiance radiance;
    /// Borders of cells inside which the radiance is smooth; none if it is smooth everywhere above
    /// the horizon. Azimuths from the x axis towards y, radians; sines of elevation, 0 to 1.
    std::vector<double> azimuths, sines;
    InsideCells inside = InsideCells::smooth;
};

/// The parameters of sky models.
struct SkyState {
    Vec3 to_sun{0, 0, 1};             ///< unit, z up
    int cie_type = 12;                ///< 1 to 15, of CIE S 011 (ISO 15469)
    double turbidity = 3;             ///< 1.7 to 10: 2 very clear, 3 clear, 6 hazy
    double direct_normal = 0;         ///< irradiance, all wavelengths, W m-2
    double diffuse_horizontal = 100;  ///< irradiance, all wavelengths, W m-2
    double distance_au = 1;           ///< to the sun
};

/// The fields of a SkyState that a model needs.
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
/// The parameters of the all-weather sky.
struct PerezWeather {
    double clearness = 1;   ///< epsilon: 1 overcast, over 6.2 clear
    double brightness = 0;  ///< Delta: diffuse light through the sun's air mass, over that of space
};
/// @throws InputError  as perez_shape
[[nodiscard]] PerezWeather perez_weather(const SkyState& state);
/// Luminance of Preetham, Shirley and Smits 1999.
[[nodiscard]] SkyShape preetham_shape(double turbidity, const Vec3& to_sun);
/// Below the lowest turbidity the fit gives a negative luminance of the zenith.
inline constexpr double kLowestTurbidity = 1.7;
inline constexpr double kHighestTurbidity = 10;

/// A sky of the given shape. It is integrated when its light is first needed, which takes about
/// half a millisecond.
/// @param horizontal_irradiance  per band, on the horizontal: exact, for any shape
/// @throws InputError  if the shape is dark everywhere
[[nodiscard]] std::shared_ptr<const Source> make_sky(
    std::string name, const SkyShape& shape, std::vector<double> horizontal_irradiance);

/// Irradiance on the horizontal under an unscaled shape, to a relative 1e-7.
[[nodiscard]] double horizontal_irradiance(const SkyShape& shape);

/// The sun as a disk of uniform radiance with an apparent radius of `angular_radius_deg`
/// (solar_radius_deg).
/// @param to_sun  unit, to its centre, z up
/// @param facing_irradiance  per band, on a plane that faces its centre
[[nodiscard]] std::shared_ptr<const Source> make_sun_disk(
    std::string name,
    const Vec3& to_sun,
    double angular_radius_deg,
    std::vector<double> facing_irradiance);
/// Apparent radius of the sun at a distance: 959.63 seconds of arc at 1 au (Auwers 1891).
[[nodiscard]] double solar_radius_deg(double distance_au);

/// Radiance of the upper hemisphere in cells of azimuth and elevation, constant in each cell.
struct SkyTable {
    std::size_t azimuths = 0, elevations = 0;
    /// [elevation * azimuths + azimuth]. Elevations in equal steps of angle, from the horizon up.
    /// Azimuths in equal steps; the first cell begins at `first_azimuth`.
    std::vector<double> radiance;
    double first_azimuth = 0;  ///< radians, from the x axis towards y
    double turn = 1;  ///< +1: azimuths run from x towards y; -1: the other way, as a compass

    [[nodiscard]] double at(std::size_t azimuth, std::size_t elevation) const {
        return radiance[elevation * azimuths + azimuth];
    }
    /// The radiance of the cell that a direction (unit, z up) points to.
    [[nodiscard]] double towards(const Vec3& to_light) const;
};

[[nodiscard]] SkyShape table_shape(SkyTable table);

/// Daylight on the horizontal, full spectrum, W m-2.
struct Daylight {
    double direct = 0;   ///< from the sun
    double diffuse = 0;  ///< from the sky
    [[nodiscard]] double global() const { return direct + diffuse; }
};

/// The directional distribution of a lamp: radiant intensity for a flux of 1 [1/sr]. Its integral
/// over all directions is 1. Directions are unit vectors in the lamp's own frame: z is the
/// direction of its aim, x its zero azimuth.
///
/// Directions are sampled from a table of cells that are uniform in solid angle, in proportion to
/// the light in each, and weighted by the intensity over the cell's mean: continuous and unbiased.
class Pattern {
  public:
    /// Intensity, in any unit, at angle `theta` from the axis (0 to pi) and azimuth `phi` (0 to
    /// 2 pi).
    using Intensity = std::function<double(double theta, double phi)>;

    /// @param thetas  ascending, within 0 to pi, between which the intensity is smooth; outside
    /// them
    ///                it is 0
    /// @param phis    ascending, from 0 to 2 pi; {0, 2 pi} if the azimuth doesn't matter
    Pattern(
        Intensity intensity, const std::vector<double>& thetas, const std::vector<double>& phis);

    /// The given intensity, integrated over all directions: flux in the unit of `intensity` x sr.
    [[nodiscard]] double total() const;
    [[nodiscard]] double intensity(const Vec3& direction) const;
    /// The borders of its cells and the light in each, which identify a pattern.
    [[nodiscard]] std::vector<double> parameters() const;

    struct Drawn {
        Vec3 direction;
        double weight = 1;  ///< intensity / density; its mean is 1
    };
    [[nodiscard]] Drawn draw(double u0, double u1) const;

  private:
    struct Cells;
    std::shared_ptr<const Cells> cells_;  // shared by copies
};

/// A uniform intensity in all directions.
[[nodiscard]] Pattern isotropic_pattern();
/// A flat Lambertian surface: cos theta / pi, nothing behind it.
[[nodiscard]] Pattern cosine_pattern();
/// (n + 1) / (2 pi) cos^n theta, n >= 0, nothing behind it. n = 1: cosine_pattern.
[[nodiscard]] Pattern power_cosine_pattern(double exponent);
/// A uniform intensity up to `inner` radians from the axis, falling to 0 at `outer` by the smooth
/// step 3 x^2 - 2 x^3 of the angle; 0 <= inner <= outer <= pi, outer > 0.
[[nodiscard]] Pattern spot_pattern(double inner, double outer);
/// A thin tube along z with a Lambertian surface: sin theta / pi^2.
[[nodiscard]] Pattern tube_pattern();

/// Intensities measured on a grid of angles, as in photometric files of type C.
struct PhotometricWeb {
    std::vector<double> vertical_deg;  ///< from the aim (0) to behind (180), ascending
    /// From the lamp's x axis, ascending from 0; to 0, 90, 180 or 360, depending on the symmetry.
    /// Counterclockwise as seen from behind the lamp, against its aim: from above, if it shines
    /// down.
    std::vector<double> horizontal_deg;
    std::vector<double> candela;  ///< [horizontal][vertical]
};

/// The pattern of a web: bilinear in the two angles, mirrored by its symmetry, 0 beyond its
/// vertical angles. total() is its flux in lumens.
/// @param web  with angles as above, and some light
[[nodiscard]] Pattern web_pattern(PhotometricWeb web);

/// The luminous surface of a lamp. Lengths in the scene's unit.
struct Opening {
    enum class Kind {
        point,
        line,       ///< along the lamp's z axis
        rectangle,  ///< across the z axis; `length` along x, `width` along y
        disk,       ///< across the z axis
        sphere      ///< the pattern is about the normal of each point of its surface
    };
    Kind kind = Kind::point;
    double length = 0, width = 0;  ///< length of a line; both of a rectangle
    double radius = 0;             ///< radius of a disk or a sphere
};

/// The specification of a lamp. World coordinates, z up.
struct LampSpec {
    std::string name;
    Vec3 position;                                  ///< center of the opening
    Frame axes{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}};  ///< x, y, z of the lamp; it aims along z
    Opening opening;
    Pattern pattern = isotropic_pattern();  ///< at every point of the opening
    std::vector<double> flux;               ///< per band, irradiance unit x square scene unit
};

/// A lamp without a body: it casts no shadow, and light passes through it. In a periodic scene it
/// repeats with the cell (and is then sampled only by paths from sources).
///
/// Light tracing samples directions either by the lamp's pattern or in the cone around the scene's
/// bounding sphere, whichever is more efficient; flux() of its sampler is the light in these
/// directions.
[[nodiscard]] std::shared_ptr<const Source> make_lamp(LampSpec spec);

/// The right-handed frame that aims along `aim` (not zero) with its x axis towards `along`, as far
/// as that is across `aim`; any if `along` is parallel to it.
[[nodiscard]] Frame lamp_axes(const Vec3& aim, const Vec3& along);

}  // namespace quasimc

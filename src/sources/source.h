#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/vec3.h"
#include "geometry/raster/scene_projection.h"

namespace quasimc {

/// The start of a path from a source. Local coordinates.
struct Emission {
    Vec3 origin;
    Vec3 direction;     ///< unit, in which the light travels
    double weight = 1;  ///< relative to the source's mean weight; its mean over the unit cube is 1
};

/// A direction and the density with which it was drawn.
struct DrawnDirection {
    Vec3 direction;      ///< unit, in which the light travels
    double density = 0;  ///< per steradian
};

/// A source that has been told what scene it lights: draws the starts of paths. Const, shared by
/// all threads.
class SourceSampler {
  public:
    virtual ~SourceSampler() = default;
    /// @param flux  see flux()
    /// @param beam_direction  see beam_direction()
    explicit SourceSampler(double flux, std::optional<Vec3> beam_direction = std::nullopt)
        : flux_(flux), beam_direction_(beam_direction) {}
    SourceSampler(const SourceSampler&) = delete;
    SourceSampler& operator=(const SourceSampler&) = delete;

    /// Flux sent towards the scene for a spectrum of 1, local area units: mean of weight x area.
    [[nodiscard]] double flux() const { return flux_; }
    /// A start from a point of the unit cube. u[0] and u[1] place the start (nearby values give
    /// nearby starts); u[2] and u[3] choose the direction if the source has many.
    [[nodiscard]] virtual Emission emit(const std::array<double, 4>& u) const = 0;
    /// A direction in which light may enter, drawn from a point of the unit square; nearby points
    /// give nearby directions. Every source at infinity draws all directions in which it has light.
    /// Of a beam, which has one, and of a lamp, whose directions depend on the place, the density
    /// is 0.
    [[nodiscard]] virtual DrawnDirection draw_direction(double u0, double u1) const;
    /// The density per steradian with which draw_direction() draws `direction` (unit, in which the
    /// light travels) from evenly spread points; its integral over the sphere is 1.
    [[nodiscard]] virtual double density(const Vec3& direction) const;
    /// The direction in which every path starts, if it is the same for all; their weight is then 1
    /// and u[2], u[3] are not used. Rays of a beam are cast in packets. That of a source of one
    /// direction (SourceTraits::delta) has one.
    [[nodiscard]] const std::optional<Vec3>& beam_direction() const { return beam_direction_; }
    /// Of a beam: the origins of emit({u0[i], u1[i]}), faster.
    virtual void beam_origins(
        std::span<const double> u0, std::span<const double> u1, std::span<Vec3> origins) const;

  private:
    double flux_;
    std::optional<Vec3> beam_direction_;
};

/// Light that reaches a point from a source, before anything stands in its way.
struct Illumination {
    Vec3 to_light;      ///< unit
    double weight = 0;  ///< irradiance on a plane facing it for a spectrum of 1, divided by the
                        ///< density of the draw
    double distance = std::numeric_limits<double>::infinity();  ///< of the source, world units
};

/// What kind of light a source gives, by which solvers decide how to follow it.
struct SourceTraits {
    /// All light comes from one direction, a point of the sky. No ray finds it by chance, and
    /// radiance() is 0.
    bool delta = false;
    /// Far away: it looks the same from everywhere, and rays that leave the scene may reach it. A
    /// source that is not, a lamp, stands at a place, which those rays pass by.
    bool at_infinity = true;
    /// So wide that rays which leave the scene find it by chance, as they do a sky. What is at
    /// infinity and not as wide is a sun: what it lights straight counts as sunlit, and its
    /// illuminate() draws with equal weights.
    bool extended = true;

    /// Whether what the source lights straight counts as sunlit.
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

/// Where light comes from: spectrum_b times a shape that is the same in all bands. (A source whose
/// spectrum varies over it is several sources.) Places and directions are in the world with z up;
/// immutable.
class Source {
  public:
    virtual ~Source() = default;
    /// @param horizontal_irradiance  see horizontal_irradiance()
    Source(
        std::string name,
        std::vector<double> spectrum,
        SourceTraits traits,
        double horizontal_irradiance)
        : name_(std::move(name)),
          spectrum_(std::move(spectrum)),
          traits_(traits),
          horizontal_irradiance_(horizontal_irradiance) {}
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;

    [[nodiscard]] const std::string& name() const { return name_; }
    /// What scales the shape, per band (>= 0): an irradiance in the unit of the run, on which
    /// plane, the source says; of a lamp, the flux it emits (irradiance unit x square world unit).
    [[nodiscard]] std::span<const double> spectrum() const { return spectrum_; }
    [[nodiscard]] const SourceTraits& traits() const { return traits_; }
    /// Irradiance on the horizontal, upper side, for a spectrum of 1; NaN for a lamp, whose
    /// irradiance varies from place to place.
    [[nodiscard]] double horizontal_irradiance() const { return horizontal_irradiance_; }

    /// traits().delta
    [[nodiscard]] bool is_directional() const { return traits_.delta; }
    /// traits().is_sun()
    [[nodiscard]] bool is_sun() const { return traits_.is_sun(); }
    /// !traits().at_infinity
    [[nodiscard]] bool is_lamp() const { return !traits_.at_infinity; }

    /// Null when no light of this source meets the scene.
    [[nodiscard]] virtual std::unique_ptr<SourceSampler> make_sampler_in(
        const SceneProjection& projection) const = 0;
    /// Draws a direction from which light reaches `point` (world coordinates).
    [[nodiscard]] virtual Illumination illuminate(
        const Vec3& point, double u0, double u1) const = 0;
    /// Radiance [spectrum/sr] seen in direction `to_light`; 0 for a source of one direction.
    [[nodiscard]] virtual double radiance(const Vec3& to_light) const = 0;

  private:
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

/// The upper half of the sphere at infinity, of the same radiance everywhere.
/// @param horizontal_irradiance  per band, on the horizontal
[[nodiscard]] std::shared_ptr<const Source> make_uniform_sky(
    std::string name, std::vector<double> horizontal_irradiance);

}  // namespace quasimc

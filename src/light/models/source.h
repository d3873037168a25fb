#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/model_parameters.h"
#include "quasimc/source.h"
#include "raster/scene_projection.h"

namespace quasimc {

/// The start of a path from a source. Local coordinates.
struct Emission {
    Vec3 origin;
    Vec3 direction;     ///< unit, in which the light travels
    double weight = 1;  ///< relative to the source's mean weight; its mean over the unit cube is 1
};

/// A direction and the density with which it was drawn.
struct DirectionSample {
    Vec3 direction;      ///< unit, in which the light travels
    double density = 0;  ///< per steradian
};

/// The position and size of a lamp, local coordinates.
struct LampExtent {
    BoundingSphere body;  ///< about its centre, holds its opening
    /// Whether the samples of illuminate() are bounded at any distance.
    bool has_bounded_irradiance = false;
    /// From the centre to the end of a line, whose irradiance grows as 1 / distance; 0 for others.
    Vec3 half_line = {};
};

/// Samples the starts of paths of a source in one scene. Const, shared by all threads.
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
    /// The start of a path for a point of the unit cube. u[0] and u[1] choose its position (nearby
    /// values give nearby starts), u[2] and u[3] the direction if the source has many.
    [[nodiscard]] virtual Emission emit(const std::array<double, 4>& u) const = 0;
    /// A direction of incoming light, drawn from a point of the unit square; nearby points give
    /// nearby directions. u0 grows from the edge of the sky (of the disk) to the zenith (its
    /// centre), about which u1 runs once around. Every source at infinity draws all directions in
    /// which it has light. The density is 0 for beams, which have one direction, and for lamps,
    /// whose directions depend on the point.
    [[nodiscard]] virtual DirectionSample draw_direction(double u0, double u1) const;
    /// The density per steradian with which draw_direction() draws `direction` (unit, in which the
    /// light travels) from uniform points; its integral over the sphere is 1.
    [[nodiscard]] virtual double density(const Vec3& direction) const;
    /// The common direction of all paths, if there is one; their weight is then 1 and u[2], u[3]
    /// are not used. Rays of a beam are cast in packets. Every source of one direction
    /// (SourceTraits::delta) has one.
    [[nodiscard]] const std::optional<Vec3>& beam_direction() const { return beam_direction_; }
    /// Beams only: the origins of emit({u0[i], u1[i]}), faster.
    virtual void beam_origins(
        std::span<const double> u0, std::span<const double> u1, std::span<Vec3> origins) const;

    /// Lamps only: position and size.
    [[nodiscard]] virtual std::optional<LampExtent> lamp_extent() const;

  private:
    double flux_;
    std::optional<Vec3> beam_direction_;
};

/// Light that reaches a point from a source, without occlusion.
struct Illumination {
    Vec3 to_light;      ///< unit
    double weight = 0;  ///< irradiance on a plane facing it for a spectrum of 1, divided by the
                        ///< density of the draw
    double distance = std::numeric_limits<double>::infinity();  ///< of the source, world units
};

/// A source as used inside the engine.
class SourceModel : public Source {
  public:
    /// @param spectrum  see spectrum(); values below kMinIrradiance become 0
    /// @param horizontal_irradiance  see horizontal_irradiance()
    SourceModel(
        std::string name,
        std::vector<double> spectrum,
        SourceTraits traits,
        double horizontal_irradiance)
        : Source(std::move(name), std::move(spectrum), traits, horizontal_irradiance) {}

    /// The model of the light and its parameters, except name and spectrum. A parameter that is a
    /// function is represented by its values in the cells for sampling directions.
    [[nodiscard]] virtual ModelParameters parameters() const = 0;
    /// A sampler for a scene; null when no light of this source meets the scene.
    [[nodiscard]] virtual std::unique_ptr<SourceSampler> make_sampler_in(
        const SceneProjection& projection) const = 0;
    /// Draws a direction from which light reaches `point` (world coordinates).
    [[nodiscard]] virtual Illumination illuminate(
        const Vec3& point, double u0, double u1) const = 0;
    /// Radiance [spectrum/sr] seen in direction `to_light`; 0 for a source of one direction.
    [[nodiscard]] virtual double radiance(const Vec3& to_light) const = 0;
    /// Upper bound of the unoccluded irradiance of a surface with this unit normal, for a spectrum
    /// of 1; for suns the irradiance itself or nearly. Infinite where there is no bound, as close
    /// to a lamp.
    [[nodiscard]] virtual double most_irradiance(const Vec3& /*normal*/) const {
        return std::numeric_limits<double>::infinity();
    }
};

/// Returns the SourceModel of a source.
[[nodiscard]] inline const SourceModel& model_of(const Source& source) {
    return static_cast<const SourceModel&>(source);  // Source has no other classes
}

}  // namespace quasimc

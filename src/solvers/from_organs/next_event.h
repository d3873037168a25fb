#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "samplers/sampler.h"
#include "solvers/from_organs/lamp_near_field.h"
#include "transport/light_sampler.h"
#include "transport/prepared_scene.h"
#include "transport/surface.h"

namespace quasimc {

/// A light and a direction to it from a point. `factor` times start weights and cosine is its
/// irradiance there if it is not occluded.
struct LightSample {
    const BoundSource* light = nullptr;
    Vec3 to_light;
    double factor = 0;
    double distance = 0;     ///< local units
    double probability = 1;  ///< with which the light was picked
};

/// The directions a point receives light from: all, or those near the normal of a surface on either
/// side.
struct FieldOfView {
    Vec3 normal;
    double least_cosine = 0;  ///< between direction and normal; 0: all
};

/// The state of a backward path. Each worker reuses it, so that tracing allocates nothing.
struct GatherScratch {
    explicit GatherScratch(std::size_t bands) {
        resize_apart(weights, bands);
        resize_apart(products, bands);
        resize_apart(irradiance, bands);
    }
    std::vector<double> weights;  // per band: throughput of the path
    /// Radiance sampled so far, [origin][band].
    std::vector<double> gathered;
    std::vector<double> products;
    std::vector<double> irradiance;  // per band: of a connection

    /// Starts with no light of a number of origins.
    void clear_gathered(std::size_t origins) { gathered.assign(origins * weights.size(), 0); }
    [[nodiscard]] std::span<double> gathered_from(std::size_t origin) {
        return std::span(gathered).subspan(origin * weights.size(), weights.size());
    }
};

/// Next-event estimation: samples lights from the vertices of a path that runs backwards.
class NextEvent {
  public:
    /// @param scale  irradiance counts in units of the flux of all lights over this area (square
    /// scene units)
    /// @param near  light that is not sampled here
    /// @param narrow_from  peak_brightness() of lobes through which suns and lamps are not sampled
    /// @param points  a power of two: if lights are picked independently of position, this number
    /// of well-spread points picks each light exactly as often as expected
    NextEvent(
        const PreparedScene& prepared,
        const Sampler& sampler,
        const LampNearField& near,
        double scale,
        double narrow_from,
        std::uint64_t points);

    /// Random numbers that sample_light() uses: none if all light comes from one direction.
    [[nodiscard]] std::uint32_t dimensions() const { return dimensions_; }
    /// Picks a light and a direction to it. If there are lamps, lights are picked mostly by their
    /// irradiance at the point.
    /// @param p  local coordinates
    /// @param view  skies are sampled within it
    [[nodiscard]] LightSample sample_light(
        const Stream& stream,
        std::uint64_t point,
        std::uint32_t dimension,
        const Vec3& p,
        const FieldOfView& view = {}) const;

    /// The same, by numbers in [0, 1).
    [[nodiscard]] LightSample sample_light(
        double u0, double u1, const Vec3& p, const FieldOfView& view = {}) const;

    /// Whether the sampled point of a lamp is in the plane of a surface, to rounding: it neither
    /// lights the surface nor is occluded by it.
    [[nodiscard]] static bool is_in_plane(const LightSample& sample, const Vec3& normal);

    /// Adds to path.gathered the light that the surface scatters along `out`, times path.weights.
    /// Returns the rays cast.
    std::uint64_t add_light(
        const LightSample& sample,
        const Surface& surface,
        const Vec3& p,
        const Vec3& out,
        GatherScratch& path) const;

    /// Adds the radiance of the sky in direction `to_light`, for a narrow lobe.
    void add_sky(const Vec3& to_light, GatherScratch& path) const;

  private:
    /// A light picked by a random number.
    struct Pick {
        const BoundSource* light = nullptr;
        double u = 0;  ///< the number, rescaled to [0, 1)
        double probability = 1;
    };
    [[nodiscard]] Pick pick(double u, const Vec3& p) const;
    [[nodiscard]] double importance(std::size_t light, const Vec3& p) const;

    /// Irradiance for a spectrum of 1 in the units of the sums, over the probability of the light.
    [[nodiscard]] double scale_of(const BoundSource& light) const {
        return scale_ / (light.source_sampler->flux() * prepared_.projection().world_area());
    }

    const PreparedScene& prepared_;
    const Sampler& sampler_;
    const LampNearField& near_;
    double scale_, narrow_from_;
    std::uint32_t dimensions_;
    std::vector<LampExtent> lamps_;  // one for each light if picked by position, else empty
    LightSampler light_sampler_;     // if lights are picked independently of position
};

}  // namespace quasimc

#pragma once

#include <cstdint>
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
    double least_cosine = 0;  ///< of the angle from the normal; 0: all
};

/// A path that runs backwards, kept by each worker so that nothing is allocated on the way.
struct GatherScratch {
    explicit GatherScratch(std::size_t bands) {
        resize_apart(weights, bands);
        resize_apart(products, bands);
        resize_apart(gathered, bands);
        resize_apart(irradiance, bands);
    }
    std::vector<double> weights;   // per band: of what the path finds
    std::vector<double> gathered;  // per band: radiance found so far
    std::vector<double> products;
    std::vector<double> irradiance;  // per band: of a connection
};

/// Next-event estimation: samples lights from the vertices of a path that runs backwards.
class NextEvent {
  public:
    /// @param scale  irradiance counts in units of the flux of all lights over this area (square
    /// scene units)
    /// @param near  which light is not looked for
    /// @param narrow_from  peak_brightness() of lobes through which suns and lamps are not looked
    /// for
    /// @param points  a power of two: where lights are picked alike from everywhere, so many points
    /// of a set that is spread evenly pick each exactly as often as expected
    NextEvent(
        const PreparedScene& prepared,
        const Sampler& sampler,
        const LampNearField& near,
        double scale,
        double narrow_from,
        std::uint64_t points);

    /// Numbers that sample_light() draws: none if all light comes from one direction.
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

    /// Whether what is seen of a lamp lies in the plane of a surface, as near as can be told: it
    /// neither lights the surface nor is hidden by it.
    [[nodiscard]] static bool is_in_plane(const LightSample& sample, const Vec3& normal);

    /// Adds to path.gathered what the light sends by the surface along `out`, times path.weights.
    /// Returns the rays cast.
    std::uint64_t add_light(
        const LightSample& sample,
        const Surface& surface,
        const Vec3& p,
        const Vec3& out,
        GatherScratch& path) const;

    /// Adds the sky that a mirror shows in direction `to_light`.
    void add_sky(const Vec3& to_light, GatherScratch& path) const;

  private:
    /// A light that a number picks.
    struct Pick {
        const BoundSource* light = nullptr;
        double u = 0;  ///< what is left of the number
        double probability = 1;
    };
    [[nodiscard]] Pick pick(double u, const Vec3& p) const;
    [[nodiscard]] double importance(std::size_t light, const Vec3& p) const;

    /// Irradiance of spectrum 1 in our unit, over the probability of the light.
    [[nodiscard]] double scale_of(const BoundSource& light) const {
        return scale_ / (light.source_sampler->flux() * prepared_.projection().world_area());
    }

    const PreparedScene& prepared_;
    const Sampler& sampler_;
    const LampNearField& near_;
    double scale_, narrow_from_;
    std::uint32_t dimensions_;
    std::vector<LampExtent> lamps_;  // one for each light if picked by position, else empty
    LightSampler shares_;            // if lights are picked alike at all points
};

}  // namespace quasimc

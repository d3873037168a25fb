// A sky of any radiance L, scaled so that its irradiance on the horizontal is what was asked for:
// the scale is an integral over the shape itself, good to 1e-7, not the sum of a table.
//
// Light enters a scene through its box: along direction d through the area A(d) that the box shows
// there. A path draws its direction cell by cell of the hemisphere, in proportion to the integral
// of L A, uniformly inside the cell, then a place of the box as seen along it. Its weight is
// L A / (density x flux): the cells steer where paths start, never how much light they bring.

#include "quasimc/sources/sky.h"

#include <cmath>
#include <numeric>
#include <utility>

#include "quasimc/sources/entry.h"
#include "quasimc/sources/hemisphere.h"

namespace quasimc {
namespace {

double sum_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

/// A sky's sampler with the integral that its shares add up to.
struct Spread {
    HemisphereSampler sampler;
    double integral = 0;
};

Spread make_spread(const HemisphereGrid& grid, const HemisphereFunction& f) {
    const std::vector<double> integrals = cell_integrals(grid, f);
    return {HemisphereSampler(grid, integrals), sum_of(integrals)};
}

class SkyEmitter final : public Emitter {
  public:
    SkyEmitter(const HemisphereGrid& grid, Radiance radiance, const EntryBox& box)
        : radiance_(std::move(radiance)),
          box_(box),
          spread_(make_spread(grid, [this](const Vec3& d) { return entering(d); })) {}

    [[nodiscard]] double flux() const override { return spread_.integral; }
    [[nodiscard]] Emission emit(const std::array<double, 4>& u) const override {
        const HemisphereSampler::Sample from = spread_.sampler.sample(u[2], u[3]);
        const Vec3 direction = -from.direction;
        return {
            entry_place(box_, direction, u[0], u[1]), direction,
            entering(from.direction) / (from.pdf * spread_.integral)};
    }

  private:
    /// Light that enters the box from direction `d`, per steradian.
    [[nodiscard]] double entering(const Vec3& d) const {
        return radiance_(d) * box_.projected_area(d);
    }

    Radiance radiance_;
    EntryBox box_;
    Spread spread_;
};

class Sky final : public Source {
  public:
    Sky(std::string name, const SkyShape& shape, double scale, std::vector<double> spectrum)
        : Source(std::move(name), std::move(spectrum)),
          grid_(make_hemisphere_grid(shape.azimuths, shape.sines)),
          shape_(shape.radiance),
          scale_(scale),
          spread_(make_spread(grid_, shape_)) {}

    [[nodiscard]] std::unique_ptr<Emitter> make_emitter(const Aperture& aperture) const override {
        auto emitter = std::make_unique<SkyEmitter>(
            grid_, [shape = shape_, scale = scale_](const Vec3& d) { return scale * shape(d); },
            aperture.entry_box());
        return emitter->flux() > 0 ? std::move(emitter) : nullptr;
    }
    [[nodiscard]] Illumination illuminate(const Vec3&, double u0, double u1) const override {
        const HemisphereSampler::Sample from = spread_.sampler.sample(u0, u1);
        return {from.direction, scale_ * shape_(from.direction) / from.pdf};
    }
    [[nodiscard]] double radiance(const Vec3& to_light) const override {
        return to_light.z > 0 ? scale_ * shape_(to_light) : 0;
    }
    [[nodiscard]] bool is_directional() const override { return false; }
    [[nodiscard]] double horizontal_irradiance() const override { return 1; }

  private:
    HemisphereGrid grid_;
    Radiance shape_;
    double scale_;  // of the shape, so that its irradiance on the horizontal is 1
    Spread spread_;
};

}  // namespace

double horizontal_irradiance(const SkyShape& shape) {
    const HemisphereGrid grid = make_hemisphere_grid(shape.azimuths, shape.sines);
    return sum_of(cell_integrals(grid, [&](const Vec3& d) { return d.z * shape.radiance(d); }));
}

std::shared_ptr<const Source> make_sky(
    std::string name, const SkyShape& shape, std::vector<double> horizontal_irradiance) {
    const double own = quasimc::horizontal_irradiance(shape);
    if (!(own > 0)) {
        throw InputError({{name, "the sky is dark everywhere", "it can't bring any light", ""}});
    }
    return std::make_shared<Sky>(std::move(name), shape, 1 / own, std::move(horizontal_irradiance));
}

}  // namespace quasimc

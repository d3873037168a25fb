// A sky of any radiance L, scaled to the requested irradiance on the horizontal. The scale is an
// integral over the shape itself, with a relative error of 1e-7, not the sum of a table.
//
// Light enters a scene through its box: along direction d through the projected area A(d) of the
// box. A path draws a cell of the hemisphere in proportion to the integral of A times the radiance
// in the middle of the cell, a direction uniformly inside the cell, then a point of the box as seen
// along it. Its weight is L A / (density x flux): the cells only guide where paths start, so
// approximate shares suffice. The flux is exact: A is a sum of |d.x|, |d.y| and d.z, so the three
// integrals that give the scale give the flux too.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/lazy.h"
#include "light/models/entry.h"
#include "light/models/hemisphere.h"
#include "light/models/sky_integral.h"
#include "light/models/source.h"

namespace quasimc {
namespace {

/// Radiances of cells for sampling directions. Cells of a smooth sky that are dark in the middle
/// may have light at a corner: each gets at least a thousandth of the mean.
std::vector<double> steering_radiance(const HemisphereGrid& grid, const SkyShape& shape) {
    std::vector<double> radiance = radiance_of_cells(grid, shape.radiance);
    if (shape.inside == InsideCells::smooth) {
        const double sum = std::accumulate(radiance.begin(), radiance.end(), 0.0);
        const double least = 1e-3 * sum / static_cast<double>(radiance.size());
        for (double& value : radiance) {
            value = std::max(value, least);
        }
    }
    return radiance;
}

/// Draws directions in proportion to radiance times `factor` (row, column).
template <typename Factor>
HemisphereSampler make_sampler(HemisphereGrid grid, const SkyShape& shape, const Factor& factor) {
    std::vector<double> shares = steering_radiance(grid, shape);
    for (std::size_t row = 0; row < grid.rows(); ++row) {
        for (std::size_t column = 0; column < grid.columns(); ++column) {
            shares[row * grid.columns() + column] *= factor(row, column);
        }
    }
    return {std::move(grid), shares};
}

HemisphereSampler make_entry_sampler(const SkyShape& shape, const Vec3& face_area) {
    HemisphereGrid grid = make_hemisphere_grid(shape.azimuths, shape.sines);
    const ProjectedCells projected(grid);
    return make_sampler(std::move(grid), shape, [&](std::size_t row, std::size_t column) {
        return dot(face_area, projected.integral(row, column));
    });
}

HemisphereSampler make_point_sampler(const SkyShape& shape) {
    const HemisphereGrid grid = make_hemisphere_grid(shape.azimuths, shape.sines);
    return make_sampler(grid, shape, [&](std::size_t row, std::size_t column) {
        return grid.solid_angle(row, column);
    });
}

class SkySampler final : public SourceSampler {
  public:
    /// @param integrals  of L |d.x|, L |d.y|, L d.z, where L is the radiance of the shape
    SkySampler(const SkyShape& shape, const Vec3& integrals, const EntryBox& box)
        : SourceSampler(dot(box.face_area, integrals) / integrals.z),
          radiance_(shape.radiance),
          box_(box),
          unscaled_flux_(dot(box.face_area, integrals)),
          sampler_(make_entry_sampler(shape, box.face_area)) {}

    [[nodiscard]] Emission emit(const std::array<double, 4>& u) const override {
        const HemisphereSampler::Sample from = sampler_.sample(u[2], u[3]);
        const Vec3 direction = -from.direction;
        const double entering = radiance_(from.direction) * box_.projected_area(direction);
        return {
            entry_point(box_, direction, u[0], u[1]), direction,
            entering / (from.pdf * unscaled_flux_)};
    }
    [[nodiscard]] DirectionSample draw_direction(double u0, double u1) const override {
        const HemisphereSampler::Sample from = sampler_.sample(u0, u1);
        return {-from.direction, from.pdf};
    }
    [[nodiscard]] double density(const Vec3& direction) const override {
        return sampler_.pdf(-direction);
    }

  private:
    Radiance radiance_;
    EntryBox box_;
    double unscaled_flux_;  // of the shape before scaling
    HemisphereSampler sampler_;
};

class Sky final : public SourceModel {
  public:
    Sky(std::string name, SkyShape shape, std::vector<double> spectrum)
        : SourceModel(std::move(name), std::move(spectrum), kSkyTraits, 1),
          shape_(std::move(shape)) {}

    [[nodiscard]] ModelParameters parameters() const override {
        const HemisphereGrid grid = make_hemisphere_grid(shape_.azimuths, shape_.sines);
        std::vector<double> values = radiance_of_cells(grid, shape_.radiance);
        values.insert(values.end(), grid.azimuths.begin(), grid.azimuths.end());
        values.insert(values.end(), grid.sines.begin(), grid.sines.end());
        return {shape_.inside == InsideCells::smooth ? "sky" : "sky_of_cells", std::move(values)};
    }
    [[nodiscard]] std::unique_ptr<SourceSampler> make_sampler_in(
        const SceneProjection& projection) const override {
        const EntryBox& box = projection.entry_box();
        return dot(box.face_area, integrals()) > 0
                   ? std::make_unique<SkySampler>(shape_, integrals(), box)
                   : nullptr;
    }
    [[nodiscard]] Illumination illuminate(const Vec3&, double u0, double u1) const override {
        const HemisphereSampler& sampler =
            sampler_.get([this] { return make_point_sampler(shape_); });
        const HemisphereSampler::Sample from = sampler.sample(u0, u1);
        return {from.direction, radiance(from.direction) / from.pdf};
    }
    [[nodiscard]] double radiance(const Vec3& to_light) const override {
        return to_light.z > 0 ? shape_.radiance(to_light) / integrals().z : 0;
    }
    /// Triangle inequality over the components of the light's direction.
    [[nodiscard]] double most_irradiance(const Vec3& normal) const override {
        const Vec3 facing{std::abs(normal.x), std::abs(normal.y), std::max(0.0, normal.z)};
        return dot(facing, integrals()) / integrals().z;
    }

  private:
    [[nodiscard]] const Vec3& integrals() const {
        return integrals_.get([this] { return projected_radiance(shape_); });
    }

    SkyShape shape_;
    Lazy<Vec3> integrals_;
    Lazy<HemisphereSampler> sampler_;  // for illuminate()
};

/// Whether there is light anywhere: most skies have some in the first direction.
bool has_light(const SkyShape& shape) {
    const HemisphereGrid grid = make_hemisphere_grid(shape.azimuths, shape.sines);
    for (std::size_t row = 0; row < grid.rows(); ++row) {
        for (std::size_t column = 0; column < grid.columns(); ++column) {
            if (shape.radiance(grid.middle(row, column)) > 0) {
                return true;
            }
        }
    }
    return horizontal_irradiance(shape) > 0;
}

}  // namespace

double horizontal_irradiance(const SkyShape& shape) {
    return projected_radiance(shape).z;
}

std::shared_ptr<const Source> make_sky(
    std::string name, const SkyShape& shape, std::vector<double> horizontal_irradiance) {
    if (!has_light(shape)) {
        throw InputError({{name, "the sky is dark everywhere", "it can't give light", ""}});
    }
    return std::make_shared<Sky>(std::move(name), shape, std::move(horizontal_irradiance));
}

}  // namespace quasimc

// A sky of uniform radiance L = E / pi, where E is the irradiance on the horizontal.
//
// Light enters an open scene through the top and the four sides of its box. A path draws a face in
// proportion to the flux through it (E times the area of the top, E/2 times that of a side, which
// faces half of the sky), a point on the face, and a cosine-distributed direction about the face's
// normal: all paths carry the same light. A periodic scene has only the faces across open axes.

#include <algorithm>
#include <numbers>
#include <utility>

#include "base/distribution.h"
#include "light/models/hemisphere.h"
#include "light/models/source.h"

namespace quasimc {
namespace {

constexpr std::size_t kFaces = 5;  // top, low x, high x, low y, high y

/// Cumulative flux through the faces, for an irradiance of 1.
std::array<double, kFaces> summed_flux(const EntryBox& box) {
    const Vec3& area = box.face_area;
    std::array<double, kFaces> flux{area.z, 0.5 * area.x, 0.5 * area.x, 0.5 * area.y, 0.5 * area.y};
    double sum = 0;
    for (double& f : flux) {
        sum += f;
        f = sum;
    }
    return flux;
}

class UniformSkySampler final : public SourceSampler {
  public:
    explicit UniformSkySampler(const EntryBox& box)
        : SourceSampler(summed_flux(box).back()), box_(box), until_(summed_flux(box)) {}

    [[nodiscard]] Emission emit(const std::array<double, 4>& u) const override {
        const IntervalPick face = pick_interval(until_, u[0] * flux());
        return face.index == 0 ? from_top(face.part, u[1], u[2], u[3])
                               : from_side(face.index, face.part, u[1], u[2], u[3]);
    }

    /// Uniform over the sky; with the top face alone, cosine-distributed.
    [[nodiscard]] DirectionSample draw_direction(double u0, double u1) const override {
        const Vec3 to_light = has_sides() ? hemisphere_direction(2 * std::numbers::pi * u1, u0)
                                          : upward_cosine_direction(1 - u0, u1);
        return {-to_light, density(-to_light)};
    }
    [[nodiscard]] double density(const Vec3& direction) const override {
        if (direction.z >= 0) {
            return 0;
        }
        return has_sides() ? 0.5 / std::numbers::pi : -direction.z / std::numbers::pi;
    }

  private:
    [[nodiscard]] bool has_sides() const { return box_.face_area.x > 0 || box_.face_area.y > 0; }

    [[nodiscard]] Emission from_top(double u0, double u1, double u2, double u3) const {
        const Vec3 d = upward_cosine_direction(u2, u3);
        const Vec3 size = box_.bounds.size();
        const Vec3 origin{
            box_.bounds.low.x + u0 * size.x, box_.bounds.low.y + u1 * size.y, box_.bounds.high.z};
        return {origin, {d.x, d.y, -d.z}, 1};
    }

    [[nodiscard]] Emission from_side(
        std::size_t face, double u0, double u1, double u2, double u3) const {
        // Inward is +x before the axes are set; half of the azimuths, those from above, are used.
        const Vec3 d = upward_cosine_direction(u2, 0.5 * u3);  // y >= 0: from above
        const bool across_x = face <= 2;
        const bool high = face % 2 == 0;
        const double inward = high ? -d.z : d.z;
        const Vec3 size = box_.bounds.size();
        const Vec3& low = box_.bounds.low;
        const Vec3& top = box_.bounds.high;
        const double z = low.z + u1 * size.z;
        if (across_x) {
            return {{high ? top.x : low.x, low.y + u0 * size.y, z}, {inward, d.x, -d.y}, 1};
        }
        return {{low.x + u0 * size.x, high ? top.y : low.y, z}, {d.x, inward, -d.y}, 1};
    }

    EntryBox box_;
    std::array<double, kFaces> until_;
};

class UniformSky final : public SourceModel {
  public:
    UniformSky(std::string name, std::vector<double> horizontal_irradiance)
        : SourceModel(std::move(name), std::move(horizontal_irradiance), kSkyTraits, 1) {}

    [[nodiscard]] ModelParameters parameters() const override { return {"uniform_sky", {}}; }
    [[nodiscard]] std::unique_ptr<SourceSampler> make_sampler_in(
        const SceneProjection& projection) const override {
        auto sampler = std::make_unique<UniformSkySampler>(projection.entry_box());
        return sampler->flux() > 0 ? std::move(sampler) : nullptr;
    }
    /// Uniform over the upper half of the sphere: bounded for surfaces of any slope.
    [[nodiscard]] Illumination illuminate(const Vec3&, double u0, double u1) const override {
        const double radius = std::sqrt(std::max(0.0, 1 - u0 * u0));
        const double around = 2 * std::numbers::pi * u1;
        return {{radius * std::cos(around), radius * std::sin(around), u0}, 2};
    }
    [[nodiscard]] double radiance(const Vec3& to_light) const override {
        return to_light.z > 0 ? 1 / std::numbers::pi : 0;
    }
    [[nodiscard]] double most_irradiance(const Vec3& normal) const override {
        return 0.5 * (1 + normal.z);
    }
};

}  // namespace

std::shared_ptr<const Source> make_uniform_sky(
    std::string name, std::vector<double> horizontal_irradiance) {
    return std::make_shared<UniformSky>(std::move(name), std::move(horizontal_irradiance));
}

}  // namespace quasimc

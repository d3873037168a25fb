// Parallel light: the sun as a point of the sky, or one direction of a table.
//
// Paths start in the start area of the beam, the scene's silhouette; all carry the same light. The
// spectrum is the irradiance on a plane facing the light.

#include <algorithm>
#include <utility>

#include "base/checks.h"
#include "light/models/source.h"

namespace quasimc {
namespace {

class Beam final : public SourceSampler {
  public:
    Beam(const Vec3& direction, std::unique_ptr<BeamCrossSection> window)
        : SourceSampler(window->area(), direction),
          direction_(direction),
          window_(std::move(window)) {}

    [[nodiscard]] Emission emit(const std::array<double, 4>& u) const override {
        return {window_->point(u[0], u[1]), direction_, 1};
    }
    void beam_origins(
        std::span<const double> u0,
        std::span<const double> u1,
        std::span<Vec3> origins) const override {
        window_->points(u0, u1, origins);
    }

  private:
    Vec3 direction_;
    std::unique_ptr<BeamCrossSection> window_;
};

class Directional final : public SourceModel {
  public:
    /// @param travel  unit
    Directional(std::string name, const Vec3& travel, std::vector<double> spectrum)
        : SourceModel(std::move(name), std::move(spectrum), kBeamTraits, std::max(0.0, -travel.z)),
          travel_(travel) {}

    [[nodiscard]] ModelParameters parameters() const override {
        return {"directional", {travel_.x, travel_.y, travel_.z}};
    }
    [[nodiscard]] std::unique_ptr<SourceSampler> make_sampler_in(
        const SceneProjection& projection) const override {
        std::unique_ptr<BeamCrossSection> window = projection.cross_section(travel_);
        if (!window || window->area() <= 0) {
            return nullptr;
        }
        return std::make_unique<Beam>(travel_, std::move(window));
    }
    [[nodiscard]] Illumination illuminate(const Vec3&, double, double) const override {
        return {-travel_, 1};
    }
    [[nodiscard]] double radiance(const Vec3&) const override { return 0; }
    [[nodiscard]] double most_irradiance(const Vec3& normal) const override {
        return std::max(0.0, -dot(travel_, normal));
    }

  private:
    Vec3 travel_;
};

}  // namespace

std::shared_ptr<const Source> make_directional_source(
    std::string name, const Vec3& travel, std::vector<double> facing_irradiance) {
    EXPECT(is_finite(travel) && length(travel) > 0);
    return std::make_shared<Directional>(
        std::move(name), normalized(travel), std::move(facing_irradiance));
}

}  // namespace quasimc

#include <utility>

#include "base/checks.h"
#include "light/models/source.h"

namespace quasimc {
namespace {

std::vector<double> times(std::span<const double> spectrum, double factor) {
    std::vector<double> scaled(spectrum.begin(), spectrum.end());
    for (double& value : scaled) {
        value *= factor;
    }
    return scaled;
}

class ScaledSource final : public SourceModel {
  public:
    ScaledSource(std::shared_ptr<const Source> source, double factor)
        : SourceModel(
              source->name(),
              times(source->spectrum(), factor),
              source->traits(),
              source->horizontal_irradiance()),
          source_(std::move(source)),
          is_off_(factor == 0) {}

    [[nodiscard]] ModelParameters parameters() const override {
        return model_of(*source_).parameters();
    }
    [[nodiscard]] std::unique_ptr<SourceSampler> make_sampler_in(
        const SceneProjection& projection) const override {
        return is_off_ ? nullptr : model_of(*source_).make_sampler_in(projection);
    }
    [[nodiscard]] Illumination illuminate(const Vec3& point, double u0, double u1) const override {
        return model_of(*source_).illuminate(point, u0, u1);
    }
    [[nodiscard]] double radiance(const Vec3& to_light) const override {
        return model_of(*source_).radiance(to_light);
    }
    [[nodiscard]] double most_irradiance(const Vec3& normal) const override {
        return model_of(*source_).most_irradiance(normal);
    }

  private:
    std::shared_ptr<const Source> source_;
    bool is_off_;
};

}  // namespace

std::shared_ptr<const Source> make_dimmed(std::shared_ptr<const Source> source, double factor) {
    EXPECT(factor >= 0);
    return factor == 1 ? std::move(source)
                       : std::make_shared<const ScaledSource>(std::move(source), factor);
}

}  // namespace quasimc

#include "light/models/source.h"

#include "base/checks.h"

namespace quasimc {

Source::Source(
    std::string name,
    std::vector<double> spectrum,
    SourceTraits traits,
    double horizontal_irradiance)
    : name_(std::move(name)),
      spectrum_(std::move(spectrum)),
      traits_(traits),
      horizontal_irradiance_(horizontal_irradiance) {
    for (double& x : spectrum_) {
        x = x > 0 && x < kMinIrradiance ? 0 : x;
    }
}

DirectionSample SourceSampler::draw_direction(double, double) const {
    return {beam_direction().value_or(Vec3{}), 0};
}

double SourceSampler::density(const Vec3&) const {
    return 0;
}

std::optional<LampExtent> SourceSampler::lamp_extent() const {
    return std::nullopt;
}

void SourceSampler::beam_origins(
    std::span<const double> u0, std::span<const double> u1, std::span<Vec3> origins) const {
    EXPECT(beam_direction().has_value());
    for (std::size_t i = 0; i < origins.size(); ++i) {
        origins[i] = emit({u0[i], u1[i], 0, 0}).origin;
    }
}

}  // namespace quasimc

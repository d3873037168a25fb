#include "light/models/sky_basis.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "base/angles.h"
#include "base/checks.h"
#include "light/models/hemisphere.h"
#include "light/models/source.h"

namespace quasimc {
namespace {

constexpr double kQuarterTurn = kFullTurn / 4;
/// Iterations of the fit to a sky: the first gives the mean radiance under each basis function, the
/// others remove the blur of that mean.
constexpr int kFits = 5;
/// The grid on which skies are sampled, in equal steps of elevation and azimuth.
constexpr std::uint32_t kSampleRows = 60, kSampleColumns = 96;

double elevation_of(const Vec3& direction) {
    return std::asin(std::clamp(direction.z, 0.0, 1.0));
}

}  // namespace

SkyBasis::SkyBasis(std::uint32_t rings) : step_(kQuarterTurn / (rings - 0.5)), first_{0} {
    EXPECT(rings >= 2);
    for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
        const double around = kFullTurn * std::cos(elevation(ring)) / step_;
        const double count = std::max(4.0, std::round(around));
        first_.push_back(first_.back() + static_cast<std::uint32_t>(count));
    }
    first_.push_back(first_.back() + 1);  // the zenith
    set_samples();
}

double SkyBasis::elevation(std::uint32_t ring) const {
    return (ring + 0.5) * step_;
}

void SkyBasis::set_samples() {
    sampled_weight_.resize(nodes());
    sine_.resize(nodes());
    for (std::uint32_t row = 0; row < kSampleRows; ++row) {
        for (std::uint32_t column = 0; column < kSampleColumns; ++column) {
            const double elevation = kQuarterTurn * (row + 0.5) / kSampleRows;
            const double sine = std::sin(elevation);
            const Vec3 direction =
                hemisphere_direction(kFullTurn * (column + 0.5) / kSampleColumns, sine);
            samples_.push_back({direction, std::cos(elevation), shares(direction)});
            for (const Share& share : samples_.back().shares) {
                const double weight = samples_.back().weight * share.weight;
                sampled_weight_[share.node] += weight;
                sine_[share.node] += weight * sine;
            }
        }
    }
    for (std::uint32_t node = 0; node < nodes(); ++node) {
        sine_[node] /= sampled_weight_[node];
    }
}

void SkyBasis::put_ring(std::uint32_t ring, double weight, double azimuth, Share* to) const {
    const std::uint32_t count = in_ring(ring);
    const double turns = azimuth / kFullTurn;
    const double position = (turns - std::floor(turns)) * count;
    const auto below = std::min(static_cast<std::uint32_t>(position), count - 1);
    const double part = position - below;
    to[0] = {first_[ring] + below, weight * (1 - part)};
    to[1] = {first_[ring] + (below + 1) % count, weight * part};
}

std::array<SkyBasis::Share, 4> SkyBasis::shares(const Vec3& to_light) const {
    const auto last = static_cast<std::uint32_t>(first_.size() - 2);
    const double position = std::max(0.0, elevation_of(to_light) / step_ - 0.5);
    const std::uint32_t ring = std::min(static_cast<std::uint32_t>(position), last - 1);
    const double part = std::min(1.0, position - ring);
    const double azimuth = std::atan2(to_light.y, to_light.x);
    std::array<Share, 4> shares;
    put_ring(ring, 1 - part, azimuth, shares.data());
    put_ring(ring + 1, part, azimuth, shares.data() + 2);
    return shares;
}

SkyShape SkyBasis::basis_function(std::uint32_t node) const {
    const auto after = std::upper_bound(first_.begin(), first_.end(), node);
    const auto ring = static_cast<std::uint32_t>(after - first_.begin() - 1);
    SkyShape shape;
    for (const double height : {ring - 0.5, ring + 0.5, ring + 1.5}) {
        if (height > 0 && height * step_ < kQuarterTurn) {
            shape.sines.push_back(std::sin(height * step_));
        }
    }
    const double between = kFullTurn / in_ring(ring);
    for (int i = -1; i <= 1 && in_ring(ring) > 1; ++i) {
        const double azimuth = between * (static_cast<double>(node - first_[ring]) + i);
        shape.azimuths.push_back(azimuth - kFullTurn * std::floor(azimuth / kFullTurn));
    }
    std::sort(shape.azimuths.begin(), shape.azimuths.end());
    shape.radiance = [mesh = std::make_shared<const SkyBasis>(*this), node](const Vec3& to_light) {
        double sum = 0;
        for (const Share& share : mesh->shares(to_light)) {
            sum += share.node == node ? share.weight : 0;
        }
        return sum;
    };
    return shape;
}

std::vector<double> SkyBasis::fit(const Source& sky) const {
    std::vector<double> radiance, sky_radiance;
    for (const QuadratureNode& node : samples_) {
        sky_radiance.push_back(model_of(sky).radiance(node.direction));
    }
    radiance.assign(nodes(), 1);
    for (int i = 0; i < kFits; ++i) {
        std::vector<double> factors(nodes());
        for (std::size_t k = 0; k < samples_.size(); ++k) {
            double now = 0;
            for (const Share& share : samples_[k].shares) {
                now += share.weight * radiance[share.node];
            }
            const double factor = now > 0 ? samples_[k].weight * sky_radiance[k] / now : 0;
            for (const Share& share : samples_[k].shares) {
                factors[share.node] += share.weight * factor;
            }
        }
        for (std::uint32_t node = 0; node < nodes(); ++node) {
            radiance[node] *= factors[node] / sampled_weight_[node];
        }
    }
    return radiance;
}

std::vector<double> SkyBasis::light_of_sky(const Source& sky) const {
    std::vector<double> light = fit(sky);
    double sum = 0;
    for (std::uint32_t node = 0; node < nodes(); ++node) {
        light[node] *= sampled_weight_[node] * sine_[node];
        sum += light[node];
    }
    const double scale = sum > 0 ? sky.horizontal_irradiance() / sum : 0;
    std::transform(light.begin(), light.end(), light.begin(), [&](double x) { return x * scale; });
    return light;
}

std::array<SkyBasis::Share, 4> SkyBasis::light_of_beam(const Vec3& to_light) const {
    std::array<Share, 4> light = shares(to_light);
    for (Share& share : light) {
        share.weight *= sine_[share.node];
    }
    return light;
}

}  // namespace quasimc

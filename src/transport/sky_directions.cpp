#include "transport/sky_directions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/angles.h"
#include "base/checks.h"
#include "base/distribution.h"

namespace quasimc {

namespace {

/// Badly approximable numbers: of the golden, silver and bronze ratios, and another one that is
/// equivalent to the golden ratio.
constexpr std::array<double, 4> kNumbers{
    std::numbers::phi - 1, std::numbers::sqrt2 - 1, 0.30277563773199465, 0.27639320225002106};

}  // namespace

std::array<double, 2> hemisphere_lattice(
    std::uint32_t i, std::uint32_t count, const std::array<double, 3>& placing) {
    const auto part = [](double x) { return x - std::floor(x); };
    const double choice = 4 * placing[2];
    const double number = kNumbers[static_cast<std::size_t>(std::min(choice, 3.0))];
    const double first = part(static_cast<double>(i) / count + placing[0]);
    const double second = part(i * number + placing[1]);
    const double along = 2 * first - 1;
    const double about = std::numbers::pi * second;
    const double radius = std::sqrt(std::max(0.0, (1 - along) * (1 + along)));
    const double around =
        part(std::atan2(radius * std::cos(about), along) / kFullTurn + part(choice));
    constexpr double kAboveZero = 0x1p-53;  // on the horizon no sky has light
    return {
        std::clamp(radius * std::sin(about), kAboveZero, kBelowOne), std::min(around, kBelowOne)};
}

DirectionSample lattice_direction(
    const BoundSource& light,
    std::uint32_t i,
    std::uint32_t count,
    const std::array<double, 3>& placing) {
    const auto [u0, u1] = hemisphere_lattice(i, count, placing);
    const DirectionSample drawn = light.source_sampler->draw_direction(u0, u1);
    EXPECT(drawn.density > 0);
    return drawn;
}

SkyDirections::SkyDirections(const PreparedScene& prepared) {
    for (const BoundSource& light : prepared.lights()) {
        if (light.is_extended()) {
            skies_.push_back(&light);
            probability_ += light.probability;
        }
    }
}

template <typename Visit>
void SkyDirections::for_each_sky(std::uint32_t count, const Visit& visit) const {
    std::uint32_t first = 0;
    double until = 0;
    for (const BoundSource* sky : skies_) {
        until += sky->probability;
        const auto last = static_cast<std::uint32_t>(std::lround(count * until / probability_));
        visit(*sky, first, last);
        first = last;
    }
}

double SkyDirections::density(const Vec3& direction) const {
    double density = 0;
    for (const BoundSource* sky : skies_) {
        density += sky->source_sampler->density(direction) * sky->probability / probability_;
    }
    return density;
}

DirectionSample SkyDirections::direction(
    std::uint32_t i, std::uint32_t count, const std::array<double, 3>& placing) const {
    DirectionSample drawn;
    for_each_sky(count, [&](const BoundSource& sky, std::uint32_t first, std::uint32_t last) {
        if (i >= first && i < last) {
            drawn = lattice_direction(sky, i - first, last - first, placing);
        }
    });
    if (skies_.size() > 1) {
        drawn.density = 0;
        for_each_sky(count, [&](const BoundSource& sky, std::uint32_t first, std::uint32_t last) {
            drawn.density += sky.source_sampler->density(drawn.direction) * (last - first) / count;
        });
    }
    return drawn;
}

}  // namespace quasimc

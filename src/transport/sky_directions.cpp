#include "transport/sky_directions.h"

#include <cmath>
#include <numbers>

#include "base/checks.h"

namespace quasimc {

DrawnDirection lattice_direction(
    const BoundSource& light,
    std::uint32_t i,
    std::uint32_t count,
    const std::array<double, 2>& shift) {
    const double v = i * (std::numbers::phi - 1) + shift[1];
    const DrawnDirection drawn =
        light.source_sampler->draw_direction((i + shift[0]) / count, v - std::floor(v));
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

DrawnDirection SkyDirections::direction(
    std::uint32_t i, std::uint32_t count, const std::array<double, 2>& shift) const {
    DrawnDirection drawn;
    for_each_sky(count, [&](const BoundSource& sky, std::uint32_t first, std::uint32_t last) {
        if (i >= first && i < last) {
            drawn = lattice_direction(sky, i - first, last - first, shift);
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

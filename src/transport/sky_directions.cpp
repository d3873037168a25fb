#include "transport/sky_directions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "base/checks.h"
#include "base/distribution.h"
#include "sources/hemisphere.h"

namespace quasimc {

/// From a uniform quaternion (Shoemake 1992, "Uniform random rotations", Graphics Gems III).
Rotation random_rotation(const std::array<double, 3>& u) {
    const double low = std::sqrt(1 - u[0]);
    const double high = std::sqrt(u[0]);
    const double x = low * std::sin(kFullTurn * u[1]);
    const double y = low * std::cos(kFullTurn * u[1]);
    const double z = high * std::sin(kFullTurn * u[2]);
    const double w = high * std::cos(kFullTurn * u[2]);
    return {
        {1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
        {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
        {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
}

/// The hemisphere and its image on the other side of the origin cover the sphere, and the half of
/// both that is up after the turn holds one of each point and its image.
std::array<double, 2> rotated_lattice(
    std::uint32_t i, std::uint32_t count, const Rotation& rotation) {
    const double turns = i * (std::numbers::phi - 1);
    const Vec3 turned =
        rotation(hemisphere_direction(kFullTurn * (turns - std::floor(turns)), (i + 0.5) / count));
    const Vec3 up = turned.z < 0 ? -turned : turned;
    const double around = std::atan2(up.y, up.x) / kFullTurn;
    constexpr double kAboveZero = 0x1p-53;  // on the horizon no sky has light
    return {
        std::clamp(up.z, kAboveZero, kBelowOne),
        std::min(around < 0 ? around + 1 : around, kBelowOne)};
}

DrawnDirection lattice_direction(
    const BoundSource& light, std::uint32_t i, std::uint32_t count, const Rotation& rotation) {
    const auto [u0, u1] = rotated_lattice(i, count, rotation);
    const DrawnDirection drawn = light.source_sampler->draw_direction(u0, u1);
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
    std::uint32_t i, std::uint32_t count, const Rotation& rotation) const {
    DrawnDirection drawn;
    for_each_sky(count, [&](const BoundSource& sky, std::uint32_t first, std::uint32_t last) {
        if (i >= first && i < last) {
            drawn = lattice_direction(sky, i - first, last - first, rotation);
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

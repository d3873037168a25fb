#include "support/random_leaves.h"

#include <cmath>
#include <numbers>
#include <random>

#include "base/vec3.h"

namespace quasimc::test {

Triangle turned_leaf(Vec3 center, double edge, const std::array<double, 3>& rotation) {
    const double z = 2 * rotation[0] - 1;
    const double phi = 2 * std::numbers::pi * rotation[1];
    const double turn = 2 * std::numbers::pi * rotation[2];
    const double flat = std::sqrt(1 - z * z);
    const Frame frame = frame_about({flat * std::cos(phi), flat * std::sin(phi), z});
    const auto corner = [&](int k) {
        const double angle = turn + 2 * std::numbers::pi / 3 * k;
        const double radius = edge / std::numbers::sqrt3;
        return center + radius * (std::cos(angle) * frame.s + std::sin(angle) * frame.t);
    };
    return {corner(0), corner(1), corner(2)};
}

std::vector<Triangle> random_leaves(
    std::size_t count, double edge, double side, std::uint64_t seed) {
    std::mt19937_64 bits(seed);
    const auto uniform = [&] { return std::ldexp(static_cast<double>(bits() >> 11), -53); };
    std::vector<Triangle> leaves;
    leaves.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double x = side * uniform();
        const double y = side * uniform();
        const double z = side * uniform();
        leaves.push_back(turned_leaf({x, y, z}, edge, {uniform(), uniform(), uniform()}));
    }
    return leaves;
}

}  // namespace quasimc::test

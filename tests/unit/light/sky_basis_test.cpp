#include "light/models/sky_basis.h"

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "light/models/hemisphere.h"

namespace quasimc::test {
namespace {

std::vector<Vec3> some_directions() {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform;
    std::vector<Vec3> directions{{0, 0, 1}, normalized({1, 0, 1e-9}), normalized({-1, -1e-9, .3})};
    for (int i = 0; i < 500; ++i) {
        directions.push_back(hemisphere_direction(7 * uniform(random), uniform(random)));
    }
    return directions;
}

/// The weight of each basis function.
std::vector<double> weights_at(const SkyBasis& mesh, const Vec3& direction) {
    std::vector<double> weights(mesh.nodes());
    for (const SkyBasis::Share& share : mesh.shares(direction)) {
        EXPECT_GE(share.weight, 0);
        weights[share.node] += share.weight;
    }
    return weights;
}

TEST(SkyBasis, HasBasisFunctionsThatAddUpToOne) {
    for (const std::uint32_t rings : {2U, 5U, 9U}) {
        const SkyBasis mesh(rings);
        for (const Vec3& direction : some_directions()) {
            const std::vector<double> weights = weights_at(mesh, direction);
            EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), 1, 1e-12);
        }
    }
}

TEST(SkyBasis, GivesEachHatAsASky) {
    const SkyBasis mesh(4);
    for (std::uint32_t node = 0; node < mesh.nodes(); ++node) {
        const SkyShape basis_function = mesh.basis_function(node);
        for (const Vec3& direction : some_directions()) {
            EXPECT_EQ(basis_function.radiance(direction), weights_at(mesh, direction)[node]);
        }
    }
}

TEST(SkyBasis, IsContinuous) {
    const SkyBasis mesh(6);
    for (const Vec3& direction : some_directions()) {
        const Vec3 beside = normalized(direction + Vec3{1e-7, -2e-7, 1e-7});
        const std::vector<double> here = weights_at(mesh, direction);
        const std::vector<double> there = weights_at(mesh, beside);
        const double turn = 1e-5 / std::max(.01, std::hypot(direction.x, direction.y));
        for (std::size_t node = 0; node < here.size(); ++node) {
            EXPECT_NEAR(here[node], there[node], direction.z > .999 ? 1 : turn);
        }
    }
}

/// Each basis function gets the light of the sky below it, all together the light on the
/// horizontal.
TEST(SkyBasis, SharesOutTheLightOfASky) {
    const SkyBasis mesh(9);
    const auto uniform = make_uniform_sky("sky", {1});
    const std::vector<double> light = mesh.light_of_sky(*uniform);
    double sum = 0;
    for (std::uint32_t node = 0; node < mesh.nodes(); ++node) {
        sum += light[node];
        const double own = horizontal_irradiance(mesh.basis_function(node)) / std::acos(-1.0);
        EXPECT_NEAR(light[node], own, .02 * own) << node;
    }
    EXPECT_NEAR(sum, uniform->horizontal_irradiance(), 1e-12);
    const auto clear = make_sky("sky", cie_clear_shape(normalized({1, 0, 1})), {1});
    const std::vector<double> clear_light = mesh.light_of_sky(*clear);
    EXPECT_NEAR(
        std::accumulate(clear_light.begin(), clear_light.end(), 0.0),
        clear->horizontal_irradiance(), 1e-12);
    const auto at = mesh.shares(normalized({1, 0, 1}))[0].node;
    EXPECT_GT(clear_light[at], 3 * light[at]) << "about the sun";
}

TEST(SkyBasis, PutsABeamWhereItComesFrom) {
    const SkyBasis mesh(9);
    for (const Vec3& direction : some_directions()) {
        double horizontal = 0;
        for (const SkyBasis::Share& share : mesh.light_of_beam(direction)) {
            horizontal += share.weight;
        }
        // The mean height of basis functions, 11 degrees wide to either side.
        EXPECT_NEAR(horizontal, std::max(direction.z, .09), .06);
    }
}

}  // namespace
}  // namespace quasimc::test

// The sunlit and the shaded part of black leaves, against closed forms of a random canopy.
//
// With spherical leaf angles a sun at zenith angle t reaches the fraction exp(-k L) of the leaf
// area at depth L, k = 1 / (2 cos t); L is the leaf area above it per area of ground. A uniform sky
// of irradiance 1 gives that area the light E2(L / 2), the exponential integral: the derivative of
// its transmittance 2 E3(L / 2). Leaves in layers are organs, all layers together are a group.
//
// Leaves fall independently in x and y, which the closed form needs. Their depths and angles are
// even instead, so that few canopies have the mean of many.

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>

#include <fmt/format.h>

#include "base/vec3.h"
#include "statistical/canopies.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

using Q = SunShadeQuantity;

constexpr std::size_t kSunLayers = 10, kSmallLeaves = 65536;
constexpr double kLeafAreaIndex = 2, kAreaOfLayer = kLeafAreaIndex / kSunLayers;

/// Leaves in the unit cube from the lowest to the highest: equilateral triangles with uniform x and
/// y, depths in equal strata and rotations by a Kronecker sequence (powers of the root of
/// g^4 = g + 1), which is even over each layer.
std::vector<Triangle> even_leaves(std::size_t count, double edge, std::uint64_t seed) {
    std::mt19937_64 bits(seed);
    const auto uniform = [&] { return std::ldexp(static_cast<double>(bits() >> 11), -53); };
    constexpr double kRoot = 1.2207440846057596;
    std::array<double, 3> rotation = {uniform(), uniform(), uniform()};
    std::vector<Triangle> leaves;
    leaves.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double x = uniform(), y = uniform();
        const double z = (static_cast<double>(i) + uniform()) / static_cast<double>(count);
        leaves.push_back(turned_leaf({x, y, z}, edge, rotation));
        for (std::size_t k = 0; k < 3; ++k) {
            rotation.at(k) =
                std::fmod(rotation.at(k) + std::pow(kRoot, -1 - static_cast<double>(k)), 1);
        }
    }
    return leaves;
}

/// Black leaves of a periodic canopy of height 1; organ 0 is the highest layer.
Scene make_layered_canopy(std::uint64_t seed) {
    const double area = kLeafAreaIndex * kCellArea / kSmallLeaves;
    const double edge = std::sqrt(area * 4 / std::numbers::sqrt3);
    std::array<std::vector<Triangle>, kSunLayers> layers;
    for (const Triangle& leaf : even_leaves(kSmallLeaves, edge, seed)) {
        const double depth = 1 - (leaf[0] + leaf[1] + leaf[2]).z / 3;
        const auto layer = static_cast<std::size_t>(std::max(0.0, depth * kSunLayers));
        layers.at(std::min(layer, kSunLayers - 1)).push_back(leaf);
    }
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    for (std::size_t i = 0; i < kSunLayers; ++i) {
        builder.add_organ(organ("layer", "black", layers.at(i)));
    }
    GroundSpec soil = ground("black");
    soil.height = -edge;
    builder.set_ground(soil);
    const double size = std::sqrt(kCellArea);
    builder.set_cell({.along_x = true, .along_y = true, .size_x = size, .size_y = size});
    return std::move(builder).build();
}

/// The mean of a function over [low, high], by Simpson's rule.
double mean_over(double low, double high, const std::function<double(double)>& f) {
    constexpr int kSteps = 200;
    double sum = f(low) + f(high);
    for (int i = 1; i < kSteps; ++i) {
        sum += (i % 2 == 0 ? 2 : 4) * f(low + (high - low) * i / kSteps);
    }
    return sum / (3 * kSteps);
}

/// The light of a uniform sky at a depth: the integral of exp(-L / (2 mu)) over mu in [0, 1].
double skylight(double depth) {
    return mean_over(0, 1, [&](double mu) { return mu > 0 ? std::exp(-depth / (2 * mu)) : 0; });
}

/// The closed form of a layer, or of all.
struct Layer {
    double sunlit_fraction = 0, shaded = 0;
};

Layer layer_of(std::size_t index, double k) {
    const double low = static_cast<double>(index) * kAreaOfLayer, high = low + kAreaOfLayer;
    return {
        mean_over(low, high, [&](double depth) { return std::exp(-k * depth); }),
        mean_over(low, high, skylight)};
}

/// Light on sunlit and on shaded area of all layers, without the beam.
struct OtherLight {
    double on_sunlit = 0, on_shaded = 0, mean = 0;
};

OtherLight other_light(double k) {
    OtherLight light;
    double lit = 0;
    for (std::size_t i = 0; i < kSunLayers; ++i) {
        const Layer layer = layer_of(i, k);
        lit += layer.sunlit_fraction;
        light.on_sunlit += layer.sunlit_fraction * layer.shaded;
        light.on_shaded += (1 - layer.sunlit_fraction) * layer.shaded;
        light.mean += layer.shaded / kSunLayers;
    }
    light.on_sunlit /= lit;
    light.on_shaded /= kSunLayers - lit;
    return light;
}

/// One run of each canopy. @returns fraction, sunlit and shaded light of three layers; then
/// sunlit and shaded light of all
std::vector<double> numbers_of(std::uint64_t seed, double zenith_deg) {
    RunSpec spec = spec_of(Method::first_hits, 1 << 18);
    spec.replicates = 2;
    spec.seed = seed;
    spec.sun_shade = SunShade::apart;
    const Result result = run(make_layered_canopy(seed), {sun(zenith_deg, {2}), sky({1})}, spec);
    std::vector<double> numbers;
    for (const std::size_t layer : {0, 4, 9}) {
        numbers.push_back(result.sunlit_fraction[layer].mean);
        numbers.push_back(result.sun_shade.at(layer, Q::absorbed_flux_density_sunlit).mean);
        numbers.push_back(result.sun_shade.at(layer, Q::absorbed_flux_density_shaded).mean);
    }
    const SunShadeLight& all = result.groups.sun_shade;
    numbers.push_back(all.at(0, Q::absorbed_flux_density_sunlit).mean);
    numbers.push_back(all.at(0, Q::absorbed_flux_density_shaded).mean);
    return numbers;
}

TEST(SunShadeCanopy, HasTheClosedFormOfSphericalLeafAngles) {
    constexpr double kZenith = 40;
    const double k = 1 / (2 * std::cos(kZenith * std::numbers::pi / 180));
    // A beam of 2 falls on leaves turned all ways: half of it on average.
    constexpr double kBeam = 1;
    const std::vector<Measured> found =
        over_seeds(48, [&](std::uint64_t seed) { return numbers_of(seed, kZenith); });
    std::size_t next = 0;
    for (const std::size_t index : {0, 4, 9}) {
        const Layer layer = layer_of(index, k);
        const std::string name = fmt::format("random canopy, layer {} of 10, ", index + 1);
        EXPECT_TRUE(
            holds({name + "sunlit fraction", layer.sunlit_fraction, .004, 11}, found[next]));
        EXPECT_TRUE(
            holds({name + "sunlit light", kBeam + layer.shaded, .008, 11}, found[next + 1]));
        EXPECT_TRUE(holds({name + "shaded light", layer.shaded, .005, 11}, found[next + 2]));
        next += 3;
    }
    const OtherLight light = other_light(k);
    EXPECT_TRUE(
        holds({"random canopy, sunlit light", kBeam + light.on_sunlit, .0014, 11}, found[next]));
    EXPECT_TRUE(holds({"random canopy, shaded light", light.on_shaded, .001, 11}, found[next + 1]));
    // A control: the mean of all leaves' skylight is neither that of sunlit nor of shaded area.
    EXPECT_FALSE(agrees(found[next], kBeam + light.mean, .01));
    EXPECT_FALSE(agrees(found[next + 1], light.mean, .01));
}

}  // namespace
}  // namespace quasimc::test

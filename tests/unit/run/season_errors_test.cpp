#include <cmath>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "series/basis/interpolation_errors.h"

namespace quasimc::test {
namespace {

constexpr std::size_t kRegions = 200, kReplicatesOfLight = 4;

BasisLayout layout_of_regions() {
    return {kRegions, 1};
}

/// Direct light on regions, the second half ten times as bright, times a factor, with relative
/// noise.
LightSum light(double factor, double noise, std::mt19937_64& random) {
    const BasisLayout layout = layout_of_regions();
    std::normal_distribution<double> normal;
    LightResponse response{
        std::vector<std::vector<float>>(kReplicatesOfLight, std::vector<float>(layout.bins())),
        {1}};
    for (std::vector<float>& bins : response.bins) {
        for (std::size_t region = 0; region < kRegions; ++region) {
            const double bright = region < kRegions / 2 ? 1 : 10;
            bins[BinIndex(layout).of(layout.light.direct(region, SurfaceSide::upper, 0))] =
                static_cast<float>(bright * factor * (1 + noise * normal(random)));
        }
    }
    LightSum sum(layout, kReplicatesOfLight);
    sum.add(response, std::vector<double>{1, 1});
    return sum;
}

/// The errors of a dim and of a bright region.
std::pair<double, double> errors_told(double noise, double off) {
    std::mt19937_64 random(3);
    InterpolationErrors errors(layout_of_regions());
    constexpr int kTimes = 12;
    for (int i = 0; i < kTimes; ++i) {
        const double sign = i % 2 == 0 ? 1 : -1;
        errors.add(light(1 + sign * off, noise, random), light(1, noise, random));
    }
    const std::vector<double> reported = errors.relative();
    const BasisLayout layout = layout_of_regions();
    const auto at = [&](std::size_t region) {
        return reported[BinIndex(layout).of(layout.light.direct(region, SurfaceSide::upper, 0))];
    };
    return {at(0), at(kRegions - 1)};
}

TEST(InterpolationErrors, AreWhatLightIsOff) {
    const auto [dim, bright] = errors_told(0, .05);
    EXPECT_NEAR(dim, .05, 1e-6);
    EXPECT_NEAR(bright, .05, 1e-6);
}

/// The noise of a difference is 7 % here.
TEST(InterpolationErrors, HoldNoNoise) {
    const auto [dim, bright] = errors_told(.1, 0);
    EXPECT_LT(dim, .035);
    EXPECT_LT(bright, .035);
    EXPECT_GT(errors_told(.1, .05).first, .04) << "a control";
    EXPECT_LT(errors_told(.1, .05).first, .065);
}

}  // namespace
}  // namespace quasimc::test

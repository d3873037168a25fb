#include "optics/phong.h"

#include <numbers>

#include <gtest/gtest.h>

#include "optics/catalogue.h"
#include "optics_testing.h"

namespace quasimc::test {
namespace {

TEST(Phong, HasTheDensityOfItsEquationAndFoldsWhatLeavesOnTheWrongSide) {
    const auto bsdf = make_phong(Hemisphere::reflected, 2);
    const Vec3 n{0, 0, 1};
    const double scale = 3 / (2 * std::numbers::pi);
    EXPECT_DOUBLE_EQ(bsdf->pdf(n, {0, 0, -1}, {0.6, 0, 0.8}), scale * 0.64);
    // The mirror direction is (0.8, 0, 0.6); the image of wo = (0.96, 0, 0.28) is 53.1 degrees off.
    const double p = scale * 0.936 * 0.936;
    const double image = scale * 0.6 * 0.6;
    EXPECT_NEAR(bsdf->pdf(n, {0.8, 0, -0.6}, {0.96, 0, 0.28}), p + image, 1e-15);
}

TEST(Phong, KeepsItsDigitsUpToTheLargestExponent) {
    for (const double n : {1e3, 1e5, kMaxExponent}) {
        const auto bsdf = make_phong(Hemisphere::reflected, n);
        expect_density_at_samples(*bsdf, (n + 1) / (2 * std::numbers::pi), n / (n + 1));
    }
}

}  // namespace
}  // namespace quasimc::test

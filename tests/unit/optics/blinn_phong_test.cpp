#include "optics/blinn_phong.h"

#include <numbers>

#include <gtest/gtest.h>

#include "optics/catalogue.h"
#include "optics_testing.h"

namespace quasimc::test {
namespace {

TEST(BlinnPhong, HasTheDensityOfItsEquationAndFoldsWhatLeavesOnTheWrongSide) {
    const auto bsdf = make_blinn_phong(Hemisphere::transmitted, 2);
    const Vec3 n{0, 0, 1};
    const double scale = 4 / (8 * std::numbers::pi);
    // Half angles: cos^2 = (1 + cos) / 2.
    const double p = scale * (1 + 0.936) / 2;
    const double image = scale * (1 + 0.6) / 2;
    EXPECT_NEAR(bsdf->pdf(n, {0.8, 0, -0.6}, {0.96, 0, -0.28}), p + image, 1e-15);
}

TEST(BlinnPhong, KeepsItsDigitsUpToTheLargestExponent) {
    for (const double n : {1e3, 1e5, kMaxExponent}) {
        const auto bsdf = make_blinn_phong(Hemisphere::reflected, n);
        expect_density_at_samples(*bsdf, (n + 2) / (8 * std::numbers::pi), n / (n + 2));
    }
}

}  // namespace
}  // namespace quasimc::test

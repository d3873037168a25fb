// What is special to the lobe that is cut off at the surface; models_test.cpp tries it over a grid
// like every model.

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "optics/blinn_phong.h"
#include "optics/catalogue.h"
#include "optics_testing.h"

namespace quasimc::test {
namespace {

constexpr double kPi = std::numbers::pi;

std::unique_ptr<Bsdf> clipped(Hemisphere hemisphere, double exponent) {
    return find_bsdf("clipped_blinn_phong")->make(hemisphere, std::array{exponent});
}

TEST(ClippedBlinnPhong, HasTheDensityOfItsEquation) {
    const auto bsdf = clipped(Hemisphere::reflected, 2);
    const Vec3 n{0, 0, 1};
    // Straight on all circles are whole up to 90 degrees: K = 1 - cos^4(45 degrees) = 3/4.
    EXPECT_NEAR(
        bsdf->pdf(n, {0, 0, -1}, {0.6, 0, 0.8}), 4 / (8 * kPi * 0.75) * (1 + 0.8) / 2, 1e-15);
    // The axis is (0.8, 0, 0.6): K = 1 - ((1 - 0.8) / 2)^2. Straight up, 53.13 degrees from it, is
    // beyond its elevation of 36.87: H = pi - acos(tan(alpha) cos(theta) / sin(theta)).
    const double within = 1 - 0.1 * 0.1;
    const double arc = kPi - std::acos(0.75 * 0.6 / 0.8);
    EXPECT_NEAR(bsdf->pdf(n, {0.8, 0, -0.6}, n), 4 / (8 * arc * within) * (1 + 0.6) / 2, 1e-15);
}

TEST(ClippedBlinnPhong, DrawsTheAngleAsTheOriginalProgram) {
    const double exponent = 10, u0 = 0.7;
    const Vec3 n{0, 0, 1}, wi{0.8, 0, -0.6}, axis = {0.8, 0, -0.6};
    const auto bsdf = clipped(Hemisphere::transmitted, exponent);
    const double alpha = std::asin(0.6);
    const double xi = u0 * (1 - std::pow(std::cos((kPi - alpha) / 2), exponent + 2));
    const double theta = 2 * std::acos(std::pow(1 - xi, 1 / (exponent + 2)));
    for (const double u1 : {0.0, 0.2, 0.5, 0.9}) {
        EXPECT_NEAR(std::acos(dot(bsdf->sample(n, wi, u0, u1), axis)), theta, 1e-12);
    }
}

TEST(ClippedBlinnPhong, IsBlinnPhongWhereNothingIsCutOff) {
    const auto narrow = clipped(Hemisphere::reflected, 2000);
    const auto folded = make_blinn_phong(Hemisphere::reflected, 2000);
    const Vec3 n{0, 0, 1}, wi{0.6, 0, -0.8};
    for (const Vec3& wo : {Vec3{0.6, 0, 0.8}, Vec3{0.64, 0, std::sqrt(1 - 0.64 * 0.64)}}) {
        EXPECT_NEAR(narrow->pdf(n, wi, wo), folded->pdf(n, wi, wo), 1e-9 * folded->pdf(n, wi, wo));
    }
}

TEST(ClippedBlinnPhong, IsNotSymmetric) {
    const auto bsdf = clipped(Hemisphere::reflected, 1);
    const Vec3 n{0, 0, 1}, wi{0.8, 0, -0.6}, wo{0, 0.28, 0.96};
    const double forth = bsdf->pdf(n, wi, wo), back = bsdf->pdf(n, -wo, -wi);
    EXPECT_GT(std::abs(forth - back), 0.05 * forth);
}

TEST(ClippedBlinnPhong, KeepsItsDigitsUpToTheLargestExponent) {
    for (const double n : {1e3, 1e5, kMaxExponent}) {
        const auto bsdf = clipped(Hemisphere::reflected, n);
        expect_density_at_samples(*bsdf, (n + 2) / (8 * kPi), n / (n + 2));
    }
}

}  // namespace
}  // namespace quasimc::test

#include "optics/lambertian.h"

#include <numbers>

#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

TEST(Lambertian, SendsTheSameWhereverLightCameFrom) {
    const auto bsdf = make_lambertian(Hemisphere::reflected);
    const Vec3 n{0, 0, 1};
    EXPECT_DOUBLE_EQ(bsdf->pdf(n, {0, 0, -1}, {0.6, 0, 0.8}), 0.8 / std::numbers::pi);
    EXPECT_DOUBLE_EQ(bsdf->pdf(n, {0.6, 0, -0.8}, {0.6, 0, 0.8}), 0.8 / std::numbers::pi);
    EXPECT_DOUBLE_EQ(bsdf->bsdf(n, {0, 0, -1}, {1, 0, 0}), 1 / std::numbers::pi);
}

}  // namespace
}  // namespace quasimc::test

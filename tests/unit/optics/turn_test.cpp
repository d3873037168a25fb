#include "optics/turn.h"

#include <cmath>

#include <gtest/gtest.h>

#include "optics/directions.h"
#include "optics_testing.h"

namespace quasimc::test {
namespace {

TEST(SinCosTurn, IsRightToTheLastDigits) {
    constexpr long double kFullTurn = 6.283185307179586476925286766559005768L;
    Random random(1);
    for (int i = 0; i < 100000; ++i) {
        const double u = i < 1024 ? i / 1024.0 : random();
        const auto [sine, cosine] = sin_cos_turn(u);
        EXPECT_NEAR(sine, static_cast<double>(std::sin(kFullTurn * u)), 2e-15);
        EXPECT_NEAR(cosine, static_cast<double>(std::cos(kFullTurn * u)), 2e-15);
    }
}

TEST(SinCosTurn, IsExactAtTheQuarters) {
    const std::array<SinCos, 4> expected{{{0, 1}, {1, 0}, {0, -1}, {-1, 0}}};
    for (std::size_t i = 0; i < 4; ++i) {
        const auto [sine, cosine] = sin_cos_turn(static_cast<double>(i) / 4);
        EXPECT_EQ(sine, expected[i].sin);
        EXPECT_EQ(cosine, expected[i].cos);
    }
}

TEST(SinCosTurn, IsContinuousWhereTheCircleCloses) {
    const auto [sine, cosine] = sin_cos_turn(1 - 0x1p-53);
    EXPECT_NEAR(sine, -6.98e-16, 1e-18);
    EXPECT_EQ(cosine, 1);
}

TEST(CosineDirection, MapsTheSquareToCosineAndAzimuth) {
    for (const Vec3& n : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, normalized({1, 2, -3})}) {
        for (const double u0 : {0.0, 0.25, 0.5, 1 - 0x1p-53}) {
            for (const double u1 : {0.0, 0.2, 0.7}) {
                const Vec3 d = cosine_direction(n, u0, u1);
                EXPECT_NEAR(length(d), 1, 1e-15);
                EXPECT_NEAR(dot(d, n), std::sqrt(1 - u0), 1e-15);
                EXPECT_GT(dot(d, n), 0);
                const double turns = point_of(n, d).t - u1;
                EXPECT_NEAR(u0 > 0 ? turns - std::round(turns) : 0, 0, 1e-12);
            }
        }
    }
}

}  // namespace
}  // namespace quasimc::test

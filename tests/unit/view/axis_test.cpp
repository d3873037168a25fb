#include "view/axis.h"

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

TEST(Axis, OfPowersSpreadsThemEvenly) {
    const Axis axis = logarithmic_axis_about(.03, 40, "error");
    EXPECT_DOUBLE_EQ(axis.low, .02);
    EXPECT_DOUBLE_EQ(axis.high, 50);
    EXPECT_DOUBLE_EQ(axis.part(.02), 0);
    EXPECT_DOUBLE_EQ(axis.part(50), 1);
    EXPECT_NEAR(axis.part(2) - axis.part(.2), axis.part(.2) - axis.part(.02), 1e-12);
}

TEST(Axis, OfPowersHasRoundTicks) {
    const Axis few{10, 500, "", true};
    EXPECT_EQ(
        texts_of(few, ticks_of(few, 8)),
        (std::vector<std::string>{"10", "20", "50", "100", "200", "500"}));
    const Axis many{.01, 1e4, "", true};
    EXPECT_EQ(ticks_of(many, 8).size(), 7U);
}

TEST(Axis, OfPowersOfNothingIsWhole) {
    for (const auto& [low, high] : {std::pair(0., 1.), {-1., 1.}, {2., 1.}}) {
        const Axis axis = logarithmic_axis_about(low, high, "");
        EXPECT_EQ(axis.low, 1);
        EXPECT_EQ(axis.high, 10);
    }
    const Axis one = logarithmic_axis_about(7, 7, "");
    EXPECT_LT(one.low, one.high);
    EXPECT_GE(one.high, 7);
}

}  // namespace
}  // namespace quasimc::test

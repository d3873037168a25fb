// The rules of lamps under control.

#include "series/control_rules.h"

#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

constexpr double kSeconds = 3600;

LampFactor factor_of(
    const LampControl& control, const ControlledLight& light, const DaySoFar& day = {}) {
    return lamp_factor(control, light, kSeconds, day);
}

void expect_factor(const LampFactor& decided, double factor, double on) {
    EXPECT_DOUBLE_EQ(decided.factor, factor);
    EXPECT_DOUBLE_EQ(decided.on, on);
}

TEST(ControlRules, SwitchOffInBrightDaylight) {
    const LampControl control{.on_below = 150};
    expect_factor(factor_of(control, {.daylight = 149, .lamps = 100}), 1, 1);
    expect_factor(factor_of(control, {.daylight = 150, .lamps = 100}), 0, 0);
    // Light of other lamps is no daylight.
    expect_factor(factor_of(control, {.daylight = 0, .other_lamps = 500, .lamps = 100}), 1, 1);
}

TEST(ControlRules, DimToASetPointOfAllLight) {
    const LampControl control{.set_point = 250, .dim_min = .1};
    expect_factor(factor_of(control, {.daylight = 100, .other_lamps = 50, .lamps = 200}), .5, 1);
    expect_factor(factor_of(control, {.daylight = 100, .lamps = 100}), 1, 1);
    expect_factor(factor_of(control, {.daylight = 300, .lamps = 100}), 0, 0);
}

TEST(ControlRules, SwitchOffBelowTheSmallestFactor) {
    const LampControl control{.set_point = 250, .dim_min = .25};
    expect_factor(factor_of(control, {.daylight = 200, .lamps = 200}), .25, 1);
    expect_factor(factor_of(control, {.daylight = 201, .lamps = 200}), 0, 0);
}

TEST(ControlRules, EndWithinATimeAtTheDailyTarget) {
    const LampControl control{.daily_target = 1e6};
    const ControlledLight light{.daylight = 50, .lamps = 150};  // 720,000 in an hour
    expect_factor(factor_of(control, light, {.light = 1e5}), 1, 1);
    const LampFactor last = factor_of(control, light, {.light = 1e6 - 360000});
    expect_factor(last, .5, .5);
    EXPECT_TRUE(last.reaches_target);
    expect_factor(factor_of(control, light, {.light = 2e6}), 0, 0);
    // Rounding of the sum does not switch them on again.
    expect_factor(factor_of(control, light, {.light = 999999, .is_reached = true}), 0, 0);
}

TEST(ControlRules, NarrowOneAnother) {
    const LampControl control{.on_below = 120, .daily_target = 1e6, .set_point = 200};
    const ControlledLight light{.daylight = 100, .lamps = 200};  // dimmed to 0.5: 720,000 an hour
    const LampFactor last = factor_of(control, light, {.light = 1e6 - 180000});
    expect_factor(last, .125, .25);
    expect_factor(factor_of(control, {.daylight = 130, .lamps = 200}), 0, 0);
}

TEST(ControlRules, KeepDarkLampsOff) {
    expect_factor(factor_of({.set_point = 250}, {.daylight = 100}), 0, 0);
    expect_factor(factor_of({.on_below = 250}, {}), 0, 0);
}

}  // namespace
}  // namespace quasimc::test

// [[control]]: its reader, and lamps that it switches and dims.

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "quasimc/run_file.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

constexpr double kAtSensor = 100;  // W m-2 of one lamp
constexpr double kHour = 3600;

/// A lamp 2 m above a sensor, which gets kAtSensor from it. @param factor  on its power
std::string lamp(const std::string& name, const std::string& keys, double factor = 1) {
    return fmt::format(
        "[[source]]\ntype = 'point'\nname = '{}'\nposition = [5, 5, 2]\npower = {:.17g}\n{}\n",
        name, factor * kAtSensor * 16 * std::numbers::pi, keys);
}

/// A black leaf, lamps and the sensor "bench" on a day of December.
std::string room(
    const std::string& lamps,
    const std::string& rest,
    const std::string& time = "day = '2024-12-15'\nutc_offset_hours = 1\n",
    const std::string& run = "") {
    RunText text;
    text.top = "bands = ['PAR', 'NIR']\nlength_unit = 'm'\n";
    text.run = "[run]\npaths = 256\nmethod = 'light_tracing'\n" + run;
    text.sources = lamps;
    text.rest =
        "[[sensors]]\nname = 'bench'\nat = [[5, 5, 0]]\n[site]\nlatitude_deg = 52\n"
        "longitude_deg = 6\n[time]\n" +
        time + rest;
    return text.text();
}

std::string control(const std::string& keys, const std::string& sources = "hps") {
    return fmt::format("[[control]]\nsources = '{}'\nsensors = 'bench'\n{}\n", sources, keys);
}

RunFile controlled(const std::string& text) {
    RunFile run = read_text(text);
    Simulator simulator;
    static_cast<void>(time_steps_of(run, simulator));
    return run;
}

const ControlOutcome& outcome_of(const RunFile& run, std::size_t index = 0) {
    return run.series->outcomes.at(index);
}

TEST(RunFileControl, IsRead) {
    const RunFile run = read_text(room(
        lamp("hps 1", "") + lamp("hps 2", ""),
        control(
            "on_below = 150\ndaily_target = 14\nset_point = 250\ndim_min = 0.2\n"
            "electrical_power_w = 640\nband = 'NIR'",
            "hps *")));
    ASSERT_EQ(run.series->controls.size(), 1U);
    const LampControl& read = run.series->controls[0];
    EXPECT_EQ(read.sources, "hps *");
    EXPECT_EQ(read.sensors, "bench");
    EXPECT_EQ(read.band, 1U);
    EXPECT_EQ(read.on_below, 150);
    EXPECT_EQ(read.daily_target, 14) << "J m-2";
    EXPECT_EQ(read.set_point, 250);
    EXPECT_EQ(read.dim_min, .2);
    EXPECT_EQ(read.electrical_power_w, 640);
    EXPECT_TRUE(run.series->outcomes.empty()) << "nothing is computed by reading";
}

TEST(RunFileControl, TakesDailyTargetsOfPhotonsInMol) {
    RunText text;
    text.top =
        "length_unit = 'm'\n[[band]]\nname = 'PPFD'\nunit = 'umol m-2 s-1'\nfrom_nm = 400\nto_nm = "
        "700\n";
    text.sources =
        "[[source]]\ntype = 'point'\nname = 'hps'\nposition = [5, 5, 2]\n"
        "photon_flux = 100\n";
    text.rest =
        "[[sensors]]\nname = 'bench'\nat = [[5, 5, 0]]\n[site]\nlatitude_deg = 52\n"
        "longitude_deg = 6\n[time]\nday = '2024-12-15'\nutc_offset_hours = 1\n" +
        control("daily_target = 14");
    EXPECT_DOUBLE_EQ(read_text(text.text()).series->controls.at(0).daily_target.value(), 14e6);
}

TEST(RunFileControl, EndsADayAtItsTargetWithinATime) {
    // 360,000 J m-2 an hour from 2 h on, in the dark: 1,000,000 J m-2 after 2.778 h.
    const RunFile run = controlled(room(
        lamp("hps", "on_hours = [2, 8]"),
        control("daily_target = 1000000\nelectrical_power_w = 500")));
    const ControlOutcome& outcome = outcome_of(run);
    const double part = 1e6 / (kAtSensor * kHour) - 2;
    for (std::size_t i = 0; i < 24; ++i) {
        const double factor = i == 2 || i == 3 ? 1 : i == 4 ? part : 0;
        EXPECT_NEAR(outcome.steps[i].factor, factor, 1e-6) << i;
        EXPECT_NEAR(outcome.steps[i].on, factor, 1e-6) << i;
        EXPECT_NEAR(outcome.steps[i].lamps.mean, factor * kAtSensor, 1e-4) << i;
    }
    const ControlDay& day = outcome.days.at(0);
    EXPECT_EQ(outcome.lamps, 1U);
    EXPECT_NEAR(day.hours_on, 2 + part, 1e-6);
    EXPECT_NEAR(day.kwh, .5 * (2 + part), 1e-6);
    EXPECT_NEAR(day.lamps.mean, 1e6, 1);
    EXPECT_GT(day.light.mean, day.lamps.mean) << "with daylight";
}

TEST(RunFileControl, DimsToTheSetPointOrSwitchesOff) {
    const std::string night = "times = ['2024-12-15T02:00+01:00']\nduration_minutes = 60\n";
    const std::string one = lamp("hps", "");
    const auto factor = [&](const std::string& keys) {
        return outcome_of(controlled(room(one, control(keys), night))).steps.at(0).factor;
    };
    EXPECT_NEAR(factor("set_point = 60"), .6, 1e-6);
    EXPECT_NEAR(factor("set_point = 60\ndim_min = 0.59"), .6, 1e-6);
    EXPECT_EQ(factor("set_point = 60\ndim_min = 0.61"), 0);
    EXPECT_EQ(factor("set_point = 600"), 1);
}

TEST(RunFileControl, IsOffWhileDaylightIsBright) {
    const RunFile run = controlled(room(lamp("hps", ""), control("on_below = 50")));
    const ControlOutcome& outcome = outcome_of(run);
    std::size_t off = 0;
    for (std::size_t i = 0; i < 24; ++i) {
        double daylight = 0;  // without the leaf, which hides little
        for (const auto& source : run.series->time_steps[i].sources) {
            daylight +=
                source->is_lamp() ? 0 : source->spectrum()[0] * source->horizontal_irradiance();
        }
        const ControlStep& step = outcome.steps[i];
        EXPECT_NEAR(step.daylight.mean, daylight, .01 * daylight) << i;
        EXPECT_EQ(step.factor, step.daylight.mean < 50 ? 1 : 0) << i;
        EXPECT_EQ(
            step.is_near_threshold,
            std::abs(step.daylight.mean - 50) <= 2 * step.daylight.standard_error);
        off += step.factor == 0 ? 1 : 0;
    }
    EXPECT_GT(off, 3U);
    EXPECT_LT(off, 10U) << "December";
}

TEST(RunFileControl, SeesTheLampsOfControlsBeforeIt) {
    const std::string night = "times = ['2024-12-15T02:00+01:00']\nduration_minutes = 60\n";
    const RunFile run = controlled(room(
        lamp("a", "") + lamp("b", ""),
        control("set_point = 60", "a") + control("set_point = 90", "b"), night));
    EXPECT_NEAR(outcome_of(run, 0).steps[0].factor, .6, 1e-6);
    EXPECT_NEAR(outcome_of(run, 1).steps[0].factor, .3, 1e-6);
    EXPECT_NEAR(outcome_of(run, 0).steps[0].light.mean, 90, 1e-4);
    EXPECT_NEAR(outcome_of(run, 1).steps[0].lamps.mean, 30, 1e-4);
}

/// Keeps the light of the leaf and of the sensor.
struct LightOfTimes final : RunListener {
    void on_time_step(const TimeStepResult& step) override {
        for (std::size_t b = 0; b < 2; ++b) {
            leaf.push_back(step.result.at(0, Quantity::absorbed_flux, b));
            bench.push_back(step.result.sensors->at(0, Quantity::incident_upper, b));
        }
    }
    std::vector<Estimate> leaf, bench;
};

LightOfTimes light_of(RunFile run) {
    Simulator simulator;
    LightOfTimes light;
    const std::vector<TimeStep> time_steps = time_steps_of(run, simulator);
    static_cast<void>(
        run_series(simulator, run.scene, time_steps, run.spec, {.listeners = {&light}}));
    return light;
}

void expect_same(const std::vector<Estimate>& a, const std::vector<Estimate>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_NEAR(a[i].mean, b[i].mean, 1e-6 * b[i].mean) << i;
        EXPECT_NEAR(a[i].standard_error, b[i].standard_error, 1e-6 * b[i].mean) << i;
    }
}

TEST(RunFileControl, GivesTheLightOfLampsThatAreDimmedByHand) {
    const std::string rules = "on_below = 60\nset_point = 110\ndaily_target = 4000000";
    const RunFile run = controlled(room(lamp("hps", "on_hours = [3, 23]"), control(rules)));
    std::size_t dimmed = 0;
    RunFile by_hand = read_text(room(lamp("hps", "on_hours = [3, 23]"), ""));
    for (std::size_t i = 0; i < 24; ++i) {
        const double factor = outcome_of(run).steps[i].factor;
        dimmed += factor > 0 && factor < 1 ? 1 : 0;
        by_hand.series->time_steps[i] =
            read_text(room(lamp("hps", "on_hours = [3, 23]", factor), "")).series->time_steps[i];
    }
    EXPECT_GT(dimmed, 2U);
    const LightOfTimes a = light_of(run), b = light_of(by_hand);
    expect_same(a.leaf, b.leaf);
    expect_same(a.bench, b.bench);
    // Negative control: without control there is more light.
    const LightOfTimes full = light_of(read_text(room(lamp("hps", "on_hours = [3, 23]"), "")));
    EXPECT_GT(full.bench[2 * 22].mean, a.bench[2 * 22].mean + 50);
}

TEST(RunFileControl, DoesNotDependOnThreads) {
    const std::string rules = control("on_below = 60\nset_point = 110\ndaily_target = 4000000");
    const std::string time = "day = '2024-12-15'\nutc_offset_hours = 1\n";
    const RunFile one = controlled(room(lamp("hps", ""), rules, time, "threads = 1\n"));
    const RunFile three = controlled(room(lamp("hps", ""), rules, time, "threads = 3\n"));
    for (std::size_t i = 0; i < 24; ++i) {
        const ControlStep &a = outcome_of(one).steps[i], &b = outcome_of(three).steps[i];
        EXPECT_EQ(a.factor, b.factor);
        EXPECT_EQ(a.light.mean, b.light.mean);
        EXPECT_EQ(a.light.standard_error, b.light.standard_error);
    }
}

TEST(RunFileControl, ReportsMistakes) {
    const std::string one = lamp("hps 1", "");
    const auto expect_fault = [](const std::string& text, const std::string& problem) {
        const std::vector<std::string> faults = faults_of(text);
        EXPECT_TRUE(mentions(faults, problem)) << problem << ::testing::PrintToString(faults);
    };
    const std::string rule = "on_below = 100";
    expect_fault(
        room(one, "[[control]]\nsources = 'hps *'\nsensors = 'bech'\non_below = 100\n"),
        "no sensors are called 'bech'; there is bench");
    expect_fault(room(one, control(rule, "led *")), "no lamp is called 'led *'; there is hps 1");
    expect_fault(room("", control(rule)), "no lamp is called 'hps' (there are no lamps)");
    expect_fault(
        room(one, control(rule, "hps *") + control(rule, "* 1")),
        "'hps 1' belongs to control 'hps *' too (a lamp has one control)");
    expect_fault(
        room(
            one, control("daily_target = 12", "hps *"),
            "day = '2024-12-15'\nutc_offset_hours = 1\nhours = [6, 12]\n"),
        "daily_target needs times of a whole day ([time] has 6 h of 2024-12-15)");
    expect_fault(
        room(
            one, control(rule, "hps *"),
            "day = '2024-12-15'\nutc_offset_hours = 1\ncumulative_sky = 'day'\n"),
        "[time] has cumulative_sky (no instants are left)");
    expect_fault(room(one, control("", "hps *")), "it has no rule");
    expect_fault(room(one, control("on_below = 9\ndim_min = 0.3", "hps *")), "dim_min without");
    expect_fault(room(one, control("on_below = 9\nband = 'PRA'", "hps *")), "did you mean 'PAR'?");
    expect_fault(room(one, control("on_below = -9", "hps *")), "on_below");
    expect_fault(room(one, control("on_bellow = 9", "hps *")), "unknown key 'on_bellow'");
    expect_fault(room(one, "[[control]]\non_below = 9\n"), "sources is missing");
    RunText no_time;
    no_time.sources = one;
    no_time.rest = "[[sensors]]\nname = 'bench'\nreceiver = 'sphere'\nat = [[5, 5, 0]]\n" +
                   control(rule, "hps *");
    expect_fault(no_time.text(), "it needs [time]");
    expect_fault(no_time.text(), "sensors 'bench' are spheres");
    expect_fault(
        room(one, "[[table]]\nfile = 'a.csv'\nrows = 'control'\n"),
        "rows = \"control\" without [[control]]");
    expect_fault(
        room(
            one, control(rule, "hps *") +
                     "[[table]]\nfile = 'a.csv'\nrows = 'control'\nquantities = ['factor']\n"),
        "quantities in a table of controls");
}

}  // namespace
}  // namespace quasimc::test

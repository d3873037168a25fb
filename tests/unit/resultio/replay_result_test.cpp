#include "resultio/replay_result.h"

#include <cmath>

#include <gtest/gtest.h>

#include "quasimc/error.h"
#include "quasimc/result_file.h"
#include "run/zero_result.h"
#include "unit/resultio/replay_testing.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

const std::string kTwoOrgans =
    "[[organ]]\nmaterial = 'leaf'\nshape = 'triangle'\ncorners = [[0, 0, 1], [1, 0, 1], [0, 1, "
    "1]]\n"
    "[[organ]]\nmaterial = 'leaf'\nshape = 'triangle'\ncorners = [[0, 0, 2], [1, 0, 2], [0, 1, "
    "2]]\n";

std::string light_estimate(int mean) {
    return R"({"mean":)" + std::to_string(mean) +
           R"(,"standard_error":0.5,"ci95_low":0.25,"ci95_high":0.75})";
}

bool is_same(const Estimate& a, const Estimate& b) {
    return a.mean == b.mean && a.standard_error == b.standard_error && a.ci95_low == b.ci95_low &&
           a.ci95_high == b.ci95_high;
}

/// Two organs, the second without what is sunlit.
std::string light_organs(int first) {
    return R"([{"id":1,"absorbed_flux":{"PAR":)" + light_estimate(first) +
           R"(},"sunlit_fraction":)" + light_estimate(first + 10) +
           R"(},{"id":2,"absorbed_flux":{"PAR":)" + light_estimate(first + 1) +
           R"(},"sunlit_fraction":null}])";
}

TEST(ReplayResult, FillsInWhatTheResultHas) {
    RunText text;
    text.organs = kTwoOrgans;
    std::size_t reported = 0;
    LightEvents events;
    events.on_result = [&](std::size_t time_step, const Result& result) {
        ++reported;
        EXPECT_EQ(time_step, 0U);
        ASSERT_EQ(result.organs(), 2U);
        const Estimate& second = result.at(1, Quantity::absorbed_flux, 0);
        EXPECT_EQ(second.mean, 8);
        EXPECT_EQ(second.standard_error, 0.5);
        EXPECT_EQ(second.ci95_low, 0.25);
        EXPECT_EQ(second.ci95_high, 0.75);
        EXPECT_TRUE(std::isnan(result.at(0, Quantity::absorbed_flux_density, 0).mean));
        ASSERT_EQ(result.sunlit_fraction.size(), 2U);
        EXPECT_EQ(result.sunlit_fraction[0].mean, 17);
        EXPECT_TRUE(std::isnan(result.sunlit_fraction[1].mean));
    };
    replay(R"({"organs":)" + light_organs(7) + "}", text.text(), events);
    EXPECT_EQ(reported, 1U);
}

TEST(ReplayResult, TellsTimesAndDaysThatTheResultHas) {
    RunText text;
    text.organs = kTwoOrgans;
    text.sources = "[site]\nlatitude_deg = 50\nlongitude_deg = 8\n";
    text.rest = "[time]\nfrom = '2024-06-21'\nto = '2024-06-22'\nutc_offset_hours = 2\n";
    const RunFile run = read_text(text.text());
    ASSERT_TRUE(run.series);
    const std::string noon = run.series->notes[12].time, last = run.series->notes[30].time;
    std::vector<std::size_t> times, days, nights;
    LightEvents events;
    events.on_result = [&](std::size_t time_step, const Result& result) {
        const double mean = result.at(0, Quantity::absorbed_flux, 0).mean;
        if (is_dark(run.series->time_steps[time_step].sources)) {
            nights.push_back(time_step);
            EXPECT_EQ(mean, 0);
            return;
        }
        times.push_back(time_step);
        EXPECT_EQ(mean, time_step == 12 ? 3 : 5);
    };
    events.on_sum = [&](std::size_t day, const SeriesSum& sum) {
        days.push_back(day);
        EXPECT_EQ(sum.at(1, Quantity::absorbed_flux, 0).mean, 10);
    };
    replay(
        R"({"time_steps":[{"time":")" + noon + R"(","organs":)" + light_organs(3) +
            R"(},{"time":")" + last + R"(","organs":)" + light_organs(5) +
            R"(}],"days":[{"date":"2024-06-22","organs":)" + light_organs(9) + "}]}",
        text.text(), events);
    EXPECT_EQ(times, (std::vector<std::size_t>{12, 30}));
    EXPECT_EQ(nights.size(), 12U) << "up to the last time step in the file";
    EXPECT_EQ(days, std::vector<std::size_t>{1});
}

TEST(ReplayResult, TellsThePointsOfASweep) {
    RunText text;
    text.organs = kTwoOrgans;
    text.rest = "[sweep]\n'material.leaf.reflectance' = [0, 0.5]\n";
    std::vector<std::pair<std::size_t, double>> reported;
    std::size_t point = 0;
    LightEvents events;
    events.on_point = [&](std::size_t next) { point = next; };
    events.on_result = [&](std::size_t /*time_step*/, const Result& result) {
        reported.emplace_back(point, result.at(0, Quantity::absorbed_flux, 0).mean);
    };
    replay(
        R"({"points":[{"organs":)" + light_organs(3) + R"(},{"organs":)" + light_organs(5) + "}]}",
        text.text(), events);
    EXPECT_EQ(reported, (std::vector<std::pair<std::size_t, double>>{{0, 3}, {1, 5}}));
}

/// They may be called the same, but none is passed over without a word.
TEST(ReplayResult, TakesTimesInTheirOrder) {
    RunText text;
    text.organs = kTwoOrgans;
    text.sources = "[site]\nlatitude_deg = 50\nlongitude_deg = 8\n";
    const std::string noon = "2024-06-21T12:00+02:00";
    text.rest = "[time]\ntimes = ['" + noon + "', '" + noon + "']\n";
    const auto time_step = [&](const std::string& time, int mean) {
        return R"({"time":")" + time + R"(","organs":)" + light_organs(mean) + "}";
    };
    std::vector<std::pair<std::size_t, double>> reported;
    LightEvents events;
    events.on_result = [&](std::size_t index, const Result& result) {
        reported.emplace_back(index, result.at(0, Quantity::absorbed_flux, 0).mean);
    };
    replay(
        R"({"time_steps":[)" + time_step(noon, 3) + "," + time_step(noon, 5) + "]}", text.text(),
        events);
    EXPECT_EQ(reported, (std::vector<std::pair<std::size_t, double>>{{0, 3}, {1, 5}}));
    EXPECT_THROW(
        replay(
            R"({"time_steps":[)" + time_step("2024-06-22T12:00+02:00", 3) + "]}", text.text(),
            events),
        InputError);
}

/// Two suns as origins, and sensors of all kinds.
std::string run_with_sensors(const std::string& time = "") {
    RunText text;
    text.top = "bands = ['PAR', 'NIR']\nlength_unit = 'm'\n";
    text.run = "[run]\norigins = ['lamp', 'sun']\nratios = ['PAR:NIR']\n";
    text.sources =
        "[[source]]\ntype = 'point'\nname = 'lamp'\nposition = [0, 0, 3]\npower = 2\n"
        "[[source]]\ntype = 'directional'\nname = 'sun'\ndirection = [0, 0, -1]\n"
        "irradiance_facing = 1\n";
    text.rest =
        "[[sensors]]\nname = 'flat'\nat = [[0, 0, 1], [1, 0, 1]]\n"
        "[[sensors]]\nname = 'ball'\nat = [[0, 0, 1]]\nreceiver = 'sphere'\n"
        "[[sensors]]\nname = 'mean'\nat = [[0, 0, 1], [1, 0, 1]]\naverage = true\n" +
        time;
    return text.text();
}

/// Different numbers for all estimates.
void number(std::vector<Estimate>& estimates, double& next) {
    for (Estimate& each : estimates) {
        next += 1.0 / 3;
        each = {next, next / 7, next - 1, next + 1};
    }
}

/// Checks the light on the sensors of run_with_sensors(): absorbed light is not written, nor are
/// the sides of the sphere.
/// @param read, written  a Result or a SeriesSum
template <typename Light>
void expect_same_sensors(const Light& read, const Light& written) {
    ASSERT_EQ(read.values.size(), written.values.size());
    for (std::size_t i = 0; i < read.values.size(); ++i) {
        const std::size_t row = i / (kQuantities * read.bands);
        const auto quantity = static_cast<Quantity>(i / read.bands % kQuantities);
        const bool is_written = quantity > Quantity::absorbed_flux_density &&
                                (row != 2 || quantity != Quantity::incident_lower);
        EXPECT_EQ(std::isnan(read.values[i].mean), !is_written) << i;
        EXPECT_TRUE(!is_written || is_same(read.values[i], written.values[i])) << i;
    }
}

TEST(ReplayResult, ReadsSensorsBack) {
    const RunFile run = read_text(run_with_sensors());
    Result result = zero_result(run.scene, run.spec);
    Result sensors = *result.sensors;
    double next = 0;
    number(sensors.values, next);
    number(sensors.ratio_values, next);
    sensors.sunlit_fraction.resize(4);
    number(sensors.sunlit_fraction, next);
    for (OriginLight& origin : sensors.origins) {
        number(origin.light.values, next);
    }
    result.sensors = std::make_shared<const Result>(sensors);
    std::string text;
    static_cast<void>(write_json(run, result, [&](std::string_view part) { text += part; }));
    std::size_t reported = 0;
    LightEvents events;
    events.on_result = [&](std::size_t /*time_step*/, const Result& read) {
        ++reported;
        ASSERT_NE(read.sensors, nullptr);
        expect_same_sensors(*read.sensors, sensors);
        ASSERT_EQ(read.sensors->origins.size(), 2U);
        for (std::size_t i = 0; i < 2; ++i) {
            EXPECT_EQ(read.sensors->origins[i].name, sensors.origins[i].name);
            expect_same_sensors(read.sensors->origins[i].light, sensors.origins[i].light);
        }
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_TRUE(is_same(read.sensors->sunlit_fraction[i], sensors.sunlit_fraction[i]));
            EXPECT_TRUE(is_same(read.sensors->ratio(i, 0), sensors.ratio(i, 0)));
        }
    };
    replay(text, run_with_sensors(), events);
    EXPECT_EQ(reported, 1U);
}

TEST(ReplayResult, ReadsSumsOfSensorsBack) {
    const std::string run_file = run_with_sensors(
        "[site]\nlatitude_deg = 50\nlongitude_deg = 8\n[time]\nday = "
        "'2024-06-21'\nutc_offset_hours = 0\n");
    const RunFile run = read_text(run_file);
    const std::size_t rows = 4 * kQuantities * 2;
    double next = 0;
    SeriesSum sensors, sum;
    sensors.bands = sum.bands = 2;
    sensors.values.resize(rows);
    number(sensors.values, next);
    sum.values.resize(kQuantities * 2);
    sum.sensors = std::make_shared<const SeriesSum>(sensors);
    std::string text;
    JsonWriter writer(run, [&](std::string_view part) { text += part; });
    writer.on_day(0, sum);
    writer.finish({});
    std::size_t reported = 0;
    LightEvents events;
    events.on_sum = [&](std::size_t /*day*/, const SeriesSum& read) {
        ++reported;
        ASSERT_NE(read.sensors, nullptr);
        expect_same_sensors(*read.sensors, sensors);
    };
    replay(text, run_file, events);
    EXPECT_EQ(reported, 1U);
}

TEST(ReplayResult, RefusesAResultWithoutAny) {
    LightEvents events;
    try {
        replay(R"({"organs":[]})", RunText().text(), events);
        FAIL();
    } catch (const InputError& error) {
        ASSERT_EQ(error.faults().size(), 1U);
        EXPECT_EQ(
            error.faults()[0].text(),
            "a.json: contains no light of organs or sensors (the run ended before the first "
            "result)");
    }
}

}  // namespace
}  // namespace quasimc::test

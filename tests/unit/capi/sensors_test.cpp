#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "unit/capi/canopy.h"

namespace quasimc::test {
namespace {

/// Three sensors in a list, a grid of 3 x 2, and two spheres, above a canopy.
SceneHandle canopy_with_sensors() {
    SceneHandle scene = small_canopy(2);
    const double list[] = {0, 0, 50, 1, 0, 50, 0.5, 0.5, 0.01}, pair[] = {0, 0, 40, 1, 1, 40};
    const double start[] = {0, 0, 0.5}, along[] = {0.9, 0, 0}, across[] = {0, 0.8, 0};
    int failed = 0;
    failed |= quasimc_scene_add_sensors(scene.get(), "list", list, 3);
    failed |= quasimc_scene_add_sensor_grid(scene.get(), "grid", start, along, across, 3, 2);
    failed |= quasimc_scene_add_sensors(scene.get(), "ball", pair, 2);
    failed |= quasimc_scene_set_sensors(scene.get(), "ball", "receiver", "sphere");
    failed |= quasimc_scene_set_option(scene.get(), "origins", "sun,sky");
    EXPECT_EQ(failed, QUASIMC_DONE) << quasimc_last_error();
    return scene;
}

std::vector<double> of_set(
    const quasimc_result& result,
    const char* set,
    const char* quantity,
    const char* statistic = "mean") {
    std::vector<double> values(
        static_cast<std::size_t>(quasimc_result_sensor_set_size(&result, set)));
    EXPECT_EQ(
        quasimc_result_get_sensor_set(
            &result, set, quantity, "PAR", statistic, values.data(),
            static_cast<std::int64_t>(values.size())),
        QUASIMC_DONE)
        << quasimc_last_error();
    return values;
}

TEST(CSensors, GiveTheNumbersOfTheSameRunFile) {
    const ResultHandle result = run(*canopy_with_sensors());
    ASSERT_TRUE(result) << quasimc_last_error();
    const SceneHandle written = small_canopy(2);
    ASSERT_EQ(
        quasimc_scene_state(written.get(), R"(
run = { origins = ["sun", "sky"] }
[[sensors]]
name = "list"
at = [[0, 0, 50], [1, 0, 50], [0.5, 0.5, 0.01]]
[[sensors]]
name = "grid"
at = { start = [0, 0, 0.5], along = [0.9, 0, 0], across = [0, 0.8, 0], counts = [3, 2] }
[[sensors]]
name = "ball"
receiver = "sphere"
at = [[0, 0, 40], [1, 1, 40]]
)"),
        QUASIMC_DONE)
        << quasimc_last_error();
    const ResultHandle same = run(*written);
    ASSERT_TRUE(same) << quasimc_last_error();
    for (const char* set : {"list", "grid", "ball"}) {
        const bool is_ball = set == std::string("ball");
        for (const char* quantity :
             {is_ball ? "fluence_rate" : "incident_upper", "incident_direct_from_sun"}) {
            EXPECT_EQ(of_set(*result, set, quantity), of_set(*same, set, quantity));
        }
    }
}

TEST(CSensors, AreReadBySetAndIndex) {
    const ResultHandle result = run(*canopy_with_sensors());
    ASSERT_TRUE(result) << quasimc_last_error();
    ASSERT_EQ(quasimc_result_sensor_set_count(result.get()), 3);
    EXPECT_STREQ(quasimc_result_sensor_set_name(result.get(), 1), "grid");
    EXPECT_EQ(quasimc_result_sensor_set_name(result.get(), 3), nullptr);
    EXPECT_EQ(quasimc_result_sensor_set_size(result.get(), "grid"), 6);
    EXPECT_EQ(quasimc_result_sensor_set_size(result.get(), "gird"), -1);
    EXPECT_STREQ(quasimc_last_error(), "there are no sensors 'gird'");
    std::array<double, 11> all{};
    ASSERT_EQ(
        quasimc_result_get_sensors(
            result.get(), "incident_upper", "PAR", "standard_error", all.data(), 11),
        QUASIMC_DONE);
    const auto errors = of_set(*result, "ball", "fluence_rate", "standard_error");
    EXPECT_EQ(errors, (std::vector<double>{all[9], all[10]}));
    double four[4];
    ASSERT_EQ(
        quasimc_result_get_sensor(result.get(), "grid", 4, "incident_upper_from_sky", "PAR", four),
        QUASIMC_DONE);
    EXPECT_EQ(four[0], of_set(*result, "grid", "incident_upper_from_sky")[4]);
    EXPECT_GT(four[1], 0);
    EXPECT_LE(four[2], four[0]);
    EXPECT_GE(four[3], four[0]);
    EXPECT_EQ(
        quasimc_result_get_sensor(result.get(), "grid", 6, "incident_upper", "PAR", four),
        QUASIMC_MISUSE);
    EXPECT_STREQ(quasimc_last_error(), "there is no sensor 6 of 'grid': there are 6");
    const auto get = [&](const char* set, const char* quantity) {
        return quasimc_result_get_sensor(result.get(), set, 0, quantity, "PAR", four);
    };
    EXPECT_EQ(get("grid", "fluence_rate"), QUASIMC_MISUSE);
    EXPECT_EQ(get("ball", "incident_upper"), QUASIMC_MISUSE);
    EXPECT_STREQ(quasimc_last_error(), "'ball' are spheres, which have no sides: use fluence_rate");
    EXPECT_STREQ(quasimc_result_sensor_set_receiver(result.get(), "ball"), "sphere");
    EXPECT_STREQ(quasimc_result_sensor_set_receiver(result.get(), "grid"), "cosine");
}

TEST(CSensors, OriginsAddUpToTheWholeAboveTheCanopy) {
    const SceneHandle scene = canopy_with_sensors();
    ASSERT_EQ(quasimc_scene_set_option(scene.get(), "paths", "4096"), QUASIMC_DONE);
    const ResultHandle result = run(*scene);
    ASSERT_TRUE(result) << quasimc_last_error();
    const auto whole = of_set(*result, "list", "incident_upper");
    const auto sun = of_set(*result, "list", "incident_upper_from_sun");
    const auto sky = of_set(*result, "list", "incident_upper_from_sky");
    const auto error = of_set(*result, "list", "incident_upper_from_sky", "standard_error");
    for (const std::size_t i : {0, 1}) {  // nothing is above these
        EXPECT_NEAR(sky[i], 80, 5 * error[i]);
        EXPECT_LT(error[i], 2);
    }
    for (std::size_t i = 0; i < whole.size(); ++i) {
        EXPECT_NEAR(whole[i], sun[i] + sky[i], 1e-9 * whole[i]);
    }
}

TEST(CSensors, ThatFaceUpHaveATransmittance) {
    const SceneHandle scene = canopy_with_sensors();
    const double at[] = {0, 0, 50};
    ASSERT_EQ(quasimc_scene_add_sensors(scene.get(), "down", at, 1), QUASIMC_DONE);
    ASSERT_EQ(quasimc_scene_set_sensors(scene.get(), "down", "facing", "down"), QUASIMC_DONE);
    const ResultHandle result = run(*scene);
    ASSERT_TRUE(result) << quasimc_last_error();
    const auto fraction = of_set(*result, "list", "transmittance");
    const auto light = of_set(*result, "list", "incident_upper");
    const auto error = of_set(*result, "list", "transmittance", "standard_error");
    const double horizontal = 400 * std::sin(50 * std::acos(-1.0) / 180) + 80;
    EXPECT_GT(error[2], 0);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(fraction[i], light[i] / horizontal, 1e-12);
    }
    for (const char* set : {"ball", "down"}) {
        EXPECT_TRUE(std::isnan(of_set(*result, set, "transmittance")[0])) << set;
    }
    double four[4];
    ASSERT_EQ(
        quasimc_result_get_sensor(result.get(), "list", 2, "transmittance", "PAR", four),
        QUASIMC_DONE);
    EXPECT_EQ(four[0], fraction[2]);
    EXPECT_EQ(four[1], error[2]);
    EXPECT_LE(four[2], four[0]);
    EXPECT_GE(four[3], four[0]);
    std::array<double, 12> all{};
    ASSERT_EQ(
        quasimc_result_get_sensors(
            result.get(), "transmittance", "PAR", "mean", all.data(), all.size()),
        QUASIMC_DONE);
    EXPECT_EQ(all[2], fraction[2]);
    EXPECT_TRUE(std::isnan(all[9])) << "a sphere";
}

TEST(CSensors, HavePositionsAndLabels) {
    const ResultHandle result = run(*canopy_with_sensors());
    ASSERT_TRUE(result) << quasimc_last_error();
    std::array<double, 33> positions{};
    ASSERT_EQ(quasimc_result_sensor_positions(result.get(), positions.data(), 11), QUASIMC_DONE);
    const std::array<double, 6> expected{1, 0, 50, 0.5, 0.5, 0.01};
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(positions[3 + i], expected[i]);
    }
    EXPECT_NEAR(positions[12], 0.45, 1e-12);  // grid, i = 2, j = 1
    EXPECT_NEAR(positions[13], 0.2, 1e-12);
    EXPECT_EQ(quasimc_result_sensor_positions(result.get(), positions.data(), 10), QUASIMC_MISUSE);
    EXPECT_STREQ(quasimc_result_sensor_label(result.get(), 4, "sensors"), "grid");
    EXPECT_STREQ(quasimc_result_sensor_label(result.get(), 4, "i"), "2");
    EXPECT_EQ(quasimc_result_sensor_label(result.get(), 0, "i"), nullptr);
    EXPECT_EQ(quasimc_result_sensor_label(result.get(), 11, "i"), nullptr);
}

TEST(CSensors, TakeTheKeysOfTheRunFile) {
    const SceneHandle scene = small_canopy(1);
    quasimc_scene* s = scene.get();
    ASSERT_EQ(quasimc_scene_set_option(s, "paths", "4096"), QUASIMC_DONE);
    const double at[] = {0, 0, 50, 1, 0, 50};
    ASSERT_EQ(quasimc_scene_add_sensors(s, "line", at, 2), QUASIMC_DONE);
    ASSERT_EQ(quasimc_scene_add_sensors(s, "down", at, 1), QUASIMC_DONE);
    for (const auto& [key, value] : std::vector<std::pair<const char*, const char*>>{
             {"average", "true"}, {"field_of_view_deg", "30"}, {"labels", "{ row = 7 }"}}) {
        EXPECT_EQ(quasimc_scene_set_sensors(s, "line", key, value), QUASIMC_DONE)
            << quasimc_last_error();
    }
    EXPECT_EQ(quasimc_scene_set_sensors(s, "down", "facing", "up"), QUASIMC_DONE);
    EXPECT_EQ(quasimc_scene_set_sensors(s, "down", "facing", "[0, 0, -1]"), QUASIMC_DONE);
    EXPECT_EQ(quasimc_scene_set_sensors(s, "none", "size", "1"), QUASIMC_INPUT_ERROR);
    EXPECT_STREQ(
        quasimc_last_error(), "sensors 'none': there are none of this name; add them first");
    EXPECT_EQ(quasimc_scene_set_sensors(s, "line", "size", "[1"), QUASIMC_INPUT_ERROR);
    EXPECT_EQ(quasimc_scene_set_sensors(s, "line", "size", "1\nx = 2"), QUASIMC_INPUT_ERROR);
    EXPECT_EQ(quasimc_scene_add_sensors(s, "empty", at, 0), QUASIMC_MISUSE);
    EXPECT_EQ(quasimc_scene_add_sensors(s, "empty", nullptr, 1), QUASIMC_MISUSE);
    EXPECT_EQ(quasimc_scene_add_sensor_grid(s, "g", at, nullptr, at, 1, 1), QUASIMC_MISUSE);
    const ResultHandle result = run(*s);
    ASSERT_TRUE(result) << quasimc_last_error();
    EXPECT_EQ(quasimc_result_sensor_set_size(result.get(), "line"), 1);
    EXPECT_EQ(quasimc_result_sensor_set_size(result.get(), "down"), 1);
    EXPECT_STREQ(quasimc_result_sensor_label(result.get(), 0, "row"), nullptr);
    EXPECT_GT(of_set(*result, "down", "incident_lower")[0], 80);
    // The part of an overcast sky, of radiance 1 + 2 cos, within 30 degrees of the zenith.
    const double cosine = std::cos(std::acos(-1.0) / 6);
    const double part = ((1 - cosine * cosine) / 2 + 2 * (1 - std::pow(cosine, 3)) / 3) * 6 / 7;
    double four[4];
    ASSERT_EQ(
        quasimc_result_get_sensor(result.get(), "line", 0, "incident_upper", "PAR", four),
        QUASIMC_DONE);
    EXPECT_NEAR(four[0], part * 80, 5 * four[1]);
    EXPECT_LT(four[1], 0.5);
}

TEST(CSensors, CanBeCleared) {
    const SceneHandle scene = small_canopy(1);
    const double below[] = {0, 0, -1};
    ASSERT_EQ(quasimc_scene_add_sensors(scene.get(), "deep", below, 1), QUASIMC_DONE);
    quasimc_result* none = nullptr;
    EXPECT_EQ(quasimc_scene_run(scene.get(), nullptr, nullptr, &none), QUASIMC_INPUT_ERROR);
    ASSERT_EQ(quasimc_scene_clear(scene.get(), QUASIMC_SENSORS), QUASIMC_DONE);
    const ResultHandle result = run(*scene);
    ASSERT_TRUE(result) << quasimc_last_error();
    EXPECT_EQ(quasimc_result_sensor_set_count(result.get()), 0);
}

}  // namespace
}  // namespace quasimc::test

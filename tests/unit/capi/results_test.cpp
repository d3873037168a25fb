#include <string>

#include <gtest/gtest.h>

#include "unit/capi/canopy.h"

namespace quasimc::test {
namespace {

TEST(CResults, NamesLabelsAndAreasAreThoseStated) {
    const SceneHandle scene = small_canopy(3);
    ASSERT_EQ(quasimc_scene_set_name(scene.get(), 2, "flag leaf"), QUASIMC_DONE);
    ASSERT_EQ(quasimc_scene_set_label(scene.get(), 2, "plant", "1"), QUASIMC_DONE);
    ASSERT_EQ(quasimc_scene_set_label(scene.get(), 2, "plant", "7"), QUASIMC_DONE);
    EXPECT_EQ(quasimc_scene_set_name(scene.get(), 9, "none"), QUASIMC_INPUT_ERROR);
    const ResultHandle result = run(*scene);
    ASSERT_TRUE(result);
    ASSERT_EQ(quasimc_result_organ_count(result.get()), 4);
    EXPECT_EQ(quasimc_result_organ_id(result.get(), 1), 2);
    EXPECT_EQ(quasimc_result_find_organ(result.get(), 2), 1);
    EXPECT_EQ(quasimc_result_find_organ(result.get(), 77), -1);
    EXPECT_STREQ(quasimc_result_organ_name(result.get(), 1), "flag leaf");
    EXPECT_STREQ(quasimc_result_organ_name(result.get(), 3), "ground");
    EXPECT_STREQ(quasimc_result_organ_label(result.get(), 1, "plant"), "7");
    EXPECT_EQ(quasimc_result_organ_label(result.get(), 0, "plant"), nullptr);
    EXPECT_NEAR(quasimc_result_organ_area(result.get(), 1), 0.04, 0.001);
    EXPECT_EQ(quasimc_result_band_count(result.get()), 2);
    EXPECT_STREQ(quasimc_result_band_name(result.get(), 1), "NIR");
    EXPECT_STREQ(quasimc_result_band_unit(result.get(), 1), "W m-2");
    ASSERT_EQ(quasimc_quantity_count(), 6);
    EXPECT_STREQ(quasimc_quantity_name(0), "absorbed_flux");
}

TEST(CResults, TextsAreUtf8) {
    const SceneHandle scene = small_canopy(1);
    EXPECT_EQ(quasimc_scene_set_name(scene.get(), 1, "\xff"), QUASIMC_INPUT_ERROR);
    EXPECT_STREQ(quasimc_last_error(), "name: '?' is not UTF-8 (texts must be UTF-8)");
    EXPECT_EQ(quasimc_scene_set_label(scene.get(), 1, "plant", "bl\xE4tt"), QUASIMC_INPUT_ERROR);
    EXPECT_EQ(quasimc_scene_add_band(scene.get(), "R", "W m\xB2"), QUASIMC_INPUT_ERROR);
    EXPECT_EQ(quasimc_scene_set_name(scene.get(), 1, "bl\xC3\xA4tt"), QUASIMC_DONE);
    EXPECT_TRUE(run(*scene));
}

TEST(CResults, SensorsAreBesideTheOrgans) {
    const SceneHandle scene = small_canopy(2);
    ASSERT_EQ(
        quasimc_scene_state(
            scene.get(),
            "[[sensors]]\nname = 'high'\nat = [[0, 0, 50], [1, 0, 50]]\n"
            "[[sensors]]\nname = 'down'\nfacing = 'down'\nat = [[0, 0, 50]]\n"),
        QUASIMC_DONE);
    const ResultHandle result = run(*scene);
    ASSERT_TRUE(result) << quasimc_last_error();
    ASSERT_EQ(quasimc_result_sensor_count(result.get()), 3);
    EXPECT_STREQ(quasimc_result_sensor_name(result.get(), 1), "high 2");
    EXPECT_EQ(quasimc_result_sensor_name(result.get(), 3), nullptr);
    double upper[3], lower[3];
    const auto get = [&](const char* quantity, double* values, std::int64_t count) {
        return quasimc_result_get_sensors(result.get(), quantity, "PAR", "mean", values, count);
    };
    ASSERT_EQ(get("incident_upper", upper, 3), QUASIMC_DONE);
    ASSERT_EQ(get("incident_lower", lower, 3), QUASIMC_DONE);
    EXPECT_GT(upper[0], 0);
    EXPECT_NEAR(upper[0], lower[2], 0.05 * upper[0]);
    EXPECT_EQ(get("incident_upper", upper, 2), QUASIMC_MISUSE);
    const ResultHandle without = run(*small_canopy(2));
    EXPECT_EQ(quasimc_result_sensor_count(without.get()), 0);
    EXPECT_EQ(
        quasimc_result_get_sensors(without.get(), "incident_upper", "PAR", "mean", upper, 0),
        QUASIMC_MISUSE);
}

TEST(CResults, TotalsAndGroupsAreSumsOfOrgans) {
    const SceneHandle scene = small_canopy(4);
    for (std::int64_t id = 1; id <= 4; ++id) {
        ASSERT_EQ(
            quasimc_scene_set_label(scene.get(), id, "plant", id < 3 ? "a" : "b"), QUASIMC_DONE);
    }
    ASSERT_EQ(quasimc_scene_set_option(scene.get(), "groups", "plant"), QUASIMC_DONE);
    ASSERT_EQ(quasimc_scene_set_option(scene.get(), "ratios", "PAR:NIR"), QUASIMC_DONE);
    const ResultHandle result = run(*scene);
    ASSERT_TRUE(result);
    const auto light = column(*result, "absorbed_flux", "PAR");
    double second[4];
    ASSERT_EQ(
        quasimc_result_get_organ(result.get(), 2, "absorbed_flux", "PAR", second), QUASIMC_DONE);
    EXPECT_EQ(second[0], light[1]);
    double total[4];
    ASSERT_EQ(quasimc_result_get_total(result.get(), "absorbed_flux", "PAR", total), QUASIMC_DONE);
    EXPECT_NEAR(total[0], light[0] + light[1] + light[2] + light[3], 1e-9 * total[0]);
    EXPECT_GT(total[1], 0);
    EXPECT_LT(total[2], total[0]);
    EXPECT_GT(total[3], total[0]);

    ASSERT_EQ(quasimc_result_group_count(result.get()), 3);
    EXPECT_STREQ(quasimc_result_group_by(result.get(), 0), "all");
    EXPECT_STREQ(quasimc_result_group_by(result.get(), 2), "plant");
    EXPECT_STREQ(quasimc_result_group_value(result.get(), 2), "b");
    double groups[3];
    ASSERT_EQ(
        quasimc_result_get_groups(result.get(), "absorbed_flux", "PAR", "mean", groups, 3),
        QUASIMC_DONE);
    EXPECT_NEAR(groups[2], light[2] + light[3], 1e-9 * total[0]);

    const auto ratios = column(*result, "PAR:NIR", nullptr);
    EXPECT_GT(ratios[0], 0);
    double ratio[4];
    ASSERT_EQ(quasimc_result_get_total(result.get(), "PAR:NIR", nullptr, ratio), QUASIMC_DONE);
    EXPECT_GT(ratio[0], 0.5);
}

TEST(CResults, HaveTheLightOfEachOrigin) {
    const SceneHandle scene = small_canopy(4);
    ASSERT_EQ(quasimc_scene_set_option(scene.get(), "origins", "sun,sky"), QUASIMC_DONE);
    const ResultHandle result = run(*scene);
    ASSERT_TRUE(result);
    const auto all = column(*result, "absorbed_flux", "PAR");
    const auto sun = column(*result, "absorbed_flux_from_sun", "PAR");
    const auto sky = column(*result, "absorbed_flux_from_sky", "PAR");
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_NEAR(sun[i] + sky[i], all[i], 1e-12 * (1 + all[i]));
    }
    double total[4];
    ASSERT_EQ(
        quasimc_result_get_total(result.get(), "absorbed_flux_from_sky", "PAR", total),
        QUASIMC_DONE);
    EXPECT_NEAR(total[0], sky[0] + sky[1] + sky[2] + sky[3], 1e-9 * (1 + total[0]));
    EXPECT_EQ(
        quasimc_result_get_total(result.get(), "absorbed_flux_from_moon", "PAR", total),
        QUASIMC_MISUSE);
}

TEST(CResults, TheBudgetCloses) {
    const ResultHandle result = run(*small_canopy(4));
    double sum = 0;
    for (const auto& [item, sign] :
         {std::pair("emitted", 1), std::pair("imbalance", 1), std::pair("absorbed_by_organs", -1),
          std::pair("absorbed_by_ground", -1), std::pair("escaped", -1),
          std::pair("cut_off", -1)}) {
        double values[4];
        ASSERT_EQ(quasimc_result_get_budget(result.get(), item, "NIR", values), QUASIMC_DONE);
        sum += sign * values[0];
    }
    EXPECT_NEAR(sum, 0, 1e-6);
}

TEST(CResults, OutliveTheirScene) {
    SceneHandle scene = small_canopy(2);
    const ResultHandle result = run(*scene);
    scene.reset();
    EXPECT_STREQ(quasimc_result_organ_name(result.get(), 0), "organ 1");
    EXPECT_GT(column(*result, "absorbed_flux", "PAR")[0], 0);
}

TEST(CResults, WarningsAreTold) {
    const SceneHandle scene = small_canopy(1);
    const SquareLeaf same = square_leaf(1);
    ASSERT_EQ(
        quasimc_scene_add_mesh(
            scene.get(), same.vertices.data(), 4, same.faces.data(), 2, nullptr, "leaf", nullptr),
        QUASIMC_DONE);
    const ResultHandle result = run(*scene);
    ASSERT_TRUE(result);
    ASSERT_EQ(quasimc_result_warning_count(result.get()), 1);
    EXPECT_NE(
        std::string(quasimc_result_warning(result.get(), 0)).find("organ 1"), std::string::npos)
        << quasimc_result_warning(result.get(), 0);
}

TEST(CResults, RoundsTellHowErrorsFell) {
    const SceneHandle scene = small_canopy(2);
    EXPECT_EQ(quasimc_result_round_count(run(*scene).get()), 0);
    ASSERT_EQ(quasimc_scene_set_option(scene.get(), "paths", "256"), QUASIMC_DONE);
    ASSERT_EQ(quasimc_scene_set_option(scene.get(), "max_paths", "1024"), QUASIMC_DONE);
    const ResultHandle result = run(*scene);
    ASSERT_TRUE(result);
    const auto number = [&](std::int64_t round, const char* key) {
        double value = -1;
        EXPECT_EQ(quasimc_result_get_round(result.get(), round, key, &value), QUASIMC_DONE);
        return value;
    };
    const std::int64_t rounds = quasimc_result_round_count(result.get());
    ASSERT_GE(rounds, 2);
    double paths = 0;
    ASSERT_EQ(quasimc_result_get_number(result.get(), "paths", &paths), QUASIMC_DONE);
    EXPECT_EQ(number(0, "paths"), 256);
    EXPECT_EQ(number(rounds - 1, "paths"), paths);
    EXPECT_GT(number(rounds - 1, "median_error"), 0);
    EXPECT_GE(number(rounds - 1, "worst_error"), number(rounds - 1, "median_error"));
    EXPECT_GE(number(rounds - 1, "seconds"), number(0, "seconds"));
    EXPECT_EQ(number(0, "fraction_at_target"), 0);
    double value = 0;
    EXPECT_EQ(quasimc_result_get_round(result.get(), rounds, "paths", &value), QUASIMC_MISUSE);
    EXPECT_EQ(quasimc_result_get_round(result.get(), 0, "luck", &value), QUASIMC_MISUSE);
    EXPECT_EQ(quasimc_result_round_count(nullptr), -1);
}

}  // namespace
}  // namespace quasimc::test

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "unit/capi/canopy.h"

namespace quasimc::test {
namespace {

bool error_tells(const char* words) {
    return std::string(quasimc_last_error()).find(words) != std::string::npos;
}

TEST(CStatements, PiecesOfARunFileAreJoined) {
    const SceneHandle scene = new_scene();
    ASSERT_EQ(
        quasimc_scene_state(
            scene.get(), "bands = [\"PAR\"]\n[[material]]\nname = \"leaf\"\nreflectance = 0.1\n"),
        QUASIMC_DONE);
    ASSERT_EQ(
        quasimc_scene_state(
            scene.get(),
            "[[material]]\nname = \"soil\"\nreflectance = 0.2\n"
            "[ground]\nmaterial = \"soil\"\nx = [-1, 1]\ny = [-1, 1]\n[run]\npaths = 64\n"),
        QUASIMC_DONE);
    ASSERT_EQ(
        quasimc_scene_state(
            scene.get(),
            "[run]\nseed = 3\nmethod = \"light_tracing\"\n[[source]]\ntype = \"directional\"\n"
            "direction = [0, 0, -1]\nirradiance_facing = 100\n"),
        QUASIMC_DONE);
    ASSERT_EQ(add_leaf(*scene, square_leaf(1)), QUASIMC_DONE);
    const ResultHandle result = run(*scene);
    ASSERT_TRUE(result);
    double paths = 0;
    ASSERT_EQ(quasimc_result_get_number(result.get(), "paths", &paths), QUASIMC_DONE);
    EXPECT_EQ(paths, 64);
    EXPECT_STREQ(quasimc_result_text(result.get(), "method"), "light_tracing");
    double emitted[4];
    ASSERT_EQ(quasimc_result_get_budget(result.get(), "emitted", "PAR", emitted), QUASIMC_DONE);
    EXPECT_GT(emitted[0], 0);
}

TEST(CStatements, AKeyOfAnotherKindIsRefusedAndChangesNothing) {
    const SceneHandle scene = small_canopy(1);
    const auto before = column(*run(*scene), "absorbed_flux", "PAR");
    EXPECT_EQ(quasimc_scene_state(scene.get(), "title = \"x\"\nrun = 5\n"), QUASIMC_INPUT_ERROR);
    EXPECT_TRUE(error_tells("run is an integer")) << quasimc_last_error();
    EXPECT_EQ(quasimc_scene_state(scene.get(), "run = = 5"), QUASIMC_INPUT_ERROR);
    EXPECT_EQ(column(*run(*scene), "absorbed_flux", "PAR"), before);
}

TEST(CStatements, EveryKindOfSourceShines) {
    const double light[] = {100, 50};
    const std::vector<std::function<int(quasimc_scene*)>> sources{
        [&](auto* s) { return quasimc_scene_add_directional(s, 0.1, 0, -1, light); },
        [&](auto* s) { return quasimc_scene_add_sun(s, 90, 60, light); },
        [&](auto* s) {
            return quasimc_scene_set_site(s, 52, 6, 10) +
                   quasimc_scene_add_sun_at(s, "2024-06-21T12:00:00+02:00", light);
        },
        [&](auto* s) { return quasimc_scene_add_sky(s, "uniform", light); },
        [&](auto* s) { return quasimc_scene_add_point_lamp(s, 0.5, 0.5, 3, light); }};
    const SceneHandle scene = small_canopy(2);
    for (const auto& add : sources) {
        ASSERT_EQ(quasimc_scene_clear(scene.get(), QUASIMC_SOURCES), QUASIMC_DONE);
        ASSERT_EQ(add(scene.get()), QUASIMC_DONE) << quasimc_last_error();
        const ResultHandle result = run(*scene);
        ASSERT_TRUE(result);
        EXPECT_GT(column(*result, "absorbed_flux", "PAR").back(), 0);
    }
}

TEST(CStatements, FaultsAreToldAllAtOnceInTheWordsOfTheProgram) {
    const SceneHandle scene = small_canopy(1);
    const double light[] = {-1, 50};
    ASSERT_EQ(quasimc_scene_add_sky(scene.get(), "green", light), QUASIMC_DONE);
    ASSERT_EQ(quasimc_scene_set_option(scene.get(), "paths", "0"), QUASIMC_DONE);
    quasimc_result* result = nullptr;
    EXPECT_EQ(quasimc_scene_run(scene.get(), nullptr, nullptr, &result), QUASIMC_INPUT_ERROR);
    EXPECT_EQ(result, nullptr);
    EXPECT_TRUE(error_tells("green")) << quasimc_last_error();
    EXPECT_TRUE(error_tells("paths: 0 is out of range")) << quasimc_last_error();
}

TEST(CStatements, ValuesAreReplacedHoweverTheyAreWritten) {
    const SceneHandle scene = small_canopy(1);
    const auto set = [&](const char* key, const char* value) {
        return quasimc_scene_set_option(scene.get(), key, value);
    };
    EXPECT_EQ(set("target_error", "0.005"), QUASIMC_DONE);
    EXPECT_EQ(set("target_error", "0"), QUASIMC_DONE) << quasimc_last_error();
    EXPECT_EQ(set("roulette_threshold", "1"), QUASIMC_DONE);
    EXPECT_EQ(set("roulette_threshold", "0.5"), QUASIMC_DONE) << quasimc_last_error();
    EXPECT_EQ(set("paths", "many"), QUASIMC_DONE);
    EXPECT_EQ(set("paths", "256"), QUASIMC_DONE) << quasimc_last_error();
    double paths = 0;
    EXPECT_EQ(quasimc_result_get_number(run(*scene).get(), "paths", &paths), QUASIMC_DONE);
    EXPECT_EQ(paths, 256);
    EXPECT_EQ(quasimc_scene_state(scene.get(), "run = 1"), QUASIMC_INPUT_ERROR);
    EXPECT_TRUE(error_tells("run is an integer")) << quasimc_last_error();
    EXPECT_EQ(quasimc_scene_state(scene.get(), "[[run]]\npaths = 1"), QUASIMC_INPUT_ERROR);
}

TEST(CStatements, FaultyArraysAreRefused) {
    const SceneHandle scene = small_canopy(1);
    SquareLeaf leaf = square_leaf(2);
    leaf.faces[4] = 4;
    EXPECT_EQ(add_leaf(*scene, leaf), QUASIMC_INPUT_ERROR);
    EXPECT_TRUE(error_tells("face 1 refers to vertex 4")) << quasimc_last_error();
    EXPECT_EQ(add_leaf(*scene, square_leaf(1)), QUASIMC_INPUT_ERROR);
    EXPECT_TRUE(error_tells("the scene has an organ with this id")) << quasimc_last_error();
    leaf = square_leaf(2);
    const std::int32_t materials[] = {0, 2};
    EXPECT_EQ(
        quasimc_scene_add_mesh(
            scene.get(), leaf.vertices.data(), 4, leaf.faces.data(), 2, nullptr, "leaf\nsoil",
            materials),
        QUASIMC_INPUT_ERROR);
    EXPECT_TRUE(error_tells("material 2")) << quasimc_last_error();
    EXPECT_EQ(
        quasimc_scene_add_mesh(
            scene.get(), leaf.vertices.data(), 4, nullptr, 2, nullptr, "leaf", nullptr),
        QUASIMC_INPUT_ERROR);
    EXPECT_TRUE(error_tells("every three vertices")) << quasimc_last_error();
    EXPECT_TRUE(run(*scene));  // none of it was taken over
}

TEST(CStatements, AnOrganMayBeOfSeveralMaterials) {
    const SceneHandle scene = lit_soil();
    const SquareLeaf leaf = square_leaf(1);
    const std::int32_t materials[] = {1, 0};
    ASSERT_EQ(
        quasimc_scene_add_mesh(
            scene.get(), leaf.vertices.data(), 4, leaf.faces.data(), 2, leaf.organ.data(),
            "leaf\nsoil", materials),
        QUASIMC_DONE);
    const SceneHandle alike = lit_soil();
    ASSERT_EQ(add_leaf(*alike, leaf), QUASIMC_DONE);
    // Soil absorbs more than leaves do.
    EXPECT_GT(
        column(*run(*scene), "absorbed_flux", "NIR")[0],
        1.2 * column(*run(*alike), "absorbed_flux", "NIR")[0]);
}

TEST(CStatements, SeveralTimesAreRefused) {
    const SceneHandle scene = small_canopy(1);
    ASSERT_EQ(
        quasimc_scene_state(
            scene.get(),
            "site = { latitude_deg = 52, longitude_deg = 6 }\n"
            "[time]\nday = \"2024-06-21\"\nutc_offset_hours = 2\n"),
        QUASIMC_DONE);
    quasimc_result* result = nullptr;
    EXPECT_EQ(quasimc_scene_run(scene.get(), nullptr, nullptr, &result), QUASIMC_INPUT_ERROR);
    EXPECT_TRUE(error_tells("a run computes one time step")) << quasimc_last_error();
}

TEST(CStatements, AMaterialOfTheSameNameReplacesTheOther) {
    const SceneHandle scene = small_canopy(2);
    const auto before = column(*run(*scene), "absorbed_flux", "PAR");
    const double rho[] = {0.5, 0.5}, tau[] = {0.4, 0.4};
    ASSERT_EQ(quasimc_scene_add_material(scene.get(), "leaf", rho, tau), QUASIMC_DONE);
    const auto bright = column(*run(*scene), "absorbed_flux", "PAR");
    EXPECT_LT(bright[0], 0.5 * before[0]);
    const double leaf_rho[] = {0.08, 0.45}, leaf_tau[] = {0.06, 0.45};
    ASSERT_EQ(quasimc_scene_add_material(scene.get(), "leaf", leaf_rho, leaf_tau), QUASIMC_DONE);
    EXPECT_EQ(column(*run(*scene), "absorbed_flux", "PAR"), before);
}

bool is_refused(quasimc_scene& scene) {
    quasimc_result* result = nullptr;
    const int status = quasimc_scene_run(&scene, nullptr, nullptr, &result);
    return status == QUASIMC_INPUT_ERROR && result == nullptr;
}

TEST(CStatements, WhatARunRefusesIsTakenBack) {
    const SceneHandle scene = small_canopy(1);
    const auto before = column(*run(*scene), "absorbed_flux", "PAR");
    const double light[] = {std::nan(""), 50}, sky[] = {80, 20}, sun[] = {400, 380};
    ASSERT_EQ(quasimc_scene_add_sky(scene.get(), "uniform", light), QUASIMC_DONE);
    EXPECT_TRUE(is_refused(*scene));
    ASSERT_EQ(quasimc_scene_clear(scene.get(), QUASIMC_SOURCES), QUASIMC_DONE);
    ASSERT_EQ(quasimc_scene_add_sun(scene.get(), 135, 50, sun), QUASIMC_DONE);
    ASSERT_EQ(quasimc_scene_add_sky(scene.get(), "cie_overcast", sky), QUASIMC_DONE);
    EXPECT_EQ(column(*run(*scene), "absorbed_flux", "PAR"), before);

    ASSERT_EQ(quasimc_scene_state(scene.get(), "colour = 3\n[sweep]\n"), QUASIMC_DONE);
    EXPECT_TRUE(is_refused(*scene));
    EXPECT_TRUE(error_tells("unknown key 'colour'")) << quasimc_last_error();
    EXPECT_TRUE(error_tells("[sweep] describes several runs")) << quasimc_last_error();
    ASSERT_EQ(quasimc_scene_clear(scene.get(), QUASIMC_UNKNOWN_KEYS), QUASIMC_DONE);
    ASSERT_EQ(quasimc_scene_clear(scene.get(), QUASIMC_SWEEP), QUASIMC_DONE);
    EXPECT_EQ(column(*run(*scene), "absorbed_flux", "PAR"), before);

    SquareLeaf far = square_leaf(2);
    far.vertices[0] = std::nan("");
    ASSERT_EQ(add_leaf(*scene, far), QUASIMC_DONE);
    EXPECT_TRUE(is_refused(*scene));
    ASSERT_EQ(quasimc_scene_clear(scene.get(), QUASIMC_ORGANS), QUASIMC_DONE);
    ASSERT_EQ(add_leaf(*scene, square_leaf(1)), QUASIMC_DONE);
    EXPECT_EQ(column(*run(*scene), "absorbed_flux", "PAR"), before);
    EXPECT_EQ(quasimc_scene_clear(scene.get(), QUASIMC_TIME), QUASIMC_DONE) << "there is none";
}

TEST(CStatements, FilesOfMaterialsAndOfLightAreClearedWithTheirPart) {
    const SceneHandle scene = small_canopy(1);
    const auto before = column(*run(*scene), "absorbed_flux", "PAR");
    ASSERT_EQ(
        quasimc_scene_state(scene.get(), "[[light_file]]\nfile = 'nowhere.light'"), QUASIMC_DONE);
    EXPECT_TRUE(is_refused(*scene));
    ASSERT_EQ(quasimc_scene_clear(scene.get(), QUASIMC_SOURCES), QUASIMC_DONE);
    const double sun[] = {400, 380}, sky[] = {80, 20};
    ASSERT_EQ(quasimc_scene_add_sun(scene.get(), 135, 50, sun), QUASIMC_DONE);
    ASSERT_EQ(quasimc_scene_add_sky(scene.get(), "cie_overcast", sky), QUASIMC_DONE);
    EXPECT_EQ(column(*run(*scene), "absorbed_flux", "PAR"), before);

    ASSERT_EQ(
        quasimc_scene_state(scene.get(), "[[material_file]]\nfile = 'nowhere.opt'"), QUASIMC_DONE);
    EXPECT_TRUE(is_refused(*scene));
    ASSERT_EQ(quasimc_scene_clear(scene.get(), QUASIMC_MATERIALS), QUASIMC_DONE);
    const double leaf_rho[] = {0.08, 0.45}, leaf_tau[] = {0.06, 0.45}, soil_rho[] = {0.1, 0.2};
    ASSERT_EQ(quasimc_scene_add_material(scene.get(), "leaf", leaf_rho, leaf_tau), QUASIMC_DONE);
    ASSERT_EQ(quasimc_scene_add_material(scene.get(), "soil", soil_rho, nullptr), QUASIMC_DONE);
    EXPECT_EQ(column(*run(*scene), "absorbed_flux", "PAR"), before);
}

TEST(CStatements, UnknownKeysAreClearedWithoutAxesAndUnits) {
    const SceneHandle scene = small_canopy(1);
    const auto before = column(*run(*scene), "absorbed_flux", "PAR");
    ASSERT_EQ(quasimc_scene_state(scene.get(), "north = [1, 0, 0]"), QUASIMC_DONE);
    const auto turned = column(*run(*scene), "absorbed_flux", "PAR");
    EXPECT_NE(turned, before);
    ASSERT_EQ(quasimc_scene_state(scene.get(), "colour = 3"), QUASIMC_DONE);
    EXPECT_TRUE(is_refused(*scene));
    ASSERT_EQ(quasimc_scene_clear(scene.get(), QUASIMC_UNKNOWN_KEYS), QUASIMC_DONE);
    EXPECT_EQ(column(*run(*scene), "absorbed_flux", "PAR"), turned);
    ASSERT_EQ(quasimc_scene_clear(scene.get(), QUASIMC_OTHER), QUASIMC_DONE);
    EXPECT_EQ(column(*run(*scene), "absorbed_flux", "PAR"), before);
}

TEST(CStatements, ALabelWithoutAValueKeepsTheFormer) {
    const SceneHandle scene = small_canopy(1);
    ASSERT_EQ(quasimc_scene_set_label(scene.get(), 1, "plant", "3"), QUASIMC_DONE);
    EXPECT_EQ(quasimc_scene_set_label(scene.get(), 1, "plant", nullptr), QUASIMC_MISUSE);
    EXPECT_STREQ(quasimc_result_organ_label(run(*scene).get(), 0, "plant"), "3");
}

}  // namespace
}  // namespace quasimc::test

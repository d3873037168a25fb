#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "unit/capi/canopy.h"

namespace quasimc::test {
namespace {

TEST(CMisuse, NullIsRefused) {
    EXPECT_EQ(quasimc_scene_new(nullptr), QUASIMC_MISUSE);
    EXPECT_STREQ(quasimc_last_error(), "scene is NULL");
    EXPECT_EQ(quasimc_scene_add_band(nullptr, "PAR", nullptr), QUASIMC_MISUSE);
    EXPECT_EQ(quasimc_scene_run(nullptr, nullptr, nullptr, nullptr), QUASIMC_MISUSE);
    quasimc_result* result = nullptr;
    EXPECT_EQ(quasimc_scene_run(nullptr, nullptr, nullptr, &result), QUASIMC_MISUSE);
    EXPECT_EQ(quasimc_growth_new(nullptr, nullptr), QUASIMC_MISUSE);
    EXPECT_EQ(quasimc_result_organ_count(nullptr), -1);
    EXPECT_EQ(quasimc_result_organ_name(nullptr, 0), nullptr);
    const SceneHandle scene = new_scene();
    EXPECT_EQ(quasimc_scene_add_band(scene.get(), nullptr, nullptr), QUASIMC_MISUSE);
    EXPECT_STREQ(quasimc_last_error(), "name is NULL");
    EXPECT_EQ(quasimc_scene_add_sun(scene.get(), 0, 90, nullptr), QUASIMC_MISUSE);
    EXPECT_EQ(
        quasimc_scene_add_mesh(scene.get(), nullptr, 3, nullptr, 1, nullptr, "leaf", nullptr),
        QUASIMC_MISUSE);
    quasimc_scene_free(nullptr);
    quasimc_growth_free(nullptr);
    quasimc_result_free(nullptr);
}

TEST(CMisuse, WhatIsNotThereIsRefused) {
    const ResultHandle result = run(*small_canopy(1));
    EXPECT_EQ(quasimc_result_organ_name(result.get(), 2), nullptr);
    EXPECT_STREQ(quasimc_last_error(), "there is no organ 2: there are 2");
    EXPECT_EQ(quasimc_result_organ_id(result.get(), -1), -1);
    EXPECT_EQ(quasimc_result_band_name(result.get(), 2), nullptr);
    EXPECT_EQ(quasimc_quantity_name(6), nullptr);
    EXPECT_EQ(quasimc_result_group_by(result.get(), 1), nullptr);
    EXPECT_EQ(quasimc_result_warning(result.get(), 0), nullptr);
    double values[2];
    const auto get = [&](const char* quantity, const char* band, const char* what, int count) {
        return quasimc_result_get(result.get(), quantity, band, what, values, count);
    };
    EXPECT_EQ(get("absorbed_flux", "PAR", "mean", 2), QUASIMC_DONE);
    EXPECT_EQ(get("absorbed_flux", "PAR", "mean", 1), QUASIMC_MISUSE);
    EXPECT_EQ(get("absorbed_flux", "UV", "mean", 2), QUASIMC_MISUSE);
    EXPECT_EQ(get("absorbed_flux", nullptr, "mean", 2), QUASIMC_MISUSE);
    EXPECT_EQ(get("absorbed_flux", "PAR", "median", 2), QUASIMC_MISUSE);
    EXPECT_EQ(get("greenness", "PAR", "mean", 2), QUASIMC_MISUSE);
    EXPECT_EQ(get("R:FR", nullptr, "mean", 2), QUASIMC_MISUSE);
    double estimate[4];
    EXPECT_EQ(
        quasimc_result_get_organ(result.get(), 7, "absorbed_flux", "PAR", estimate),
        QUASIMC_MISUSE);
    double number = 0;
    EXPECT_EQ(quasimc_result_get_number(result.get(), "luck", &number), QUASIMC_MISUSE);
    EXPECT_EQ(quasimc_result_text(result.get(), "poem"), nullptr);
    EXPECT_EQ(quasimc_result_get_budget(result.get(), "lost", "PAR", values), QUASIMC_MISUSE);
}

TEST(CMisuse, CountsThatCannotBeAreRefused) {
    const SceneHandle scene = small_canopy(1);
    const auto before = column(*run(*scene), "absorbed_flux", "PAR");
    for (const std::int64_t count : {std::int64_t{-1}, std::int64_t{0}, INT64_MIN, INT64_MAX}) {
        quasimc_scene* s = scene.get();
        const SquareLeaf leaf = square_leaf(2);
        const auto add = [&](std::int64_t vertices, std::int64_t faces) {
            return quasimc_scene_add_mesh(
                s, leaf.vertices.data(), vertices, leaf.faces.data(), faces, leaf.organ.data(),
                "leaf", nullptr);
        };
        EXPECT_EQ(add(count, 2), QUASIMC_INPUT_ERROR) << count;
        EXPECT_EQ(add(4, count), QUASIMC_INPUT_ERROR) << count;
        const ResultHandle result = run(*scene);
        double values[2];
        EXPECT_EQ(
            quasimc_result_get(result.get(), "absorbed_flux", "PAR", "mean", values, count),
            QUASIMC_MISUSE);
        EXPECT_EQ(
            quasimc_result_get_groups(result.get(), "absorbed_flux", "PAR", "mean", values, count),
            QUASIMC_MISUSE);
    }
    EXPECT_EQ(quasimc_scene_add_material(scene.get(), "x", nullptr, nullptr), QUASIMC_MISUSE);
    EXPECT_EQ(column(*run(*scene), "absorbed_flux", "PAR"), before);
}

TEST(CMisuse, NumbersOfBandsAreRefusedWhereThereAreNone) {
    const SceneHandle scene = new_scene();
    quasimc_scene* s = scene.get();
    const double numbers[] = {0.1, 0.2};
    const auto refuse_all = [&] {
        const std::array status{
            quasimc_scene_add_material(s, "x", numbers, nullptr),
            quasimc_scene_add_material(s, "x", nullptr, numbers),
            quasimc_scene_add_directional(s, 0, 0, -1, numbers),
            quasimc_scene_add_sun(s, 0, 50, numbers),
            quasimc_scene_add_sun_at(s, "2024-06-21T12:00:00Z", numbers),
            quasimc_scene_add_sky(s, "uniform", numbers),
            quasimc_scene_add_point_lamp(s, 0, 0, 9, numbers)};
        return std::ranges::all_of(status, [](int one) { return one == QUASIMC_MISUSE; });
    };
    EXPECT_TRUE(refuse_all());
    EXPECT_EQ(quasimc_scene_state(s, "bands = ['PAR']"), QUASIMC_DONE);
    EXPECT_EQ(quasimc_scene_add_sky(s, "uniform", numbers), QUASIMC_DONE);
    EXPECT_EQ(quasimc_scene_clear(s, QUASIMC_BANDS), QUASIMC_DONE);
    EXPECT_TRUE(refuse_all());
    EXPECT_EQ(quasimc_scene_clear(s, QUASIMC_SENSORS + 1), QUASIMC_MISUSE);
    EXPECT_EQ(quasimc_scene_clear(s, -1), QUASIMC_MISUSE);
}

TEST(CMisuse, AMissingFileIsAnInputError) {
    quasimc_scene* scene = nullptr;
    EXPECT_EQ(quasimc_scene_load("/nowhere/canopy.toml", &scene), QUASIMC_INPUT_ERROR);
    EXPECT_EQ(scene, nullptr);
    EXPECT_NE(std::string(quasimc_last_error()).find("/nowhere/canopy.toml"), std::string::npos);
}

TEST(CMisuse, ErrorsBelongToTheirThread) {
    ASSERT_EQ(quasimc_scene_new(nullptr), QUASIMC_MISUSE);
    std::string in_other;
    std::thread([&] { in_other = quasimc_last_error(); }).join();
    EXPECT_EQ(in_other, "");
    EXPECT_STREQ(quasimc_last_error(), "scene is NULL");
}

struct Watched {
    quasimc_scene* scene;
    int calls = 0;
    int inner = QUASIMC_DONE;
};

int use_the_scene(double fraction, double seconds, double expected_seconds, void* user) {
    auto& watched = *static_cast<Watched*>(user);
    ++watched.calls;
    EXPECT_GE(fraction, 0);
    EXPECT_LE(seconds, expected_seconds * 1.001);
    quasimc_result* result = nullptr;
    watched.inner = quasimc_scene_run(watched.scene, nullptr, nullptr, &result);
    return 1;
}

/// A run that is long enough to report its progress.
SceneHandle long_run() {
    SceneHandle scene = small_canopy(3);
    EXPECT_EQ(
        quasimc_scene_state(scene.get(), "[run]\npaths = 1048576\nmethod = \"light_tracing\"\n"),
        QUASIMC_DONE);
    return scene;
}

TEST(CMisuse, ASceneIsNotRunFromItsOwnProgressFunction) {
    const SceneHandle scene = long_run();
    Watched watched{scene.get()};
    quasimc_result* result = nullptr;
    ASSERT_EQ(quasimc_scene_run(scene.get(), &use_the_scene, &watched, &result), QUASIMC_STOPPED);
    EXPECT_GT(watched.calls, 0);
    EXPECT_EQ(watched.inner, QUASIMC_MISUSE);
    ASSERT_EQ(quasimc_scene_set_option(scene.get(), "paths", "64"), QUASIMC_DONE);
    EXPECT_TRUE(run(*scene));
}

int stop_at_once(double, double, double, void*) {
    return 1;
}

TEST(CMisuse, AProgressFunctionEndsARun) {
    const SceneHandle scene = long_run();
    quasimc_result* result = nullptr;
    EXPECT_EQ(quasimc_scene_run(scene.get(), &stop_at_once, nullptr, &result), QUASIMC_STOPPED);
    EXPECT_EQ(result, nullptr);
    EXPECT_NE(std::string(quasimc_last_error()).find("stopped"), std::string::npos);

    // With a result of the rounds that were done.
    ASSERT_EQ(quasimc_scene_set_option(scene.get(), "paths", "64"), QUASIMC_DONE);
    ASSERT_EQ(quasimc_scene_set_option(scene.get(), "target_error", "1e-9"), QUASIMC_DONE);
    const auto stop_later = [](double, double, double, void* user) {
        return ++*static_cast<int*>(user) > 3 ? 1 : 0;
    };
    int calls = 0;
    EXPECT_EQ(quasimc_scene_run(scene.get(), stop_later, &calls, &result), QUASIMC_DONE)
        << quasimc_last_error();
    const ResultHandle owner(result);
    EXPECT_STREQ(quasimc_result_text(result, "stop"), "interrupted");
}

TEST(CMisuse, TheNumberOfTheInterfaceIsThatOfTheHeader) {
    EXPECT_EQ(quasimc_abi_version(), QUASIMC_ABI_VERSION);
    EXPECT_NE(std::string(quasimc_version()), "");
}

}  // namespace
}  // namespace quasimc::test

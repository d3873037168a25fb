#include <map>

#include <gtest/gtest.h>

#include "unit/capi/canopy.h"

namespace quasimc::test {
namespace {

GrowthHandle new_growth(quasimc_scene& scene) {
    quasimc_growth* growth = nullptr;
    EXPECT_EQ(quasimc_growth_new(&scene, &growth), QUASIMC_DONE) << quasimc_last_error();
    return GrowthHandle(growth);
}

using GiveMesh = decltype(&quasimc_growth_add_mesh);

int give(quasimc_growth& growth, GiveMesh how, const SquareLeaf& leaf) {
    return how(
        &growth, leaf.vertices.data(), 4, leaf.faces.data(), 2, leaf.organ.data(), "leaf", nullptr);
}

ResultHandle step(quasimc_growth& growth) {
    quasimc_result* result = nullptr;
    EXPECT_EQ(quasimc_growth_run(&growth, nullptr, nullptr, &result), QUASIMC_DONE)
        << quasimc_last_error();
    return ResultHandle(result);
}

TEST(CGrowth, StepsGiveTheBitsOfSingleRuns) {
    const SceneHandle soil = lit_soil();
    const GrowthHandle growth = new_growth(*soil);
    std::map<std::int64_t, SquareLeaf> alive;
    for (std::int64_t id = 1; id <= 6; ++id) {
        alive[id] = square_leaf(id);
        ASSERT_EQ(give(*growth, &quasimc_growth_add_mesh, alive[id]), QUASIMC_DONE);
        if (id == 4) {
            ASSERT_EQ(quasimc_growth_remove(growth.get(), 2), QUASIMC_DONE);
            alive.erase(2);
        }
        alive[1] = square_leaf(1, 1 + 0.1 * static_cast<double>(id));
        ASSERT_EQ(give(*growth, &quasimc_growth_change_mesh, alive[1]), QUASIMC_DONE);

        const SceneHandle alone = lit_soil();
        for (const auto& [organ, leaf] : alive) {
            ASSERT_EQ(add_leaf(*alone, leaf), QUASIMC_DONE);
        }
        EXPECT_EQ(
            column(*step(*growth), "absorbed_flux", "PAR"),
            column(*run(*alone), "absorbed_flux", "PAR"));
    }
}

TEST(CGrowth, TakesTheLightAndOptionsThatTheSceneHasThen) {
    const SceneHandle scene = small_canopy(1);
    const GrowthHandle growth = new_growth(*scene);
    const auto before = column(*step(*growth), "absorbed_flux", "PAR");
    ASSERT_EQ(quasimc_scene_clear(scene.get(), QUASIMC_SOURCES), QUASIMC_DONE);
    const double bright[] = {4000, 4000};
    ASSERT_EQ(quasimc_scene_add_sky(scene.get(), "uniform", bright), QUASIMC_DONE);
    EXPECT_GT(column(*step(*growth), "absorbed_flux", "PAR")[0], 2 * before[0]);
    const double black[] = {0, 0};
    ASSERT_EQ(quasimc_scene_add_material(scene.get(), "ink", black, black), QUASIMC_DONE);
    EXPECT_EQ(quasimc_growth_update_scene(growth.get()), QUASIMC_DONE) << quasimc_last_error();
    EXPECT_TRUE(step(*growth));
}

TEST(CGrowth, OrgansThatAreNotThereAreRefused) {
    const SceneHandle scene = lit_soil();
    const GrowthHandle growth = new_growth(*scene);
    ASSERT_EQ(give(*growth, &quasimc_growth_add_mesh, square_leaf(1)), QUASIMC_DONE);
    EXPECT_EQ(give(*growth, &quasimc_growth_add_mesh, square_leaf(1)), QUASIMC_INPUT_ERROR);
    EXPECT_EQ(give(*growth, &quasimc_growth_change_mesh, square_leaf(2)), QUASIMC_INPUT_ERROR);
    EXPECT_EQ(quasimc_growth_remove(growth.get(), 2), QUASIMC_INPUT_ERROR);
    const SquareLeaf leaf = square_leaf(3);
    EXPECT_EQ(
        quasimc_growth_add_mesh(
            growth.get(), leaf.vertices.data(), 4, leaf.faces.data(), 2, nullptr, "leaf", nullptr),
        QUASIMC_MISUSE);
}

/// Two leaves in one call.
int give_two(
    quasimc_growth& growth, GiveMesh how, const SquareLeaf& first, const SquareLeaf& second) {
    std::vector<double> vertices = first.vertices;
    vertices.insert(vertices.end(), second.vertices.begin(), second.vertices.end());
    const std::vector<std::int32_t> faces{0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
    std::vector<std::int64_t> organs = first.organ;
    organs.insert(organs.end(), second.organ.begin(), second.organ.end());
    return how(&growth, vertices.data(), 8, faces.data(), 4, organs.data(), "leaf", nullptr);
}

TEST(CGrowth, ACallChangesAllOrNothing) {
    const SceneHandle scene = small_canopy(1);
    const GrowthHandle growth = new_growth(*scene);
    ASSERT_EQ(give(*growth, &quasimc_growth_add_mesh, square_leaf(2)), QUASIMC_DONE);
    const auto before = column(*step(*growth), "absorbed_flux", "PAR");
    EXPECT_EQ(
        give_two(*growth, &quasimc_growth_change_mesh, square_leaf(2, 1.5), square_leaf(9)),
        QUASIMC_INPUT_ERROR);
    EXPECT_EQ(
        give_two(*growth, &quasimc_growth_add_mesh, square_leaf(3), square_leaf(2)),
        QUASIMC_INPUT_ERROR);
    // Organ 1 is of the scene.
    EXPECT_EQ(
        give_two(*growth, &quasimc_growth_add_mesh, square_leaf(3), square_leaf(1)),
        QUASIMC_INPUT_ERROR);
    EXPECT_EQ(quasimc_growth_remove(growth.get(), 1), QUASIMC_INPUT_ERROR);
    EXPECT_EQ(column(*step(*growth), "absorbed_flux", "PAR"), before);
}

TEST(CGrowth, AStepTellsTheWarningsOfASingleRun) {
    const SceneHandle scene = lit_soil();
    const GrowthHandle growth = new_growth(*scene);
    SquareLeaf below = square_leaf(1);
    for (std::size_t i = 2; i < below.vertices.size(); i += 3) {
        below.vertices[i] -= 1;
    }
    ASSERT_EQ(give(*growth, &quasimc_growth_add_mesh, below), QUASIMC_DONE);
    ASSERT_EQ(add_leaf(*scene, below), QUASIMC_DONE);
    const ResultHandle alone = run(*scene);
    const ResultHandle result = step(*growth);
    ASSERT_EQ(quasimc_result_warning_count(result.get()), 1);
    ASSERT_EQ(quasimc_result_warning_count(alone.get()), 1);
    EXPECT_STREQ(quasimc_result_warning(result.get(), 0), quasimc_result_warning(alone.get(), 0));
}

}  // namespace
}  // namespace quasimc::test

#include "unit/capi/canopy.h"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

constexpr const char* kLight = R"(
bands = ["PAR", "NIR"]
[run]
paths = 512
method = "first_hits"
seed = 5
[[source]]
type = "sun"
azimuth_deg = 135
elevation_deg = 50
irradiance_facing = [400, 380]
[[source]]
type = "sky"
model = "cie_overcast"
irradiance_horizontal = [80, 20]
[[material]]
name = "leaf"
reflectance = [0.08, 0.45]
transmittance = [0.06, 0.45]
[[material]]
name = "soil"
reflectance = [0.1, 0.2]
[ground]
material = "soil"
height = 0
[cell]
x = [0, 1]
y = [0, 1]
)";

}  // namespace

SquareLeaf square_leaf(std::int64_t id, double scale) {
    const auto number = static_cast<double>(id);
    const double side = 0.2 * scale;
    const double x = std::fmod(0.37 * number, 0.75), y = std::fmod(0.61 * number, 0.75);
    const double z = 0.1 + 0.03 * number;
    SquareLeaf leaf;
    leaf.vertices = {x, y, z, x + side, y, z + 0.02, x + side, y + side, z + 0.01, x, y + side, z};
    leaf.organ = {id, id};
    return leaf;
}

SceneHandle new_scene() {
    quasimc_scene* scene = nullptr;
    EXPECT_EQ(quasimc_scene_new(&scene), QUASIMC_DONE);
    return SceneHandle(scene);
}

SceneHandle lit_soil() {
    SceneHandle scene = new_scene();
    const double leaf_rho[] = {0.08, 0.45}, leaf_tau[] = {0.06, 0.45}, soil_rho[] = {0.1, 0.2};
    const double sun[] = {400, 380}, sky[] = {80, 20};
    int failed = 0;
    failed |= quasimc_scene_add_band(scene.get(), "PAR", nullptr);
    failed |= quasimc_scene_add_band(scene.get(), "NIR", "W m-2");
    failed |= quasimc_scene_add_material(scene.get(), "leaf", leaf_rho, leaf_tau);
    failed |= quasimc_scene_add_material(scene.get(), "soil", soil_rho, nullptr);
    failed |= quasimc_scene_set_ground(scene.get(), "soil", 0);
    failed |= quasimc_scene_set_cell(scene.get(), 0, 1, 0, 1);
    failed |= quasimc_scene_add_sun(scene.get(), 135, 50, sun);
    failed |= quasimc_scene_add_sky(scene.get(), "cie_overcast", sky);
    failed |= quasimc_scene_set_option(scene.get(), "paths", "512");
    failed |= quasimc_scene_set_option(scene.get(), "method", "first_hits");
    failed |= quasimc_scene_set_option(scene.get(), "seed", "5");
    EXPECT_EQ(failed, 0) << quasimc_last_error();
    return scene;
}

int add_leaf(quasimc_scene& scene, const SquareLeaf& leaf) {
    return quasimc_scene_add_mesh(
        &scene, leaf.vertices.data(), 4, leaf.faces.data(), 2, leaf.organ.data(), "leaf", nullptr);
}

SceneHandle small_canopy(std::int64_t leaves) {
    SceneHandle scene = lit_soil();
    for (std::int64_t id = 1; id <= leaves; ++id) {
        EXPECT_EQ(add_leaf(*scene, square_leaf(id)), QUASIMC_DONE) << quasimc_last_error();
    }
    return scene;
}

std::string small_canopy_text(std::int64_t leaves) {
    std::string text = kLight;
    for (std::int64_t id = 1; id <= leaves; ++id) {
        const std::vector<double> v = square_leaf(id).vertices;
        text += fmt::format(
            "[[organ]]\nid = {}\nmaterial = \"leaf\"\nshape = \"mesh\"\n"
            "vertices = [[{}], [{}], [{}], [{}]]\nfaces = [[0, 1, 2], [0, 2, 3]]\n",
            id, fmt::join(&v[0], &v[3], ", "), fmt::join(&v[3], &v[6], ", "),
            fmt::join(&v[6], &v[9], ", "), fmt::join(&v[9], v.data() + 12, ", "));
    }
    return text;
}

ResultHandle run(quasimc_scene& scene) {
    quasimc_result* result = nullptr;
    EXPECT_EQ(quasimc_scene_run(&scene, nullptr, nullptr, &result), QUASIMC_DONE)
        << quasimc_last_error();
    return ResultHandle(result);
}

std::vector<double> column(
    const quasimc_result& result, const char* quantity, const char* band, const char* statistic) {
    const std::int64_t count = quasimc_result_organ_count(&result);
    std::vector<double> values(static_cast<std::size_t>(count));
    EXPECT_EQ(
        quasimc_result_get(&result, quantity, band, statistic, values.data(), count), QUASIMC_DONE)
        << quasimc_last_error();
    return values;
}

}  // namespace quasimc::test

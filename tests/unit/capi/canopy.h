#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "quasimc/capi.h"

namespace quasimc::test {

struct FreeHandle {
    void operator()(quasimc_scene* scene) const { quasimc_scene_free(scene); }
    void operator()(quasimc_growth* growth) const { quasimc_growth_free(growth); }
    void operator()(quasimc_result* result) const { quasimc_result_free(result); }
};
using SceneHandle = std::unique_ptr<quasimc_scene, FreeHandle>;
using GrowthHandle = std::unique_ptr<quasimc_growth, FreeHandle>;
using ResultHandle = std::unique_ptr<quasimc_result, FreeHandle>;

/// Two triangles.
struct SquareLeaf {
    std::vector<double> vertices;
    std::vector<std::int32_t> faces{0, 1, 2, 0, 2, 3};
    std::vector<std::int64_t> organ;
};
/// A leaf by its number; @param scale  of its side
[[nodiscard]] SquareLeaf square_leaf(std::int64_t id, double scale = 1);

[[nodiscard]] SceneHandle new_scene();
/// Bands PAR and NIR, materials leaf and soil, a ground, a periodic cell, a sun, a sky, few paths.
[[nodiscard]] SceneHandle lit_soil();
/// The same with leaves 1 to `leaves`.
[[nodiscard]] SceneHandle small_canopy(std::int64_t leaves);
/// The same as a run file.
[[nodiscard]] std::string small_canopy_text(std::int64_t leaves);
[[nodiscard]] int add_leaf(quasimc_scene& scene, const SquareLeaf& leaf);

/// Runs it; a null handle if that failed.
[[nodiscard]] ResultHandle run(quasimc_scene& scene);
/// A number of every organ.
[[nodiscard]] std::vector<double> column(
    const quasimc_result& result,
    const char* quantity,
    const char* band,
    const char* statistic = "mean");

}  // namespace quasimc::test

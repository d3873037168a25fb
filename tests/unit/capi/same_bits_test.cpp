#include <bit>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "quasimc/result.h"
#include "quasimc/run.h"
#include "quasimc/run_file.h"
#include "support/temporary_folder.h"
#include "unit/capi/canopy.h"

namespace quasimc::test {
namespace {

std::string written(const TemporaryFolder& folder, const std::string& text) {
    const auto path = folder.path() / "canopy.toml";
    std::ofstream(path) << text;
    return path.string();
}

std::uint64_t bits(double x) {
    return std::bit_cast<std::uint64_t>(x);  // an unknown error is NaN
}

/// Every number of every organ, bit by bit.
void expect_same_bits(const quasimc_result& result, const Result& expected) {
    ASSERT_EQ(quasimc_result_organ_count(&result), std::int64_t(expected.organs()));
    const char* const bands[] = {"PAR", "NIR"};
    for (std::size_t b = 0; b < 2; ++b) {
        for (const QuantityEntry& entry : quantity_table()) {
            const auto mean = column(result, entry.name.data(), bands[b]);
            const auto error = column(result, entry.name.data(), bands[b], "standard_error");
            const auto low = column(result, entry.name.data(), bands[b], "ci95_low");
            const auto high = column(result, entry.name.data(), bands[b], "ci95_high");
            for (std::size_t i = 0; i < expected.organs(); ++i) {
                const Estimate e = reported(expected.at(i, entry.quantity, b));
                EXPECT_EQ(bits(mean[i]), bits(e.mean)) << entry.name;
                EXPECT_EQ(bits(error[i]), bits(e.standard_error)) << entry.name;
                EXPECT_EQ(bits(low[i]), bits(e.ci95_low)) << entry.name;
                EXPECT_EQ(bits(high[i]), bits(e.ci95_high)) << entry.name;
            }
        }
    }
    const auto sunlit = column(result, "sunlit_fraction", nullptr);
    for (std::size_t i = 0; i < expected.organs(); ++i) {
        EXPECT_EQ(sunlit[i], reported(expected.sunlit_fraction[i]).mean);
    }
}

/// Every number of sunlit and shaded parts.
void expect_same_parts(const quasimc_result& result, const Result& expected) {
    for (const SunShadeEntry& entry : sun_shade_table()) {
        const auto mean = column(result, entry.name.data(), entry.has_bands() ? "NIR" : nullptr);
        for (std::size_t i = 0; i < expected.organs(); ++i) {
            const Estimate e = reported(expected.sun_shade.at(i, entry.quantity, 1));
            EXPECT_EQ(bits(mean[i]), bits(e.mean)) << entry.name;
        }
    }
}

TEST(CInterface, GivesTheBitsOfTheLibraryFromArraysAndFromARunFile) {
    const TemporaryFolder folder;
    const std::string path = written(folder, small_canopy_text(12));
    const RunFile file = read_run_file(path);
    const Result expected = quasimc::run(file.scene, file.sources, file.spec);

    const SceneHandle given = small_canopy(12);
    const ResultHandle from_arrays = run(*given);
    ASSERT_TRUE(from_arrays) << quasimc_last_error();
    expect_same_bits(*from_arrays, expected);

    quasimc_scene* loaded = nullptr;
    ASSERT_EQ(quasimc_scene_load(path.c_str(), &loaded), QUASIMC_DONE) << quasimc_last_error();
    const SceneHandle owner(loaded);
    const ResultHandle from_file = run(*loaded);
    ASSERT_TRUE(from_file);
    expect_same_bits(*from_file, expected);
}

TEST(CInterface, GivesTheLightOfSunlitAndShadedParts) {
    const TemporaryFolder folder;
    RunFile file = read_run_file(written(folder, small_canopy_text(12)));
    const SceneHandle scene = small_canopy(12);
    const ResultHandle whole = run(*scene);
    double value = 0;
    EXPECT_EQ(
        quasimc_result_get(whole.get(), "incident_upper_sunlit", "PAR", "mean", &value, 1),
        QUASIMC_MISUSE);
    ASSERT_EQ(quasimc_scene_set_option(scene.get(), "sun_shade", "apart"), QUASIMC_DONE);
    file.spec.sun_shade = SunShade::apart;
    expect_same_parts(*run(*scene), quasimc::run(file.scene, file.sources, file.spec));
}

TEST(CInterface, AnotherSeedGivesOtherBits) {
    const SceneHandle scene = small_canopy(3);
    const std::vector<double> before = column(*run(*scene), "absorbed_flux", "PAR");
    ASSERT_EQ(quasimc_scene_set_option(scene.get(), "seed", "6"), QUASIMC_DONE);
    EXPECT_NE(column(*run(*scene), "absorbed_flux", "PAR"), before);
    ASSERT_EQ(quasimc_scene_set_option(scene.get(), "seed", "5"), QUASIMC_DONE);
    EXPECT_EQ(column(*run(*scene), "absorbed_flux", "PAR"), before);
}

TEST(CInterface, FacesMayComeInAnyOrderOfOrgansAndEveryThreeVerticesMayBeAFace) {
    const SceneHandle expected = small_canopy(2);

    const SceneHandle one_call = lit_soil();
    std::vector<double> corners;
    std::vector<std::int64_t> organs;
    for (const std::size_t face : {std::size_t{0}, std::size_t{1}}) {
        for (const std::int64_t id : {2, 1}) {
            const SquareLeaf leaf = square_leaf(id);
            for (std::size_t k = 0; k < 3; ++k) {
                const auto vertex = static_cast<std::size_t>(leaf.faces[3 * face + k]);
                corners.insert(
                    corners.end(), &leaf.vertices[3 * vertex],
                    leaf.vertices.data() + 3 * vertex + 3);
            }
            organs.push_back(id);
        }
    }
    ASSERT_EQ(
        quasimc_scene_add_mesh(
            one_call.get(), corners.data(), 12, nullptr, 4, organs.data(), "leaf", nullptr),
        QUASIMC_DONE)
        << quasimc_last_error();
    EXPECT_EQ(
        column(*run(*one_call), "incident_upper", "NIR"),
        column(*run(*expected), "incident_upper", "NIR"));
}

}  // namespace
}  // namespace quasimc::test

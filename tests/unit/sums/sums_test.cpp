#include "quasimc/sums.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace quasimc {
namespace {

Sums some_sums() {
    Sums sums;
    sums.layout = {
        .regions = 2,
        .spectra = 1,
        .bands = 2,
        .absorbed_light = AbsorbedLight::summed,
        .detectors = {{"escaped by direction", 3}}};
    sums.units = {
        .flux = {1.5, 2},
        .flux_per_find = {1, 1},
        .sunlit_area = .25,
        .sunlit_area_per_find = 1,
        .region_scale = {1, 2},
        .find_scale = {1, .5}};
    sums.spectra = {{1, .5}};
    sums.emitted_flux = {3, 4};
    sums.escaped = EscapedLight::remainder;
    sums.replicates.assign(3, ExactBins(sums.layout.bins()));
    for (std::size_t i = 0; i < sums.layout.bins(); ++i) {
        sums.replicates[i % 3].add(i, static_cast<std::int64_t>(i * i));
    }
    sums.replicates[1].add(0, ExactBins::kCarry);
    sums.paths = 64;
    sums.samples = 32;
    sums.digest = 0x1234;
    return sums;
}

TEST(Sums, AddPathsOfTheSameRun) {
    const Sums one = some_sums();
    Sums two = one;
    two += one;
    EXPECT_EQ(two.paths, 128U);
    EXPECT_EQ(two.samples, 64U);
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t i = 0; i < one.layout.bins(); ++i) {
            EXPECT_EQ(two.replicates[r].steps(i).low, 2 * one.replicates[r].steps(i).low);
        }
    }
    EXPECT_EQ(two.replicates[1].steps(0).carries, 2);
}

TEST(Sums, RefuseToAddAnotherRuns) {
    const Sums one = some_sums();
    std::vector<Sums> others(5, one);
    others[0].digest = 1;
    others[1].units.flux[0] = 7;
    others[2].replicates.pop_back();
    others[3].layout.detectors.clear();
    others[4].spectra[0][1] = .6;
    for (const Sums& other : others) {
        Sums sums = one;
        EXPECT_THROW(sums += other, std::invalid_argument);
        EXPECT_TRUE(sums == one) << "nothing was added";
    }
}

TEST(Sums, AreReadAsTheyWereSaved) {
    const Sums sums = some_sums();
    const std::string bytes = save_sums(sums);
    EXPECT_TRUE(load_sums(bytes) == sums);
    EXPECT_EQ(save_sums(load_sums(bytes)), bytes);
}

TEST(Sums, AreNotReadFromBytesThatChanged) {
    const std::string bytes = save_sums(some_sums());
    for (std::size_t i = 0; i < bytes.size(); i += 7) {
        std::string changed = bytes;
        changed[i] = static_cast<char>(changed[i] ^ 1);
        EXPECT_THROW(static_cast<void>(load_sums(changed)), std::invalid_argument) << i;
        EXPECT_THROW(static_cast<void>(load_sums(bytes.substr(0, i))), std::invalid_argument) << i;
    }
    EXPECT_THROW(static_cast<void>(load_sums(bytes + "x")), std::invalid_argument);
}

TEST(Sums, NameEveryBinOnce) {
    const SumLayout layout = some_sums().layout;
    std::vector<int> names(layout.bins());
    for (const SumBlock& block : layout.blocks()) {
        for (std::size_t row = 0; row < block.rows; ++row) {
            for (std::size_t column = 0; column < block.columns; ++column) {
                ++names[block.bin(row, column)];
            }
        }
    }
    EXPECT_EQ(names, std::vector<int>(layout.bins(), 1));
}

}  // namespace
}  // namespace quasimc

#include "quasimc/sums.h"

#include <stdexcept>
#include <utility>

#include <gtest/gtest.h>

#include "sums/light_blocks.h"
#include "sums/sum_data.h"

namespace quasimc {
namespace {

Sums some_sums() {
    SumBlocks blocks = light_blocks(1, 2, true);
    blocks.push_back(detector_block("escaped by direction", 3, 1));
    SumData sums;
    sums.layout = SumLayout(2, blocks);
    sums.units = {.flux = {1.5, 2}, .sunlit_area = .25, .region_scale = {1, 2}};
    sums.bounds = {{"direct", {1, 1}, {1, .5}}, {"sunlit", {1}}};
    sums.strategies = {{.has_suns = true, .spectra = {0}, .flux = {1, 2}, .reach = {1, 0, 1, 1}}};
    sums.per_contribution = {2};
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
    return Sums(std::move(sums));
}

TEST(Sums, AddPathsOfTheSameRun) {
    const Sums one = some_sums();
    Sums two = one;
    two += one;
    EXPECT_EQ(two.paths(), 128U);
    EXPECT_EQ(two->samples, 64U);
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t i = 0; i < one->layout.bins(); ++i) {
            EXPECT_EQ(two->replicates[r].quanta(i).low, 2 * one->replicates[r].quanta(i).low);
        }
    }
    EXPECT_EQ(two->replicates[1].quanta(0).carries, 2);
}

TEST(Sums, RefuseToAddAnotherRuns) {
    const Sums one = some_sums();
    std::vector<Sums> others(7, one);
    others[0]->digest = 1;
    others[1]->units.flux[0] = 7;
    others[2]->replicates.pop_back();
    others[3]->bounds.clear();
    others[4]->spectra[0][1] = .6;
    SumBlocks fewer = one->layout.blocks();
    fewer.pop_back();
    others[5]->layout = SumLayout(one->layout.regions(), std::move(fewer));
    others[6]->strategies[0].by = SampledBy::lines;
    for (const Sums& other : others) {
        Sums sums = one;
        EXPECT_THROW(sums += other, std::invalid_argument);
        EXPECT_TRUE(sums == one) << "nothing was added";
    }
}

TEST(Sums, AreOfNothingOnceTheyWereMovedFrom) {
    const Sums all = some_sums(), nothing;
    Sums one = all;
    Sums two = std::move(one);
    EXPECT_TRUE(two == all);
    EXPECT_TRUE(one == nothing);  // NOLINT(bugprone-use-after-move): that is what is tested
    EXPECT_EQ(one.paths(), 0U);
    Sums three = all;
    three = std::move(two);
    EXPECT_TRUE(three == all);
    const Sums copy = two;  // NOLINT(bugprone-use-after-move)
    EXPECT_TRUE(copy == nothing);
    three = two;
    EXPECT_TRUE(three == nothing);
    two = all;
    EXPECT_TRUE(two == all) << "they can be used anew";
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
    const SumLayout layout = some_sums()->layout;
    std::vector<int> names(layout.bins());
    for (const SumBlock& block : layout.blocks()) {
        const BlockBins bins = layout.find(block.name);
        const std::size_t rows = block.rows == SumBlock::Rows::regions ? layout.regions() : 1;
        for (std::size_t row = 0; row < rows; ++row) {
            for (std::size_t column = 0; column < block.columns.size(); ++column) {
                ++names[bins.bin(row, column)];
            }
        }
    }
    EXPECT_EQ(names, std::vector<int>(layout.bins(), 1));
}

TEST(Sums, KeepTheirFirstReplicates) {
    const Sums all = some_sums();
    const Sums first = first_replicates(all, 2, 16, 8);
    ASSERT_EQ(first->replicates.size(), 2U);
    EXPECT_EQ(first->replicates[1], all->replicates[1]);
    EXPECT_EQ(first.paths(), 16U);
    EXPECT_EQ(first->samples, 8U);
}

}  // namespace
}  // namespace quasimc

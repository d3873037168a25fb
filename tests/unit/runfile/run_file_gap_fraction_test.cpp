#include <algorithm>

#include <gtest/gtest.h>

#include "quasimc/run_file.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

std::string with_gaps(const std::string& keys) {
    RunText text;
    text.rest = "[[gap_fraction]]\n" + keys;
    return text.text();
}

TEST(RunFileGapFraction, HasDefaultsOfTheInstrument) {
    const RunFile run = read_text(with_gaps("at = [[1, 2, 3], [4, 5]]\n"));
    ASSERT_EQ(run.gap_fractions.size(), 1U);
    const GapFractionSpec& spec = run.gap_fractions[0];
    EXPECT_EQ(spec.name, "gap_fraction");
    ASSERT_EQ(spec.positions.size(), 2U);
    EXPECT_EQ(spec.positions[0], (Vec3{1, 2, 3}));
    EXPECT_EQ(spec.positions[1], (Vec3{4, 5, 0}));
    EXPECT_EQ(spec.rings_deg, (std::vector<double>{0, 13, 28, 43, 58, 74}));
    EXPECT_EQ(spec.azimuths, 8U);
    EXPECT_EQ(spec.rays, 4096U);
}

TEST(RunFileGapFraction, TakesAllKeys) {
    const GapFractionSpec spec =
        read_text(with_gaps("name = 'eye'\nat = { start = [0, 0, 1], along = [4, 0, 0], counts = 4 "
                            "}\nrings_deg = [0, 45, 90]\nazimuths = 1\nwhere = \"name != 'x'\"\n"
                            "rays = 100\nreplicates = 4\nseed = 3\n"))
            .gap_fractions.at(0);
    EXPECT_EQ(spec.name, "eye");
    EXPECT_EQ(spec.positions.size(), 4U);
    EXPECT_EQ(spec.rings(), 2U);
    EXPECT_EQ(spec.azimuths, 1U);
    EXPECT_EQ(spec.where, "name != 'x'");
    EXPECT_EQ(spec.rays, 100U);
    EXPECT_EQ(spec.replicates, 4U);
    EXPECT_EQ(spec.seed, 3U);
}

TEST(RunFileGapFraction, WarnsOfAConditionThatNoOrganFulfils) {
    const auto warnings = [](const std::string& where) {
        return read_text(with_gaps("at = [[0, 0]]\nwhere = \"" + where + "\"\n")).warnings;
    };
    const auto warns = [](const Warning& warning) {
        return warning.text.find("no organ fulfils \"area > 50\"") != std::string::npos;
    };
    EXPECT_TRUE(std::ranges::any_of(warnings("area > 50"), warns));
    EXPECT_FALSE(std::ranges::any_of(warnings("area > 0"), warns));
}

TEST(RunFileGapFraction, FaultsStandAtTheirLines) {
    EXPECT_TRUE(mentions(faults_of(with_gaps("azimuths = 4\n")), "at is missing"));
    EXPECT_TRUE(mentions(faults_of(with_gaps("at = [[0, 0]]\nring = 3\n")), "unknown key 'ring'"));
    EXPECT_TRUE(mentions(
        faults_of(with_gaps("at = [[0, 0]]\nrings_deg = [40, 20]\n")),
        "rings_deg are no bounds of rings"));
    EXPECT_TRUE(mentions(
        faults_of(with_gaps("at = [[0, 0]]\nrings_deg = 5\n")), "rings_deg is not a list"));
    EXPECT_TRUE(mentions(
        faults_of(with_gaps("at = [[0, 0]]\nwhere = \"knd == 'leaf'\"\n")), "unknown label 'knd'"));
    const std::string twice = with_gaps("at = [[0, 0]]\n[[gap_fraction]]\nat = [[0, 0]]\n");
    EXPECT_TRUE(mentions(faults_of(twice), "gap_fraction 'gap_fraction' exists already"));
    EXPECT_TRUE(mentions(faults_of(twice), "run.toml:"));
}

}  // namespace
}  // namespace quasimc::test

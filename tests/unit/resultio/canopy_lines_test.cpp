#include "resultio/canopy_lines.h"

#include <cmath>

#include <gtest/gtest.h>

#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

/// A run with the bands PAR, NIR and one of known wavelengths.
RunFile run_of_three_bands() {
    RunText text;
    text.top =
        "band = [{ name = 'PAR' }, { name = 'NIR' }, { name = 'own', from_nm = 400, to_nm = 700 "
        "}]\n";
    return read_text(text.text());
}

Result canopy_of(double incident, double transmittance, double absorptance) {
    Result result;
    result.bands = 3;
    const Estimate unknown{std::nan(""), std::nan(""), std::nan(""), std::nan("")};
    result.canopy.assign(
        3, {incident, unknown, {transmittance, .02, 0, 1}, {absorptance, .01, 0, 1}, unknown});
    return result;
}

TEST(CanopyLines, SpeakOfParWhereTheBandIsPar) {
    CanopySum sum(run_of_three_bands().scene);
    sum.add(canopy_of(10, .25, .5), 1);
    const std::vector<std::string> lines = sum.lines(run_of_three_bands(), nullptr);
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_EQ(lines[0], "PAR: fIPAR 0.7500 +- 0.02, fAPAR 0.5000 +- 0.01");
    EXPECT_EQ(lines[1], "NIR: intercepted 0.7500 +- 0.02, absorbed 0.5000 +- 0.01");
    EXPECT_EQ(lines[2], "own: fIPAR 0.7500 +- 0.02, fAPAR 0.5000 +- 0.01");
}

TEST(CanopyLines, WeighTimesByTheirLight) {
    CanopySum sum(run_of_three_bands().scene);
    sum.add(canopy_of(10, .25, .5), 3600);
    sum.add(canopy_of(30, .5, .25), 3600);
    Result night = canopy_of(0, std::nan(""), std::nan(""));
    sum.add(night, 3600);
    // (10 x .5 + 30 x .25) / 40; errors: hypot(10, 30) x .01 / 40.
    EXPECT_EQ(
        sum.lines(run_of_three_bands(), nullptr)[0],
        "PAR: fIPAR 0.5625 +- 0.02, fAPAR 0.3125 +- 0.008");
}

TEST(CanopyLines, NameTheSharesOfFewGroups) {
    CanopySum sum(run_of_three_bands().scene);
    sum.add(canopy_of(10, .25, .5), 1);
    GroupResults groups;
    groups.bands = 3;
    groups.groups = {
        {.by = "all", .value = ""},
        {.by = "species", .value = "maize"},
        {.by = "species", .value = "bean"},
        {.by = "plant", .value = "1"}};
    for (std::size_t g = 0; g < groups.groups.size(); ++g) {
        for (std::size_t share = 0; share < kGroupShares; ++share) {
            for (std::size_t b = 0; b < 3; ++b) {
                const double value = .1 * static_cast<double>(g + 1);
                groups.shares.push_back({value, .01, value, value});
            }
        }
    }
    EXPECT_EQ(
        sum.lines(run_of_three_bands(), &groups)[0],
        "PAR: fIPAR 0.7500 +- 0.02, fAPAR 0.5000 +- 0.01 (maize 0.200, bean 0.300)");
}

TEST(CanopyLines, AreNoneWhereNothingIsKnown) {
    EXPECT_TRUE(CanopySum(run_of_three_bands().scene).lines(run_of_three_bands(), nullptr).empty());
}

}  // namespace
}  // namespace quasimc::test

#include <cmath>

#include <gtest/gtest.h>

#include "base/angles.h"
#include "survey/gap_counts.h"

namespace quasimc::test {
namespace {

/// Counts of which each bin of a ring has the gap fraction of its sector, the same in every
/// replicate.
GapCounts counts_of(const GapFractionSpec& spec, const std::vector<double>& gaps_by_sector) {
    constexpr std::uint32_t kRays = 100000;
    GapCounts counts{spec.positions.size(), spec.rings(), spec.azimuths,
                     spec.replicates,       kRays,        {}};
    counts.open.resize(counts.replicates * counts.positions * counts.bins());
    for (std::size_t i = 0; i < counts.open.size(); ++i) {
        counts.open[i] =
            static_cast<std::uint32_t>(std::lround(gaps_by_sector[i % spec.azimuths] * kRays));
    }
    return counts;
}

GapFractionSpec spec_of(std::uint32_t azimuths) {
    GapFractionSpec spec;
    spec.positions = {{0, 0, 0}};
    spec.azimuths = azimuths;
    return spec;
}

TEST(GapIndices, OfOneGapEverywhereAreThoseOfRandomLeaves) {
    GapFractionSpec spec = spec_of(2);
    spec.rings_deg = {0, 30, 60, 90};
    const GapIndices indices = gap_indices(spec, counts_of(spec, {.25, .25}), 0, 1);
    for (const Estimate& gap : indices.gap) {
        EXPECT_DOUBLE_EQ(gap.mean, .25);
    }
    // K = -ln(P) times the mean cosine of a ring; the sum of the weights times it is 1/2.
    EXPECT_NEAR(indices.effective_plant_area_index.mean, -std::log(.25), 1e-12);
    EXPECT_NEAR(indices.plant_area_index.mean, -std::log(.25), 1e-12);
    EXPECT_NEAR(indices.clumping_index.mean, 1, 1e-12);
    EXPECT_NEAR(indices.sky_transmittance.mean, .25, 1e-12);
    EXPECT_EQ(indices.effective_plant_area_index.standard_error, 0);
    EXPECT_FALSE(indices.lai_2000);
}

TEST(GapIndices, OfSectorsThatDifferShowClumping) {
    const GapFractionSpec spec = spec_of(2);
    const double closed = std::exp(-2.0);
    const GapIndices indices = gap_indices(spec, counts_of(spec, {1, closed}), 0, 1);
    const double expected = -std::log((1 + closed) / 2);  // over the mean of ln, 1
    for (const Estimate& clumping : indices.clumping) {
        EXPECT_NEAR(clumping.mean, expected, 1e-5);
    }
    EXPECT_NEAR(indices.clumping_index.mean, expected, 1e-5);
    EXPECT_NEAR(
        indices.effective_plant_area_index.mean, expected * indices.plant_area_index.mean, 1e-4);
}

TEST(GapIndices, OfTheDefaultRingsAreThoseOfTheInstrument) {
    const GapFractionSpec spec = spec_of(4);
    const double gap = std::exp(-1.0);
    const GapIndices indices =
        gap_indices(spec, counts_of(spec, std::vector<double>(4, gap)), 0, 1);
    ASSERT_TRUE(indices.lai_2000);
    // 2 sum(weight / path) of Welles and Norman (1991).
    const double expected =
        2 * (.034 / 1.008 + .104 / 1.087 + .160 / 1.270 + .218 / 1.662 + .494 / 2.670);
    EXPECT_NEAR(indices.lai_2000->mean, expected, 1e-4);
}

TEST(GapIndices, CountAClosedSectorAsHalfARay) {
    GapFractionSpec spec = spec_of(1);
    spec.rings_deg = {0, 90};
    const GapIndices indices = gap_indices(spec, counts_of(spec, {0}), 0, 1);
    EXPECT_EQ(indices.closed_bins, 1U);
    EXPECT_NEAR(indices.effective_plant_area_index.mean, std::log(2.0 * 8 * 100000), 1e-9);
    EXPECT_GT(indices.gap[0].ci95_high, 0);
}

TEST(GapIndices, AreTheSameForTheSameSkyWhereNothingIsOpen) {
    GapFractionSpec one = spec_of(8), four = spec_of(8);
    four.positions.assign(4, Vec3{});
    const std::vector<double> closed(8, 0.0);
    const GapIndices a = gap_indices(one, counts_of(one, closed), 0, 1);
    const GapIndices b = gap_indices(four, counts_of(four, closed), 0, 4);
    EXPECT_DOUBLE_EQ(a.effective_plant_area_index.mean, b.effective_plant_area_index.mean);
    EXPECT_TRUE(std::isnan(a.clumping_index.mean) && std::isnan(b.clumping_index.mean));
    EXPECT_TRUE(std::isnan(a.clumping[0].mean) && std::isnan(b.clumping[0].mean));
    // A closed sector may count as a quarter of a ray or a whole one: ln 2 to either side.
    EXPECT_NEAR(
        a.plant_area_index.standard_error / a.plant_area_index.mean,
        std::log(2.0) / std::log(2.0 * 8 * 100000), 1e-9);
}

TEST(GapIndices, WithoutLeavesHaveNoClumping) {
    const GapFractionSpec spec = spec_of(3);
    const GapIndices indices = gap_indices(spec, counts_of(spec, {1, 1, 1}), 0, 1);
    EXPECT_EQ(indices.plant_area_index.mean, 0);
    EXPECT_TRUE(std::isnan(indices.clumping_index.mean));
    EXPECT_EQ(indices.closed_bins, 0U);
}

TEST(GapIndices, OfOneReplicateHaveNoError) {
    GapFractionSpec spec = spec_of(2);
    spec.replicates = 1;
    const GapIndices indices = gap_indices(spec, counts_of(spec, {.5, .25}), 0, 1);
    EXPECT_TRUE(std::isnan(indices.plant_area_index.standard_error));
    EXPECT_FALSE(std::isnan(indices.plant_area_index.mean));
}

}  // namespace
}  // namespace quasimc::test

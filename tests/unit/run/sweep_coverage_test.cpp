// Errors of sums over the points of a sweep, over many seeds.
//
// Points share their random numbers. The truth is a sum of many paths; the scatter of the sums over
// the seeds is what their standard errors must show.

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "quasimc/series.h"
#include "results/replicate_sum.h"
#include "results/sun_shade_replicates.h"
#include "statistical/scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

constexpr std::uint32_t kLeaves = 10;
constexpr std::size_t kReplicatesOfPoint = 8;

Scene make_stand_of_sweep() {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .4, .3));
    builder.add_material(diffuse("soil", .2, 0));
    add_leaves(builder, random_leaves(kLeaves, .6, 1, 3));
    GroundSpec soil = ground("soil");
    soil.height = -.4;
    builder.set_ground(soil);
    return std::move(builder).build();
}

using RowsOfLeaves = std::vector<std::vector<std::uint32_t>>;

/// Adds up the light of rows over points, and the squares of the errors of each point.
class PointAdder final : public RunListener {
  public:
    PointAdder(const RowsOfLeaves& rows, Quantity quantity)
        : rows_(rows), quantity_(quantity), sum_(none()), squares_(rows.size()) {}

    void set_weight(double weight) { weight_ = weight; }
    void on_sums(const SeriesSums& sums) override {
        std::vector<OrganWeights> rows;
        for (const std::vector<std::uint32_t>& row : rows_) {
            rows.push_back({row});
        }
        const std::array quantities{quantity_};
        const CombinedReplicates light =
            combine_replicates(sums.sums, sums.scene, sums.spec, rows, quantities);
        sum_.add(light, weight_);
        sum_.end_point();
        ReplicateSum point = none();
        point.add(light, weight_);
        point.end_point();
        for (std::size_t row = 0; row < rows_.size(); ++row) {
            squares_[row] += std::pow(point.estimate(row, 1).standard_error, 2);
        }
    }
    [[nodiscard]] Estimate sum(std::size_t row) const { return sum_.estimate(row, 1); }
    /// The variance of a sum of independent points.
    [[nodiscard]] double squares(std::size_t row) const { return squares_[row]; }

  private:
    [[nodiscard]] ReplicateSum none() const { return {kReplicatesOfPoint, rows_.size()}; }

    const RowsOfLeaves& rows_;
    Quantity quantity_;
    double weight_ = 1;
    ReplicateSum sum_;
    std::vector<double> squares_;
};

/// A sweep over suns.
struct Suns {
    std::vector<double> elevations, weights;
    double horizontal = 0;  ///< irradiance by the sky

    /// @param adder  a PointAdder or PartsAdder
    template <typename Adder>
    void add_up(const Scene& scene, RunSpec spec, Adder& adder) const {
        spec.replicates = kReplicatesOfPoint;
        for (std::size_t i = 0; i < elevations.size(); ++i) {
            TimeStep step;
            step.sources = {sun(elevations[i], {1}), sky({horizontal})};
            adder.set_weight(weights[i]);
            static_cast<void>(run_series(scene, {step}, spec, {.listeners = {&adder}}));
        }
    }
};

RunSpec spec_of_truth() {
    RunSpec many = spec_of(Method::first_hits, 1 << 15);
    many.seed = 12345;
    return many;
}

bool holds(const Estimate& interval, double truth) {
    return interval.ci95_low <= truth && truth <= interval.ci95_high;
}

class CoverageOfSweeps : public ::testing::TestWithParam<Method> {};

/// In squares the errors of the points would add up to a half of the error.
TEST_P(CoverageOfSweeps, HoldsTheSumOfItsPoints) {
    const int seeds = GetParam() == Method::ray_bundles ? 120 : 300;
    const Suns suns{{25, 35, 50, 60}, {31, 28, 31, 30}, .2};
    const Scene scene = make_stand_of_sweep();
    const RowsOfLeaves all{{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}};
    PointAdder truth(all, Quantity::absorbed_flux);
    suns.add_up(scene, spec_of_truth(), truth);
    const double expected = truth.sum(0).mean;
    RunSpec pilot = spec_of(GetParam(), 1 << 8);
    int right = 0;
    double scatter = 0, variance = 0, squares = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
        pilot.seed = static_cast<std::uint64_t>(seed);
        PointAdder adder(all, Quantity::absorbed_flux);
        suns.add_up(scene, pilot, adder);
        const Estimate sum = adder.sum(0);
        right += holds(sum, expected) ? 1 : 0;
        scatter += (sum.mean - expected) * (sum.mean - expected) / seeds;
        variance += sum.standard_error * sum.standard_error / seeds;
        squares += adder.squares(0) / seeds;
    }
    // Totals scatter by 0.22 / sqrt(seeds), deviations by 1 / sqrt(2 seeds): 4.9 times these.
    EXPECT_TRUE(agrees(measured_fraction(right, seeds, .95), .95, 1.2 / std::sqrt(seeds)));
    EXPECT_NEAR(std::sqrt(variance / scatter), 1, 3.5 / std::sqrt(seeds));
    EXPECT_LT(squares, .7 * variance);
}

INSTANTIATE_TEST_SUITE_P(
    EveryMethod,
    CoverageOfSweeps,
    ::testing::Values(
        Method::light_tracing, Method::first_hits, Method::from_organs, Method::ray_bundles),
    name_of);

/// Adds up the light of sunlit and shaded parts of all leaves.
class PartsAdder final : public RunListener {
  public:
    explicit PartsAdder(const Scene& scene) : sum_(kReplicatesOfPoint, 1, scene.bands().size()) {
        for (std::uint32_t leaf = 0; leaf < kLeaves; ++leaf) {
            leaves_.push_back(leaf);
            area_ += scene.organs()[leaf].area;
        }
    }

    void set_weight(double weight) { weight_ = weight; }
    void on_sums(const SeriesSums& sums) override {
        const std::array rows{OrganWeights{leaves_}};
        sum_.add({sums.sums, sums.scene, sums.spec}, {rows, {&area_, 1}, true}, {weight_, weight_});
        sum_.end_point();
        whole_ += weight_;
    }
    [[nodiscard]] Estimate at(SunShadeQuantity quantity) const {
        return sum_.estimates({&area_, 1}, {1, 1, whole_}).at(0, quantity);
    }

  private:
    std::vector<std::uint32_t> leaves_;
    double area_ = 0, weight_ = 1, whole_ = 0;
    SunShadeReplicateSum sum_;
};

class CoverageOfSummedParts : public ::testing::TestWithParam<Method> {};

/// Quotients of sums whose parts are correlated within a replicate and over points.
TEST_P(CoverageOfSummedParts, HoldsTheLightOfSunlitAndShadedArea) {
    constexpr int kSeeds = 200;
    const std::array quantities{
        SunShadeQuantity::sunlit_fraction_upper, SunShadeQuantity::incident_upper_sunlit,
        SunShadeQuantity::incident_upper_shaded, SunShadeQuantity::absorbed_flux_density_shaded};
    const Suns suns{{25, 35, 50, 60}, {31, 28, 31, 30}, .2};
    const Scene scene = make_stand_of_sweep();
    RunSpec many = spec_of_truth(), pilot = spec_of(GetParam(), 1 << 8);
    many.sun_shade = pilot.sun_shade = SunShade::apart;
    PartsAdder truth(scene);
    suns.add_up(scene, many, truth);
    std::array<int, 4> right{};
    std::array<double, 4> scatter{}, variance{};
    for (int seed = 1; seed <= kSeeds; ++seed) {
        pilot.seed = static_cast<std::uint64_t>(seed);
        PartsAdder adder(scene);
        suns.add_up(scene, pilot, adder);
        for (std::size_t i = 0; i < quantities.size(); ++i) {
            const Estimate found = adder.at(quantities[i]);
            const double expected = truth.at(quantities[i]).mean;
            right[i] += holds(found, expected) ? 1 : 0;
            scatter[i] += (found.mean - expected) * (found.mean - expected);
            variance[i] += found.standard_error * found.standard_error;
        }
    }
    for (std::size_t i = 0; i < quantities.size(); ++i) {
        EXPECT_GT(right[i], .9 * kSeeds) << i;
        EXPECT_GT(std::sqrt(variance[i] / scatter[i]), .8) << i;
        // Sunlit area scatters less than one contribution to it.
        const bool is_shaded = i >= 2;
        EXPECT_LT(std::sqrt(variance[i] / scatter[i]), is_shaded ? 1.3 : 6) << i;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Methods,
    CoverageOfSummedParts,
    ::testing::Values(Method::light_tracing, Method::first_hits, Method::from_organs),
    name_of);

/// Leaves that no path met at one sun were met at no other either: limits add up, not their
/// squares.
TEST(CoverageOfSums, HoldsLightOfFewPaths) {
    constexpr int kSeeds = 200;
    Suns suns{{}, {}, 1e-4};
    for (int i = 0; i < 12; ++i) {
        suns.elevations.push_back(40 + i);
        suns.weights.push_back(30);
    }
    const Scene scene = make_stand_of_sweep();
    RowsOfLeaves leaves;
    for (std::uint32_t leaf = 0; leaf < kLeaves; ++leaf) {
        leaves.push_back({leaf});
    }
    PointAdder truth(leaves, Quantity::incident_upper);
    suns.add_up(scene, spec_of_truth(), truth);
    RunSpec pilot = spec_of(Method::light_tracing, 32);
    int right = 0, unseen = 0;
    for (int seed = 1; seed <= kSeeds; ++seed) {
        pilot.seed = static_cast<std::uint64_t>(seed);
        PointAdder adder(leaves, Quantity::incident_upper);
        suns.add_up(scene, pilot, adder);
        for (std::uint32_t leaf = 0; leaf < kLeaves; ++leaf) {
            right += holds(adder.sum(leaf), truth.sum(leaf).mean) ? 1 : 0;
            unseen += adder.sum(leaf).mean == 0 ? 1 : 0;
        }
    }
    EXPECT_GT(right, .95 * kSeeds * kLeaves);
    EXPECT_GT(unseen, .05 * kSeeds * kLeaves);
}

}  // namespace
}  // namespace quasimc::test

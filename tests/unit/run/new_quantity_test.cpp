// A new quantity outside the engine: a solver that declares its blocks and a function that reads
// them, both here. Nothing in src/sums knows them.

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "samplers/catalogue.h"
#include "scene/scene.h"
#include "solvers/block_runner.h"
#include "statistical/scenes.h"
#include "sums/light_blocks.h"
#include "sums/statistics.h"
#include "sums/sum_data.h"

namespace quasimc::test {
namespace {

constexpr std::size_t kRegionCount = 3;
constexpr std::uint64_t kPointsPerTask = 64;

/// A solver that sums the points which fall on each region, in even and odd numbers, and all of
/// them.
class PointCounter final : public Solver {
  public:
    explicit PointCounter(const SolverInput& input) : runner_(input) {}

    [[nodiscard]] static Sums sums(std::uint32_t replicates) {
        SumBlocks blocks = light_blocks(1, 1);
        blocks.push_back({"points", SumBlock::Rows::regions, columns_of(SumColumn::Of::number, 2)});
        blocks.push_back({"all_points", SumBlock::Rows::run, {{SumColumn::Of::number}}});
        SumData sums;
        sums.layout = SumLayout(kRegionCount, blocks);
        sums.units.flux = {1};
        sums.bounds = {{"points", {1, 1}, {1, 1, 2}}};
        sums.replicates.assign(replicates, ExactBins(sums.layout.bins()));
        return Sums(std::move(sums));
    }

    void solve(const Round& round, Executor& executor, Sums& sums) override {
        const BlockBins points = sums->layout.find("points");
        const std::size_t all = sums->layout.find("all_points").first;
        const std::uint64_t blocks = round.count / kPointsPerTask;
        TaskRound tasks = executor.begin(blocks * sums->replicates.size());
        runner_.run(
            blocks, tasks, sums,
            [&](std::uint32_t replicate, std::uint64_t block, Scratch&, Tally& tally) {
                for (std::uint64_t i = 0; i < kPointsPerTask; ++i) {
                    const std::uint64_t point = round.first + block * kPointsPerTask + i;
                    const std::uint64_t region = (point * point + replicate) % kRegionCount;
                    tally.add(points.bin(region, point % 2), to_fixed(1));
                    tally.add(all, to_fixed(1));
                }
            });
        sums->paths += round.count;
        sums->samples += round.count;
    }

  private:
    struct Scratch {
        explicit Scratch(std::size_t) {}
    };
    BlockRunner<Scratch> runner_;
};

/// The fraction of the points that fall on a region, in even numbers or odd ones.
Estimate fraction_of(const Sums& sums, std::size_t region, std::size_t column) {
    const BlockBins points = sums->layout.find("points");
    std::vector<double> values;
    for (const ExactBins& bins : sums->replicates) {
        values.push_back(
            bins.value(points.bin(region, column)) / static_cast<double>(sums->samples));
    }
    const double largest = sums->bound("points").of(region, column);
    return estimate_seen_or_bound(values, largest / static_cast<double>(sums->samples));
}

/// The sums of a round of points, or of a share of it.
class NewQuantity : public ::testing::Test {
  protected:
    [[nodiscard]] Sums traced(const Round& round, Executor&& executor) const {
        Sums sums = PointCounter::sums(kReplicateCount);
        PointCounter({prepared_, *sampler_, spec_}).solve(round, executor, sums);
        return sums;
    }
    [[nodiscard]] Sums traced(const Round& round, unsigned workers = 1, Share share = {}) const {
        return traced(round, Executor(workers, {.share = share}));
    }

    static constexpr std::uint32_t kReplicateCount = 2;
    static constexpr Round kRound{0, 1024};

  private:
    static Scene scene_of_a_leaf() {
        SceneBuilder builder = make_builder();
        builder.add_material(diffuse("leaf", .3, .2));
        builder.add_organ(organ("leaf", "leaf", floor_of(0, 1, 0, 1, 1)));
        return std::move(builder).build();
    }

    Scene scene_ = scene_of_a_leaf();
    Sources sources_{sky({1})};
    RunSpec spec_;
    PreparedScene prepared_{
        scene_, sources_, spec_.start_area,
        std::make_shared<const RayCaster>(
            data_of(scene_).geometry, scene_.cell(), spec_.accelerator)};
    std::unique_ptr<Sampler> sampler_ = make_sampler("sobol");
};

TEST_F(NewQuantity, IsReadByItsName) {
    const Sums sums = traced(kRound);
    // Squares of multiples of 3 leave 0, all others 1.
    EXPECT_NEAR(fraction_of(sums, 0, 0).mean, 1. / 12, 1e-2);
    EXPECT_NEAR(fraction_of(sums, 1, 1).mean, 1. / 4, 1e-2);
    const std::size_t all = sums->layout.find("all_points").first;
    EXPECT_EQ(sums->replicates[1].value(all), 1024);
}

TEST_F(NewQuantity, HasABoundWhereNothingWasSummed) {
    const Sums none = PointCounter::sums(kReplicateCount);
    Sums sums = none;
    sums->samples = 100;
    EXPECT_EQ(fraction_of(sums, 2, 1).mean, 0);
    EXPECT_NEAR(fraction_of(sums, 2, 1).ci95_high, 3 * 2. / (2 * 100), 1e-12);
}

TEST_F(NewQuantity, IsSavedAndAdded) {
    const Sums whole = traced({0, 2048});
    Sums rounds = load_sums(save_sums(traced({0, 1024})));
    rounds += traced({1024, 1024});
    EXPECT_EQ(rounds, whole);
    Sums shares = traced(kRound, 1, {0, 1, 3});
    shares.add_share(load_sums(save_sums(traced(kRound, 2, {1, 3, 3}))));
    EXPECT_EQ(shares, traced(kRound));
    EXPECT_THROW(shares += Sums(), std::invalid_argument);
}

}  // namespace
}  // namespace quasimc::test

// Weighted sums of the light of organs.

#include "results/combine.h"

#include <array>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "quasimc/run.h"
#include "run/evaluation_of.h"
#include "statistical/scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

Scene make_leaves(std::size_t leaves = 8) {
    SceneBuilder builder = make_builder(2);
    builder.add_material(diffuse("leaf", .3, .2, 2));
    builder.add_material(diffuse("soil", .2, 0, 2));
    for (const auto& leaf : random_leaves(leaves, .6, 1, 3)) {
        builder.add_organ(organ("", "leaf", {leaf}));
    }
    OrganSpec border = organ("border", "leaf", floor_of(0, .2, 0, .2, .3));
    border.measured = false;
    builder.add_organ(std::move(border));
    builder.set_ground(ground("soil"));
    return std::move(builder).build();
}

/// Sums of a run, and all that is needed to read them.
struct Kept {
    Scene scene;
    Sources sources{sun(30, {1, 2}), sky({.5, .2})};
    RunSpec spec;
    Sums sums;
    EvaluationSpec evaluation;

    explicit Kept(Method method, std::uint64_t paths = 512, std::size_t leaves = 8)
        : scene(make_leaves(leaves)), spec(spec_of(method, paths)) {
        sums = Simulator().sums(scene, sources, spec);
        evaluation = evaluation_of(scene, sources, spec);
    }
    [[nodiscard]] std::vector<Estimate> combined(const OrganWeights& of) const {
        return combine(sums, scene, evaluation, std::span(&of, 1));
    }
};

void expect_same(const Estimate& a, const Estimate& b) {
    const auto near = [](double x, double y) {
        return (std::isnan(x) && std::isnan(y)) || std::abs(x - y) <= 1e-12 * (1 + std::abs(y));
    };
    EXPECT_TRUE(near(a.mean, b.mean)) << a.mean << " " << b.mean;
    EXPECT_TRUE(near(a.standard_error, b.standard_error))
        << a.standard_error << " " << b.standard_error;
    EXPECT_TRUE(near(a.ci95_low, b.ci95_low)) << a.ci95_low << " " << b.ci95_low;
    EXPECT_TRUE(near(a.ci95_high, b.ci95_high)) << a.ci95_high << " " << b.ci95_high;
}

class Combine : public testing::TestWithParam<Method> {};

TEST_P(Combine, WithWeightsOfOneIsTheGroupOfTheOrgans) {
    const Kept kept(GetParam());
    const GroupResults groups = evaluate_run(kept.sums, kept.scene, kept.spec, kept.sources).groups;
    const OrganGroup& all = groups.groups.front();
    ASSERT_EQ(all.organs.size(), 8U);
    const std::vector<Estimate> sums = kept.combined({all.organs});
    for (const QuantityEntry& entry : quantity_table()) {
        for (std::size_t b = 0; b < 2; ++b) {
            const Estimate& sum = sums[static_cast<std::size_t>(entry.quantity) * 2 + b];
            const Estimate of_group = groups.at(0, entry.quantity, b);
            expect_same(sum, entry.is_flux ? of_group : scaled(of_group, all.area));
        }
    }
}

TEST_P(Combine, IsProportionalToItsWeights) {
    const Kept kept(GetParam());
    const std::vector<std::uint32_t> organs{1, 4, 6};
    const std::vector<double> once{.5, 1, 2}, thrice{1.5, 3, 6};
    const std::vector<Estimate> a = kept.combined({organs, once}),
                                b = kept.combined({organs, thrice});
    for (std::size_t i = 0; i < a.size(); ++i) {
        expect_same(scaled(a[i], 3), b[i]);
    }
}

TEST_P(Combine, HasTheReplicatesOfTheSum) {
    const Kept kept(GetParam());
    const std::vector<std::uint32_t> organs{1, 4, 6};
    const std::vector<double> weights{.5, 1, 2};
    const OrganWeights of{organs, weights};
    const std::array quantities{Quantity::absorbed_flux};
    const CombinedReplicates replicates =
        combine_replicates(kept.sums, kept.scene, kept.evaluation, std::span(&of, 1), quantities);
    const std::vector<Estimate> sums = kept.combined(of);
    const std::size_t count = replicates.values.size() / 2;
    for (std::size_t b = 0; b < 2; ++b) {
        double mean = 0;
        for (std::size_t r = 0; r < count; ++r) {
            mean += replicates.values[r * 2 + b] / static_cast<double>(count);
        }
        EXPECT_NEAR(mean, sums[b].mean, 1e-12 * mean);
        EXPECT_LE(replicates.sizes[b].more, sums[b].standard_error * (1 + 1e-12));
    }
}

INSTANTIATE_TEST_SUITE_P(
    Methods,
    Combine,
    testing::Values(Method::light_tracing, Method::from_organs, Method::ray_bundles));

TEST(CombineOf, OrgansThatAreNotMeasuredIsUnknown) {
    const Kept kept(Method::from_organs);
    const std::vector<std::uint32_t> organs{0, 8};
    EXPECT_TRUE(std::isnan(kept.combined({organs}).front().mean));
}

TEST(CombineOf, NoOrgansIsZero) {
    const Kept kept(Method::light_tracing);
    const Estimate none = kept.combined({}).front();
    EXPECT_EQ(none.mean, 0);
    EXPECT_EQ(none.standard_error, 0);
}

/// Organs of long sums are read in parts.
TEST(CombineOf, ManyOrgansIsTheirGroup) {
    const Kept kept(Method::light_tracing, 4096, 3000);
    const GroupResults groups = evaluate_run(kept.sums, kept.scene, kept.spec, kept.sources).groups;
    const OrganGroup& all = groups.groups.front();
    ASSERT_EQ(all.organs.size(), 3000U);
    const auto absorbed = static_cast<std::size_t>(Quantity::absorbed_flux);
    expect_same(
        kept.combined({all.organs})[absorbed * 2], groups.at(0, Quantity::absorbed_flux, 0));
}

TEST(CombineOf, ManyOrgansHasTheSameBitsOnAnyNumberOfThreads) {
    Kept kept(Method::light_tracing, 4096, 3000);
    std::vector<std::uint32_t> organs(3000);
    std::iota(organs.begin(), organs.end(), 0);
    kept.evaluation.threads = 1;
    const std::vector<Estimate> one = kept.combined({organs});
    kept.evaluation.threads = 3;
    const std::vector<Estimate> three = kept.combined({organs});
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(one[i].mean, three[i].mean);
        EXPECT_EQ(one[i].standard_error, three[i].standard_error);
        EXPECT_EQ(one[i].ci95_high, three[i].ci95_high);
    }
}

}  // namespace
}  // namespace quasimc::test

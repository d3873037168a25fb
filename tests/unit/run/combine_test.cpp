// Weighted sums of the light of organs.

#include <array>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "quasimc/run.h"
#include "results/summable_light.h"
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
    [[nodiscard]] SummableLight light(Quantity quantity, std::size_t band) const {
        return SummableLight::of_flux(sums, scene, evaluation, quantity, band);
    }
    [[nodiscard]] Estimate combined(
        const OrganWeights& of,
        Quantity quantity = Quantity::absorbed_flux,
        std::size_t band = 0) const {
        return light(quantity, band)
            .combined(std::span(&of, 1), evaluation.threads)
            .estimates()
            .front();
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
    for (const QuantityEntry& entry : quantity_table()) {
        for (std::size_t b = 0; b < 2; ++b) {
            const Estimate of_group = groups.at(0, entry.quantity, b);
            expect_same(
                kept.combined({all.organs}, entry.quantity, b),
                entry.is_flux ? of_group : scaled(of_group, all.area));
        }
    }
}

TEST_P(Combine, OfSunlitAreaIsTheGroupOfTheOrgans) {
    const Kept kept(GetParam());
    const GroupResults groups = evaluate_run(kept.sums, kept.scene, kept.spec, kept.sources).groups;
    const OrganWeights of{groups.groups.front().organs};
    const SummableLight area =
        SummableLight::of_sunlit_area(kept.sums, kept.scene, kept.evaluation);
    expect_same(area.combined(std::span(&of, 1)).estimates().front(), groups.sunlit_area.front());
}

TEST_P(Combine, IsProportionalToItsWeights) {
    const Kept kept(GetParam());
    const std::vector<std::uint32_t> organs{1, 4, 6};
    const std::vector<double> once{.5, 1, 2}, thrice{1.5, 3, 6};
    for (const QuantityEntry& entry : quantity_table()) {
        expect_same(
            scaled(kept.combined({organs, once}, entry.quantity, 1), 3),
            kept.combined({organs, thrice}, entry.quantity, 1));
    }
}

/// Sums of sums are those of their organs.
TEST_P(Combine, IsAssociative) {
    const Kept kept(GetParam());
    const std::vector<std::uint32_t> one{0, 4, 6}, other{1, 2}, both{0, 4, 6, 1, 2}, rows{0, 1};
    const std::vector<double> weights{.5, 1, 2}, twice{1, 2, 4, 3, 3}, of_rows{2, 3};
    const SummableLight light = kept.light(Quantity::absorbed_flux, 1);
    const std::vector<OrganWeights> parts{{one, weights}, {other}};
    const OrganWeights sum{rows, of_rows}, all{both, twice};
    const SummableLight a = light.combined(parts).combined(std::span(&sum, 1));
    const SummableLight b = light.combined(std::span(&all, 1));
    expect_same(a.estimates().front(), b.estimates().front());
    EXPECT_NEAR(a.sizes().front().more, b.sizes().front().more, 1e-15);
    EXPECT_NEAR(a.sizes().front().less, b.sizes().front().less, 1e-15);
}

/// Rows of a table over a sweep are read without a table of all organs.
TEST_P(Combine, HasTheReplicatesOfTheSum) {
    const Kept kept(GetParam());
    const std::vector<std::uint32_t> organs{1, 4, 6};
    const std::vector<double> weights{.5, 1, 2};
    const OrganWeights of{organs, weights};
    const std::array quantities{Quantity::absorbed_flux, Quantity::incident_upper};
    const CombinedReplicates replicates =
        combine_replicates(kept.sums, kept.scene, kept.evaluation, std::span(&of, 1), quantities);
    for (std::size_t q = 0; q < 2; ++q) {
        for (std::size_t b = 0; b < 2; ++b) {
            const SummableLight sum = kept.light(quantities[q], b).combined(std::span(&of, 1));
            for (std::size_t r = 0; r < sum.deviations().size(); ++r) {
                const double value = sum.means().front() + sum.deviations()[r];
                EXPECT_NEAR(replicates.values[(r * 2 + q) * 2 + b], value, 1e-12 * value);
            }
            const ContributionSize one = replicates.sizes[q * 2 + b];
            EXPECT_NEAR(one.more, sum.sizes().front().more, 1e-12 * one.more);
            EXPECT_NEAR(one.less, sum.sizes().front().less, 1e-12 * one.less);
            EXPECT_LE(one.more, sum.estimates().front().standard_error * (1 + 1e-12));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    Methods,
    Combine,
    testing::Values(Method::light_tracing, Method::from_organs, Method::ray_bundles));

TEST(CombineOf, OrgansThatAreNotMeasuredIsUnknown) {
    const Kept kept(Method::from_organs);
    const std::vector<std::uint32_t> organs{0, 8};
    EXPECT_TRUE(std::isnan(kept.combined({organs}).mean));
}

TEST(CombineOf, NoOrgansIsZero) {
    const Kept kept(Method::light_tracing);
    const Estimate none = kept.combined({});
    EXPECT_EQ(none.mean, 0);
    EXPECT_EQ(none.standard_error, 0);
}

TEST(CombineOf, ManyOrgansIsTheirGroup) {
    const Kept kept(Method::light_tracing, 4096, 3000);
    const GroupResults groups = evaluate_run(kept.sums, kept.scene, kept.spec, kept.sources).groups;
    const OrganGroup& all = groups.groups.front();
    ASSERT_EQ(all.organs.size(), 3000U);
    expect_same(kept.combined({all.organs}), groups.at(0, Quantity::absorbed_flux, 0));
}

TEST(CombineOf, ManyOrgansHasTheSameBitsOnAnyNumberOfThreads) {
    Kept kept(Method::light_tracing, 4096, 3000);
    std::vector<std::uint32_t> organs(3000);
    std::iota(organs.begin(), organs.end(), 0);
    kept.evaluation.threads = 1;
    const Estimate one = kept.combined({organs});
    kept.evaluation.threads = 3;
    const Estimate three = kept.combined({organs});
    EXPECT_EQ(one.mean, three.mean);
    EXPECT_EQ(one.standard_error, three.standard_error);
    EXPECT_EQ(one.ci95_high, three.ci95_high);
}

/// Organs with few contributions each, which together have many: replicates show the error.
TEST(CombineOf, ManyContributionsToSeveralOrgansIsNotWidened) {
    const ContributionKind kind{Sample::path, 40};
    const Contributions few{.light = 10, .root = std::sqrt(10), .largest = 1, .varies = 1};
    Contributions group;
    group.include(few, kind, 1);
    EXPECT_DOUBLE_EQ((SampledContributions{kind, group}.one().more), .75);
    for (int i = 1; i < 5; ++i) {
        group.include(few, kind, 1);
    }
    EXPECT_EQ((SampledContributions{kind, group}.one().more), 0);
    EXPECT_EQ((SampledContributions{kind, group}.one().less), 0);
}

/// An organ that no sample reached is uncertain, however many reached the others.
TEST(CombineOf, ManyContributionsDoesNotHideAnOrganWithout) {
    for (const Sample sample : {Sample::path, Sample::ray}) {
        const ContributionKind kind{sample, 40};
        Contributions group;
        group.include({.light = 1e4, .root = 100, .largest = 1, .varies = 1}, kind, 1);
        group.include({.unseen = 3}, kind, 2);
        EXPECT_EQ((SampledContributions{kind, group}.one().more), 6);
        EXPECT_EQ((SampledContributions{kind, group}.one().less), 0);
    }
}

}  // namespace
}  // namespace quasimc::test

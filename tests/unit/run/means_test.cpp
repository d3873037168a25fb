// The means of evaluate_means() equal those of evaluate(), in every entry that is read.

#include "results/means.h"

#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "light/models/source.h"
#include "results/bounds/patch_error.h"
#include "run/evaluation_of.h"
#include "run/simulator.h"
#include "statistical/scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

void expect_means(
    const std::vector<Estimate>& means, const std::vector<Estimate>& whole, const char* what) {
    ASSERT_EQ(means.size(), whole.size()) << what;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        EXPECT_DOUBLE_EQ(means[i].mean, whole[i].mean) << what << ' ' << i;
    }
}

/// Leaves in a cell over a ground, in two bands.
Scene leaves_over_ground() {
    SceneBuilder builder = make_builder(2);
    builder.add_material(diffuse("leaf", .3, .2, 2));
    builder.add_material(diffuse("soil", .2, 0, 2));
    add_leaves(builder, random_leaves(40, .2, 1, 3));
    builder.set_ground(ground("soil"));
    builder.set_cell({.along_x = true, .along_y = true});
    return std::move(builder).build();
}

TEST(Means, AreThoseOfTheWholeResult) {
    const Scene scene = leaves_over_ground();
    const Sources sources{sky({1, 0.5}), sun(20, {2, 0})};
    RunSpec spec = spec_of(Method::ray_bundles, 1024);
    spec.ratios = {"b0:b1", "b1:b0"};
    spec.layers = 3;
    const Sums coarse = coarser_sums(Simulator().sums(scene, sources, spec, 0));
    const EvaluationSpec asked = evaluation_of(scene, sources, spec);
    const Result whole = evaluate(coarse, scene, asked);
    const Result means = evaluate_means(coarse, scene, asked, whole.groups.groups);
    expect_means(means.values, whole.values, "organs");
    expect_means(means.ratio_values, whole.ratio_values, "ratios");
    EXPECT_GE(whole.groups.groups.size(), 3U);
    expect_means(means.groups.values, whole.groups.values, "groups");
    expect_means(means.groups.ratio_values, whole.groups.ratio_values, "ratios of groups");
    for (std::size_t b = 0; b < 2; ++b) {
        EXPECT_EQ(means.budget[b].absorbed_by_organs.mean, whole.budget[b].absorbed_by_organs.mean);
        EXPECT_EQ(means.budget[b].escaped.mean, whole.budget[b].escaped.mean);
        EXPECT_EQ(means.canopy[b].absorptance.mean, whole.canopy[b].absorptance.mean);
    }
}

TEST(Means, AreUnknownForOrgansThatAreNotMeasured) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .3, .2));
    builder.add_organ(organ("asked for", "leaf", floor_of(0, 1, 0, 1, 1)));
    OrganSpec other = organ("other", "leaf", floor_of(2, 3, 0, 1, 1));
    other.measured = false;
    builder.add_organ(other);
    const Scene scene = std::move(builder).build();
    Sums sums =
        coarser_sums(Simulator().sums(scene, {sky({1})}, spec_of(Method::ray_bundles, 64), 0));
    sums->measured = MeasuredOrgans::requested;
    const Result means = evaluate_means(sums, scene, {}, {});
    EXPECT_GT(means.at(0, Quantity::absorbed_flux, 0).mean, 0);
    EXPECT_TRUE(std::isnan(means.at(1, Quantity::absorbed_flux, 0).mean));
}

}  // namespace
}  // namespace quasimc::test

#include "solvers/ray_bundles/bundle_budget.h"

#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "scene/scene.h"
#include "statistical/scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

/// The patches of leaves that scatter .2 of light, and of one that scatters `brightest`.
class Stand {
  public:
    explicit Stand(double brightest)
        : leaves_(leaves(brightest)),
          suns_({sun(0, {1})}),
          prepared_(
              leaves_,
              suns_,
              StartArea::silhouette,
              std::make_shared<RayCaster>(
                  data_of(leaves_).geometry, leaves_.cell(), Accelerator::embree)),
          seen_{&prepared_.caster().mesh(), {}},
          bands_(SolvedBands::of(prepared_)),
          patches_(prepared_, bands_, seen_, make_patches(prepared_, {}, patches_for(kPaths), {})) {
    }

    /// Segments for each patch.
    [[nodiscard]] double meetings(const BundleGroup& group) const {
        return patches_.area / 2 * group.directions / group.line_area / patches_.patches.count();
    }
    /// Of a step in which a thousandth of the first light is left.
    [[nodiscard]] BundleGroup of_weak() const { return budget().of_order({.001, 0}, 0); }
    [[nodiscard]] BundleBudget budget() const { return {patches_, kPaths, {1, 0}}; }

  private:
    static Scene leaves(double brightest) {
        SceneBuilder builder = make_builder();
        builder.add_material(diffuse("leaf", .1, .1));
        builder.add_material(diffuse("bright", brightest / 2, brightest / 2));
        add_leaves(builder, random_leaves(500, .05, 1, 7));
        builder.add_organ(organ("", "bright", random_leaves(1, .05, 1, 8)));
        return std::move(builder).build();
    }
    static constexpr std::uint64_t kPaths = 4096;

    Scene leaves_;
    Sources suns_;
    PreparedScene prepared_;
    ProjectedScene seen_;
    SolvedBands bands_;
    PatchScene patches_;
};

/// What a patch that is met too often sends on too much of dies out where nothing is bright. It
/// took a third of the time of dark leaves to let every step meet each group of four three times.
TEST(BundleBudget, GivesLittleToWeakLightOfDarkLeaves) {
    const Stand dark(.2);
    EXPECT_NEAR(dark.meetings(dark.of_weak()), .75 * (.2 * .2) / (.9 * .9), 1e-9);
    EXPECT_EQ(dark.of_weak().directions, 4);
}

/// One bright leaf is enough for noise that grows from step to step.
TEST(BundleBudget, MeetsGroupsOfPatchesThreeTimesWhereALeafIsBright) {
    const Stand bright(.95);
    EXPECT_NEAR(bright.meetings(bright.of_weak()), .75, 1e-9);
    EXPECT_GE(bright.of_weak().directions, 8);
}

TEST(BundleBudget, MeetsGroupsOfPatchesThreeTimesInStrongSteps) {
    const Stand dark(.2);
    const BundleBudget budget = dark.budget();
    for (const BundleGroup& group : {budget.of_order({1, 0}, 0), budget.of_all(0, 0)}) {
        EXPECT_GE(dark.meetings(group), .75 - 1e-9);
        EXPECT_GE(group.directions, 8);
    }
}

/// Of few paths and bright surfaces the many orders, each with its fewest segments, take nearly
/// all of the time, and nearly all of the error is that of the last step: 10,000 bright leaves had
/// errors of 4.8 % with 65,536 paths, and 2.2 % in half as much time again.
TEST(BundleBudget, GivesTheLastStepWhatManyOrdersTake) {
    const Stand bright(.95);
    constexpr int kOrders = 30;
    const BundleBudget budget = bright.budget();
    double of_orders = 0;
    double segments = 0;
    for (int order = 0; order < kOrders; ++order) {
        const BundleGroup group = budget.of_order({std::pow(.7, order), 0}, 0);
        of_orders += bright.meetings(group);
        segments += group.segments;
    }
    EXPECT_GE(of_orders, .75 * kOrders);
    EXPECT_NEAR(bright.meetings(budget.of_all(segments, 0)), 1.5 * of_orders, 1e-9 * of_orders);
    // If orders take little, it has the budget of the paths, whatever they take.
    const double own = bright.meetings(budget.of_all(0, 0));
    const BundleGroup one = budget.of_order({1, 0}, 0);
    EXPECT_LT(bright.meetings(one), own);
    EXPECT_NEAR(bright.meetings(budget.of_all(one.segments, 0)), own, 1e-9 * own);
}

/// So that directions grow in number as well, which otherwise would be what is left of the error.
TEST(BundleBudget, CutsPatchesBySquareRootOfVeryManyPaths) {
    constexpr std::uint64_t kMany = 1 << 16;
    EXPECT_DOUBLE_EQ(patches_for(kMany), 2 * patches_for(kMany / 2));
    EXPECT_DOUBLE_EQ(patches_for(4 * kMany), 2 * patches_for(kMany));
    EXPECT_LT(patches_for(std::uint64_t{1} << 50U), 1e7);
}

/// For few paths as well: with 328 patches for 2,048 paths two leaves got twice the light on their
/// dark sides, and reported an error of a fifth of that.
TEST(BundleBudget, CutsThousandsOfPatchesForFewPaths) {
    EXPECT_EQ(patches_for(8192), 16'384);
    EXPECT_EQ(patches_for(16'384), 16'384);
    EXPECT_EQ(patches_for(256), 2048);
}

}  // namespace
}  // namespace quasimc::test

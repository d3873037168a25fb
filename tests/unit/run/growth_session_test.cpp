#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "quasimc/run.h"
#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

SceneBuilder growth_frame(double rho = .3) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", rho, .2));
    builder.add_material(diffuse("soil", .2, 0));
    builder.set_ground({.material = "soil", .extent = {{-.2, -.2, 1.2, 1.2}}});
    return builder;
}

/// A leaf that grows from step to step.
OrganSpec growing_leaf(std::int64_t id, int step) {
    const double size = .3 + .002 * step;
    const double low = .005 * static_cast<double>(id);
    OrganSpec leaf = organ("leaf", "leaf", floor_of(low, low + size, 0, size, .1 + low));
    leaf.id = id;
    return leaf;
}

RunSpec growth_run() {
    RunSpec spec;
    spec.paths = 1024;
    spec.method = Method::first_hits;
    spec.replicates = 2;
    spec.threads = 1;
    return spec;
}

bool are_same(const Estimate& x, const Estimate& y) {
    return std::bit_cast<std::uint64_t>(x.mean) == std::bit_cast<std::uint64_t>(y.mean) &&
           std::bit_cast<std::uint64_t>(x.standard_error) ==
               std::bit_cast<std::uint64_t>(y.standard_error);
}

bool have_same_bits(const Result& a, const Result& b) {
    return a.values.size() == b.values.size() &&
           std::equal(a.values.begin(), a.values.end(), b.values.begin(), are_same);
}

class GrowthSessionTest : public ::testing::Test {
  protected:
    Result run() { return session_.run(sources_, growth_run()); }
    [[nodiscard]] Result run_alone(const std::vector<OrganSpec>& organs) const {
        SceneBuilder builder = growth_frame();
        for (const OrganSpec& organ : organs) {
            builder.add_organ(organ);
        }
        return quasimc::run(std::move(builder).build(), sources_, growth_run());
    }

    Sources sources_{make_uniform_sky("sky", {1})};
    GrowthSession session_{growth_frame()};
};

TEST_F(GrowthSessionTest, GivesInAHundredStepsTheBitsOfAHundredRuns) {
    std::vector<OrganSpec> organs;  // the organs that the session should have
    for (int step = 0; step < 100; ++step) {
        if (step % 3 == 0) {
            organs.push_back(growing_leaf(step + 1, step));
            EXPECT_EQ(session_.add(organs.back()), step + 1);
        }
        if (step % 10 == 9) {
            session_.remove(*organs[1].id);
            organs.erase(organs.begin() + 1);
        }
        organs.front() = growing_leaf(*organs.front().id, step);
        session_.change(organs.front());
        const Result result = run();
        EXPECT_TRUE(have_same_bits(result, run_alone(organs))) << "step " << step;
        EXPECT_GT(result.at(0, Quantity::absorbed_flux, 0).mean, 0) << "step " << step;
    }
    EXPECT_EQ(session_.size(), organs.size());
}

TEST_F(GrowthSessionTest, BuildsNothingForAStepInWhichNothingChanged) {
    session_.add(growing_leaf(1, 0));
    static_cast<void>(run());
    static_cast<void>(run());
    EXPECT_EQ(session_.scene_builds(), 1U);
    EXPECT_EQ(session_.tree_builds(), 1U);
}

TEST_F(GrowthSessionTest, KeepsTheTreeWhenOpticsChange) {
    session_.add(growing_leaf(1, 0));
    const Result before = run();
    session_.set_frame(growth_frame(.6));
    EXPECT_FALSE(have_same_bits(run(), before));
    EXPECT_EQ(session_.scene_builds(), 2U);
    EXPECT_EQ(session_.tree_builds(), 1U);
}

TEST_F(GrowthSessionTest, GivesIndicesInTheOrderAsked) {
    for (const std::int64_t id : {5, 3, 8}) {
        session_.add(growing_leaf(id, 0));
    }
    const std::array<std::int64_t, 3> asked{8, 5, 3};
    EXPECT_EQ(session_.indices_of(asked), (std::vector<std::size_t>{2, 0, 1}));
    const std::array<std::int64_t, 1> unknown{4};
    EXPECT_THROW(static_cast<void>(session_.indices_of(unknown)), InputError);
}

TEST_F(GrowthSessionTest, GivesNoIdASecondTime) {
    OrganSpec leaf = growing_leaf(7, 0);
    session_.add(leaf);
    session_.remove(7);
    leaf.id.reset();
    EXPECT_EQ(session_.add(leaf), 8);
    leaf.id = 8;
    EXPECT_THROW(session_.add(leaf), InputError);
    EXPECT_THROW(session_.remove(7), InputError);
    leaf.id = 7;
    EXPECT_THROW(session_.change(leaf), InputError);
}

TEST_F(GrowthSessionTest, TakesNoFaultyOrgan) {
    session_.add(growing_leaf(1, 0));
    OrganSpec of_glass = growing_leaf(2, 0);
    of_glass.parts[0].material = "glass";
    OrganSpec nowhere = growing_leaf(2, 0);
    nowhere.parts[0].triangles.vertices[1].x = std::numeric_limits<double>::quiet_NaN();
    for (const OrganSpec& faulty : {of_glass, nowhere}) {
        EXPECT_THROW(session_.add({growing_leaf(3, 0), faulty}), InputError);
        EXPECT_EQ(session_.size(), 1U);
    }
    session_.add(growing_leaf(2, 0));
    for (const OrganSpec& faulty : {of_glass, nowhere}) {
        EXPECT_THROW(session_.change({growing_leaf(1, 50), faulty}), InputError);
    }
    EXPECT_TRUE(have_same_bits(run(), run_alone({growing_leaf(1, 0), growing_leaf(2, 0)})));
}

TEST_F(GrowthSessionTest, ChangesAllOrNone) {
    const std::vector<OrganSpec> before{growing_leaf(1, 0), growing_leaf(2, 0)};
    session_.add(before);
    EXPECT_THROW(session_.change({growing_leaf(1, 50), growing_leaf(9, 0)}), InputError);
    EXPECT_THROW(session_.change({growing_leaf(1, 50), growing_leaf(1, 60)}), InputError);
    EXPECT_THROW(session_.remove(std::array<std::int64_t, 2>{1, 9}), InputError);
    EXPECT_THROW(session_.remove(std::array<std::int64_t, 2>{1, 1}), InputError);
    EXPECT_THROW(session_.add({growing_leaf(3, 0), growing_leaf(2, 0)}), InputError);
    EXPECT_THROW(session_.add({growing_leaf(3, 0), growing_leaf(3, 0)}), InputError);
    EXPECT_EQ(session_.size(), 2U);
    EXPECT_TRUE(have_same_bits(run(), run_alone(before)));
    session_.change({growing_leaf(2, 30), growing_leaf(1, 20)});
    EXPECT_TRUE(have_same_bits(run(), run_alone({growing_leaf(1, 20), growing_leaf(2, 30)})));
}

TEST_F(GrowthSessionTest, ReportsAllErrorsOfAListAtOnce) {
    session_.add(growing_leaf(1, 0));
    try {
        session_.remove(std::array<std::int64_t, 4>{5, 1, 6, 1});
        FAIL() << "organs were removed that are not there";
    } catch (const InputError& error) {
        EXPECT_EQ(error.faults().size(), 3U);
    }
}

TEST(GrowthSession, KeepsIdsApartFromThoseOfItsFrame) {
    SceneBuilder frame = growth_frame();
    frame.add_organ(growing_leaf(5, 0));
    OrganSpec unnumbered = growing_leaf(0, 40);
    unnumbered.id.reset();
    frame.add_organ(unnumbered);
    EXPECT_EQ(frame.organ_ids(), (std::vector<std::int64_t>{5, 6}));
    GrowthSession session(frame);
    EXPECT_EQ(session.add(unnumbered), 7);
    EXPECT_THROW(session.add(growing_leaf(5, 0)), InputError);
    EXPECT_THROW(session.add(growing_leaf(6, 0)), InputError);
    EXPECT_THROW(session.change(growing_leaf(5, 1)), InputError);
    EXPECT_THROW(session.remove(6), InputError);
    EXPECT_FALSE(session.has(5));
    EXPECT_EQ(session.size(), 1U);
    EXPECT_EQ(session.scene()->organs().size(), 4U);

    SceneBuilder other = growth_frame();
    other.add_organ(growing_leaf(7, 0));
    EXPECT_THROW(session.set_frame(other), InputError);
    EXPECT_EQ(session.scene()->organs().front().id, 5);
    other = growth_frame();
    other.add_organ(growing_leaf(20, 0));
    session.set_frame(other);
    EXPECT_EQ(session.add(growing_leaf(5, 0)), 5);
    EXPECT_EQ(session.add(unnumbered), 21);
}

TEST_F(GrowthSessionTest, WarnsOfWhatLintFinds) {
    session_.add(growing_leaf(1, 0));
    EXPECT_TRUE(session_.warnings().empty());
    OrganSpec twin = growing_leaf(1, 0);
    twin.id = 2;
    session_.add(twin);
    const std::vector<Warning> expected = lint(*session_.scene());
    ASSERT_EQ(expected.size(), 1U);
    EXPECT_EQ(session_.warnings().front().text, expected.front().text);
    session_.remove(2);
    EXPECT_TRUE(session_.warnings().empty());
    EXPECT_EQ(
        session_.scene_builds(), 3U);  // warnings() builds the scene of the step, run() builds none
    static_cast<void>(run());
    EXPECT_EQ(session_.scene_builds(), 3U);
}

}  // namespace
}  // namespace quasimc::test

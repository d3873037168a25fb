// What the interface promises, for every row of the catalogue.

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "base/angles.h"
#include "run/simulator.h"
#include "solvers/catalogue.h"
#include "statistical/scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

class EverySolver : public ::testing::TestWithParam<std::string> {
  protected:
    [[nodiscard]] const SolverEntry& solver() const {
        const auto all = solver_catalogue();
        return *std::find_if(
            all.begin(), all.end(), [&](const SolverEntry& e) { return e.name == GetParam(); });
    }
    [[nodiscard]] RunSpec spec(std::uint64_t paths) const {
        return spec_of(solver().method, paths);
    }
};

INSTANTIATE_TEST_SUITE_P(
    Catalogue,
    EverySolver,
    ::testing::ValuesIn([] {
        std::vector<std::string> names;
        for (const SolverEntry& solver : solver_catalogue()) {
            names.emplace_back(solver.name);
        }
        return names;
    }()),
    [](const auto& param) { return param.param; });

/// Leaves that scatter most of the light.
Scene leaves() {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .4, .4));
    builder.add_organ(organ("leaves", "leaf", random_leaves(30, .4, 1, 3)));
    return std::move(builder).build();
}

/// Dark leaves, and a net, a sensor and a white material that nothing is made of.
Scene leaves_with_unused_materials() {
    SceneBuilder builder = make_builder();
    builder.add_material(net("net", {.9}));
    builder.add_material(sensor("sensor"));
    builder.add_material(diffuse("white", .6, .35));
    builder.add_material(diffuse("leaf", .1, .1));
    builder.add_organ(organ("leaves", "leaf", random_leaves(30, .4, 1, 3)));
    return std::move(builder).build();
}

Scene dark_leaves() {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .1, .1));
    builder.add_organ(organ("leaves", "leaf", random_leaves(30, .4, 1, 3)));
    return std::move(builder).build();
}

// Dark leaves among white materials: what the others scatter decides how densely is sampled.
TEST_P(EverySolver, KnowsNothingOfMaterialsThatNobodyUses) {
    const Sources sources{sun(30, {1}), sky({1})};
    const Result with = run(leaves_with_unused_materials(), sources, spec(1024));
    const Result without = run(dark_leaves(), sources, spec(1024));
    for (std::size_t q = 0; q < kQuantities; ++q) {
        const auto quantity = static_cast<Quantity>(q);
        EXPECT_EQ(with.at(0, quantity, 0).mean, without.at(0, quantity, 0).mean) << q;
        EXPECT_EQ(with.at(0, quantity, 0).ci95_high, without.at(0, quantity, 0).ci95_high) << q;
    }
    EXPECT_EQ(with.rays, without.rays);
}

TEST_P(EverySolver, HasARowOfItsOwn) {
    EXPECT_FALSE(solver().summary.empty());
    EXPECT_EQ(find_solver(solver().method), &solver());
    EXPECT_EQ(find_solver(Method::automatic), nullptr);
}

// All that falls on a black plate under the sun comes straight from there.
TEST_P(EverySolver, LightsAPlateByTheSun) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("plate", "black", floor_of(0, 2, 0, 1, 0)));
    const Result result = run(std::move(builder).build(), {sun(60, {3})}, spec(4096));
    const double expected = 3 * std::cos(60 * kRadians) * 2;
    EXPECT_TRUE(agrees(
        measured(result.at(0, Quantity::absorbed_flux, 0), kReplicates), expected, .02 * expected));
}

TEST_P(EverySolver, AgreesWithLightTracing) {
    const Scene scene = leaves();
    const Result own = run(scene, {sun(30, {1}), sky({1})}, spec(1 << 15));
    RunSpec plain_spec = spec_of(Method::light_tracing, 1 << 15);
    plain_spec.seed = 2;  // independent of the first
    const Result plain = run(scene, {sun(30, {1}), sky({1})}, plain_spec);
    for (const Quantity q : {Quantity::incident_direct, Quantity::incident_scattered}) {
        const Measured expected = measured(plain.at(0, q, 0), kReplicates);
        EXPECT_TRUE(agrees(measured(own.at(0, q, 0), kReplicates), expected, .05 * expected.mean));
    }
}

TEST_P(EverySolver, AddsTheSameSumsInAnyNumberOfThreads) {
    const Scene scene = leaves();
    const Sources sources{sun(30, {1}), sky({1})};
    RunSpec few = spec(1024);
    few.replicates = 3;
    few.threads = 1;
    const Sums one = Simulator().sums(scene, sources, few, 0);
    EXPECT_EQ(one.paths(), 1024U);
    EXPECT_GT(one->samples, 0U);
    // As many as replicates; fewer than one for each; several for each.
    for (const unsigned threads : {3U, 2U, 8U}) {
        few.threads = threads;
        EXPECT_EQ(one, Simulator().sums(scene, sources, few, 0)) << threads;
    }
    few.seed = 2;
    EXPECT_NE(one->replicates, Simulator().sums(scene, sources, few, 0)->replicates);
}

}  // namespace
}  // namespace quasimc::test

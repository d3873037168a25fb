// Rationale: published plants have duplicate leaves, internodes with common caps, leaves that lie
// flat on the ground. Every method must then give the same result, and no light may be counted
// twice.
// Expected behaviour: of coincident surfaces the first receives all light, on both sides
// (docs/develop/decisions/coplanar-overlaps.md), as in the scene where the others are cut away.

#include <cmath>
#include <numbers>

#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

constexpr double kReflectance = .3, kTransmittance = .2;
constexpr double kTakes = 1 - kReflectance - kTransmittance;

SceneBuilder make_matt_builder() {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", kReflectance, kTransmittance));
    builder.add_material(diffuse("soil", .2, 0));
    builder.add_material(diffuse("black", 0, 0));
    return builder;
}

/// Light absorbed from both sides, relative to a single plate under the sun.
double absorbed(const Result& result, std::size_t organ) {
    return result.at(organ, Quantity::absorbed_flux, 0).mean;
}

class Coincident : public BothWays {
  protected:
    /// Light is counted once: absorbed and escaped light sum to the emitted light.
    static void expect_closed(const Result& result) {
        const BandBudget& budget = result.budget[0];
        EXPECT_LT(budget.closure_error, 1e-9);
        EXPECT_GE(budget.escaped.mean, -6 * budget.escaped.standard_error - 1e-9);
        EXPECT_LE(
            budget.absorbed_by_organs.mean + budget.absorbed_by_ground.mean,
            budget.emitted.mean + 6 * budget.absorbed_by_organs.standard_error + 1e-9);
    }
    /// Compares all organs of a scene with those of another, of which `b` has the first few only;
    /// the others are covered.
    void expect_covers(const Scene& with, const Scene& without, const Sources& sources) const {
        const Result a = trace(with, sources, 1 << 14);
        const Result b = trace(without, sources, 1 << 14);
        expect_closed(a);
        for (std::size_t i = 0; i < a.organs(); ++i) {
            const Estimate& here = a.at(i, Quantity::absorbed_flux, 0);
            if (i >= b.organs()) {
                EXPECT_EQ(here.mean, 0) << i;
                continue;
            }
            const Estimate& there = b.at(i, Quantity::absorbed_flux, 0);
            EXPECT_TRUE(agrees(
                measured(here, kReplicates), measured(there, kReplicates), .05 * there.mean));
        }
    }
};

QUASIMC_BOTH_WAYS(Coincident);

/// Two leaves over each other and a third in between, some duplicated.
Scene make_leaves(bool twice) {
    SceneBuilder builder = make_matt_builder();
    const std::vector<Triangle> low = floor_of(0, 1, 0, 1, 0);
    const std::vector<Triangle> high = floor_of(.3, 1.3, .2, 1.2, .7);
    builder.add_organ(organ("low", "leaf", low));
    builder.add_organ(organ("high", "leaf", high));
    if (twice) {
        builder.add_organ(organ("low again", "leaf", low));
        builder.add_organ(organ("high, other side up", "black", turned_over(high)));
        std::vector<Triangle> turned;
        for (const auto& [p, q, r] : low) {
            turned.push_back({q, r, p});
        }
        builder.add_organ(organ("low, other corners", "black", turned));
    }
    return std::move(builder).build();
}

TEST_P(Coincident, DuplicatesAreCoveredByTheFirst) {
    expect_covers(make_leaves(true), make_leaves(false), {sun(30, {1}), sky({.7})});
}

TEST_P(Coincident, DuplicatesOfTiltedTrianglesAreCoveredWhateverTheRounding) {
    const auto make = [](bool twice) {
        SceneBuilder builder = make_matt_builder();
        const Triangle tilted{Vec3{.1, .2, .3}, {1.17, .31, .77}, {.23, 1.41, .59}};
        builder.add_organ(organ("first", "leaf", {tilted}));
        if (twice) {
            Triangle near = tilted;
            for (Vec3& corner : near) {
                corner += Vec3{3e-8, -2e-8, 4e-8};
            }
            builder.add_organ(organ("second", "black", {near}));
        }
        return std::move(builder).build();
    };
    expect_covers(make(true), make(false), {sun(20, {1}), sky({1})});
}

TEST_P(Coincident, ALeafOnTheGroundCoversIt) {
    SceneBuilder builder = make_matt_builder();
    builder.add_organ(organ("leaf", "leaf", floor_of(-.5, .5, -.5, .5, 0)));
    GroundSpec soil = ground("soil");
    soil.extent = {{-1, -1, 1, 1}};
    builder.set_ground(soil);
    const Result result = trace(std::move(builder).build(), {sun(0, {1})}, 1 << 14);
    expect_closed(result);
    // Light transmitted by the leaf leaves downwards from the plane that it shares with the ground.
    EXPECT_TRUE(
        holds({"leaf on the ground", kTakes, .01}, result.at(0, Quantity::absorbed_flux, 0)));
    EXPECT_TRUE(holds({"ground about it", .8 * 3, .02}, result.at(1, Quantity::absorbed_flux, 0)));
}

TEST_P(Coincident, PartsThatOverlapBelongToTheFirst) {
    SceneBuilder builder = make_matt_builder();
    builder.add_organ(organ("first", "leaf", floor_of(0, 1, 0, 1, 0)));
    builder.add_organ(organ("second", "black", turned_over(floor_of(.6, 1.6, -.3, .9, 0))));
    builder.add_organ(organ("third", "black", floor_of(.8, 2, .5, 2, 0)));
    const Scene scene = std::move(builder).build();
    const double second = 1.2 - .4 * .9;
    const double third = 1.2 * 1.5 - (.2 * .5 + .8 * .4 - .2 * .4);
    const Result result = trace(scene, {sun(0, {1})}, 1 << 14);
    expect_closed(result);
    EXPECT_TRUE(holds({"first", kTakes, .01}, result.at(0, Quantity::absorbed_flux, 0)));
    EXPECT_TRUE(holds({"second", second, .01}, result.at(1, Quantity::absorbed_flux, 0)));
    EXPECT_TRUE(holds({"third", third, .02}, result.at(2, Quantity::absorbed_flux, 0)));
    // Densities are per area of the whole organ.
    EXPECT_NEAR(
        result.at(1, Quantity::absorbed_flux_density, 0).mean, absorbed(result, 1) / 1.2, 1e-9);
    EXPECT_NEAR(scene.organs()[1].covered_area, .4 * .9, 1e-6);
}

TEST_P(Coincident, AFloorThatLapsOverItselfThroughTheBorderTakesTheLightOnce) {
    SceneBuilder builder = make_matt_builder();
    builder.add_organ(organ("floor", "leaf", floor_of(-.2, 1.2, 0, 1, 0)));
    builder.set_cell({.along_x = true, .along_y = true, .size_x = 1, .size_y = 1});
    for (const Sources& sources : {Sources{sun(35, {1})}, Sources{sky({1})}}) {
        const Scene scene = SceneBuilder(builder).build();
        const Result result = trace(scene, sources, 1 << 13);
        expect_closed(result);
        const double light = result.budget[0].emitted.mean;
        EXPECT_TRUE(holds(
            {"floor over a border", kTakes * light, .02 * light},
            result.at(0, Quantity::absorbed_flux, 0)));
        EXPECT_TRUE(holds(
            {"what it scatters", (1 - kTakes) * light, .02 * light}, result.budget[0].escaped));
    }
}

TEST_P(Coincident, WallsOnBothBordersOfTheCellAreOne) {
    const auto make = [](bool twice) {
        SceneBuilder builder = make_matt_builder();
        const auto wall_at = [](double x) {
            const Vec3 a{x, 0, 0}, b{x, 1, 0}, c{x, 1, .5}, d{x, 0, .5};
            return std::vector<Triangle>{{a, b, c}, {a, c, d}};
        };
        builder.add_organ(organ("floor", "leaf", floor_of(0, 1, 0, 1, -.1)));
        builder.add_organ(organ("wall", "leaf", wall_at(0)));
        if (twice) {
            builder.add_organ(organ("the same", "black", wall_at(1)));
        }
        builder.set_cell({.along_x = true, .along_y = true, .size_x = 1, .size_y = 1});
        return std::move(builder).build();
    };
    expect_covers(make(true), make(false), {sun(40, {1}), sky({1})});
}

TEST(CoincidentEngines, BruteForceSaysWhatEmbreeSays) {
    for (const Method from : {Method::light_tracing, Method::from_organs}) {
        RunSpec spec = spec_of(from, 1 << 11);
        const Scene scene = make_leaves(true);
        const Sources sources{sun(30, {1}), sky({.7})};
        const Result embree = run(scene, sources, spec);
        spec.accelerator = Accelerator::brute_force;
        const Result brute = run(scene, sources, spec);
        for (std::size_t i = 0; i < embree.organs(); ++i) {
            EXPECT_NEAR(absorbed(embree, i), absorbed(brute, i), 1e-3 * absorbed(embree, 0));
        }
    }
}

}  // namespace
}  // namespace quasimc::test

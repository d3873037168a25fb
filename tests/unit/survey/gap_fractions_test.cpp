#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "base/angles.h"
#include "quasimc/gap_fraction.h"
#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

GapFractionSpec looking_from(std::vector<Vec3> positions) {
    GapFractionSpec spec;
    spec.positions = std::move(positions);
    spec.threads = 1;
    return spec;
}

/// A square of 1 x 1 at height 1 over the origin.
Scene roof(const std::string& material = "leaf") {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .1, .1));
    builder.add_material(sensor("sensor"));
    builder.add_organ(
        labelled(organ("roof", material, floor_of(-.5, .5, -.5, .5, 1)), {{"kind", "leaf"}}));
    builder.set_ground({.material = "leaf", .extent = {{-2, -2, 2, 2}}});
    return std::move(builder).build();
}

/// Leaves at random in a cell of 1 x 1 x 1, their normals spread over the sphere: squares of that
/// total area.
Scene random_stand(double area, std::size_t count) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    const double side = std::sqrt(area / static_cast<double>(count));
    std::vector<Triangle> leaves;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 middle{uniform(random), uniform(random), uniform(random)};
        const double z = 2 * uniform(random) - 1, around = 2 * std::numbers::pi * uniform(random);
        const double flat = std::sqrt(1 - z * z);
        const Vec3 normal{flat * std::cos(around), flat * std::sin(around), z};
        const Vec3 u = .5 * side * normalized(cross(normal, Vec3{.3, .4, .5}));
        const Vec3 v = cross(normal, u);
        leaves.push_back({middle - u - v, middle + u - v, middle + u + v});
        leaves.push_back({middle - u - v, middle + u + v, middle - u + v});
    }
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .1, .1));
    builder.add_organ(organ("leaves", "leaf", leaves));
    builder.set_cell({.along_x = true, .along_y = true, .size_x = 1, .size_y = 1});
    return std::move(builder).build();
}

/// The solid angle of a rectangle a x b seen from below a corner at distance 1.
double corner_solid_angle(double a, double b) {
    return std::asin(a * b / std::sqrt((1 + a * a) * (1 + b * b)));
}

TEST(GapFractions, OfARoofAreOneLessItsSolidAngle) {
    GapFractionSpec spec = looking_from({{0, 0, 0}, {.5, .5, 0}});
    spec.rings_deg = {0, 90};
    spec.azimuths = 4;
    const GapFractions found = gap_fractions(roof(), spec);
    const double above = 4 * corner_solid_angle(.5, .5) / (2 * std::numbers::pi);
    const double corner = corner_solid_angle(1, 1) / (2 * std::numbers::pi);
    for (std::size_t sector = 0; sector < 4; ++sector) {
        const Estimate& gap = found.gap(0, 0, sector);
        EXPECT_NEAR(gap.mean, 1 - above, 5 * gap.standard_error);
        EXPECT_LT(gap.standard_error, 2e-3);
    }
    // From below the north-eastern corner the roof lies in the sector from south to west.
    EXPECT_NEAR(found.gap(1, 0, 2).mean, 1 - 4 * corner, 5 * found.gap(1, 0, 2).standard_error);
    for (const std::size_t open : {0U, 1U, 3U}) {
        EXPECT_EQ(found.gap(1, 0, open).mean, 1);
    }
    EXPECT_NEAR(found.by_position[0].gap[0].mean, 1 - above, 5e-3);
    EXPECT_NEAR(
        found.all.gap[0].mean,
        (found.by_position[0].gap[0].mean + found.by_position[1].gap[0].mean) / 2, 1e-12);
}

TEST(GapFractions, OfARandomStandFollowBeersLaw) {
    constexpr double kArea = 2;
    const Scene stand = random_stand(kArea, 20000);
    std::vector<Vec3> positions;
    for (int i = 0; i < 36; ++i) {
        positions.push_back({(i % 6 + .5) / 6, (i / 6 + .5) / 6, -.01});
    }
    GapFractionSpec spec = looking_from(positions);
    spec.rings_deg = {0, 10, 20, 30, 40, 50, 60, 70, 80, 85};
    spec.rays = 1024;
    const GapFractions found = gap_fractions(stand, spec);
    for (std::size_t ring = 0; ring < spec.rings(); ++ring) {
        const double high = std::cos(spec.rings_deg[ring] * kRadians);
        const double low = std::cos(spec.rings_deg[ring + 1] * kRadians);
        double expected = 0;
        constexpr int kSteps = 1000;
        for (int i = 0; i < kSteps; ++i) {
            const double cosine = low + (high - low) * (i + .5) / kSteps;
            expected += std::exp(-kArea / 2 / cosine) / kSteps;
        }
        // 36 views of one stand of 20,000 leaves: they differ by some percent.
        EXPECT_NEAR(found.all.gap[ring].mean, expected, .04 * expected) << ring;
    }
    EXPECT_NEAR(found.all.effective_plant_area_index.mean, kArea, .04 * kArea);
}

TEST(GapFractions, AreNarrowedByTheCondition) {
    GapFractionSpec spec = looking_from({{0, 0, 0}});
    spec.where = "kind == 'stem'";
    EXPECT_TRUE(std::isnan(gap_fractions(roof(), spec).all.clumping[0].mean));
    spec.where = "kind == 'leaf'";
    EXPECT_EQ(gap_fractions(roof(), spec).all.gap[0].mean, 0);
}

TEST(GapFractions, AreThoseWithoutSensors) {
    const GapFractions found = gap_fractions(roof("sensor"), looking_from({{0, 0, 0}}));
    for (const Estimate& gap : found.gaps) {
        EXPECT_EQ(gap.mean, 1);
    }
}

TEST(GapFractions, AreTheSameOnAnyNumberOfThreads) {
    GapFractionSpec spec = looking_from({{0, 0, 0}, {.4, .1, .2}});
    const GapFractions one = gap_fractions(roof(), spec);
    spec.threads = 3;
    const GapFractions three = gap_fractions(roof(), spec);
    for (std::size_t i = 0; i < one.gaps.size(); ++i) {
        EXPECT_EQ(one.gaps[i].mean, three.gaps[i].mean);
        EXPECT_EQ(one.gaps[i].ci95_high, three.gaps[i].ci95_high);
    }
    EXPECT_EQ(one.all.plant_area_index.standard_error, three.all.plant_area_index.standard_error);
}

TEST(GapFractions, HaveIntervalsThatHold) {
    GapFractionSpec spec = looking_from({{.1, .05, 0}});
    spec.rings_deg = {20, 50};
    spec.rays = 128;
    GapFractionSpec fine = spec;
    fine.rays = 1U << 20U;
    const GapFractions truth = gap_fractions(roof(), fine);
    int gaps = 0, indices = 0;
    constexpr int kRuns = 400;
    for (int i = 0; i < kRuns; ++i) {
        spec.seed = static_cast<std::uint64_t>(i) + 2;
        const GapFractions found = gap_fractions(roof(), spec);
        const auto holds = [](const Estimate& e, double x) {
            return e.ci95_low <= x && x <= e.ci95_high;
        };
        gaps += holds(found.all.gap[0], truth.all.gap[0].mean) ? 1 : 0;
        indices +=
            holds(found.all.effective_plant_area_index, truth.all.effective_plant_area_index.mean)
                ? 1
                : 0;
    }
    // 95 % of 400 within 4 binomial standard deviations.
    EXPECT_NEAR(gaps, 380, 18);
    EXPECT_NEAR(indices, 380, 18);
}

TEST(GapFractions, ReportAllFaultsAtOnce) {
    GapFractionSpec spec = looking_from({{0, 0, -.5}, {0, 0, .1}});
    spec.rings_deg = {30, 20};
    spec.azimuths = 0;
    spec.where = "knd == 'leaf'";
    Faults faults;
    check_gap_fraction(roof(), spec, faults);
    std::string text;
    for (const Fault& fault : faults.all()) {
        text += fault.text() + "\n";
    }
    EXPECT_NE(text.find("rings_deg are no bounds of rings"), std::string::npos) << text;
    EXPECT_NE(text.find("azimuths is 0"), std::string::npos) << text;
    EXPECT_NE(text.find("unknown label 'knd'"), std::string::npos) << text;
    EXPECT_NE(text.find("1 of 2 positions below the ground (first: position 1)"), std::string::npos)
        << text;
    EXPECT_THROW(static_cast<void>(gap_fractions(roof(), spec)), InputError);
    EXPECT_THROW(
        static_cast<void>(gap_fractions(roof(), looking_from({{1e25, 0, 0}}))), InputError);
}

}  // namespace
}  // namespace quasimc::test

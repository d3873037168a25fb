// Rationale: rays are traced in single precision, which moves corners by some 1e-8 of the scene.
// This changes the area of a needle a millionth of the scene wide by percents, equally in all
// replicates: the standard error does not include it.
// Expected behaviour: the light on a needle is that of its exact area.

#include <array>
#include <cmath>

#include "quasimc/mesh.h"
#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

/// A needle of width `w`, its long side along no axis.
Triangle needle(const Vec3& position, double w) {
    const Vec3 along = .3 * normalized(Vec3{.61, .48, .33});
    const Vec3 across = w * normalized(cross(along, Vec3{.13, -.29, .87}));
    return {position, position + along, position + .55 * along + across};
}

/// Needles of several widths over a black ground of 2 x 2.
constexpr std::array<double, 4> kWidths{2e-6, 5e-6, 2e-5, 1e-3};

Vec3 position_of_needle(std::size_t i) {
    return {.313 + .0571 * static_cast<double>(i), .217 - .31 * static_cast<double>(i), .413};
}

Scene make_needles(double reflectance) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("needle", reflectance, 0));
    builder.add_material(diffuse("black", 0, 0));
    for (std::size_t i = 0; i < kWidths.size(); ++i) {
        builder.add_organ(organ("", "needle", {needle(position_of_needle(i), kWidths[i])}));
    }
    builder.add_organ(organ("far", "black", floor_of(-1, 1, -1, 1, 0)));
    return std::move(builder).build();
}

double received(const Result& result, std::size_t organ) {
    return result.at(organ, Quantity::incident_direct, 0).mean;
}

TEST(Needles, AreLitAsGivenByTheSun) {
    const auto light = sun(25, {1});
    const Vec3 direction{
        std::sin(25 * 3.14159265358979 / 180), 0, -std::cos(25 * 3.14159265358979 / 180)};
    const Scene scene = make_needles(0);
    ASSERT_FALSE(lint(scene).empty());  // the first is off by more than 5 %
    const Result lines = run(scene, {light}, spec_of(Method::first_hits, 1 << 19));
    const Result points = run(scene, {light}, spec_of(Method::from_organs, 1 << 12));
    for (std::size_t i = 0; i < kWidths.size(); ++i) {
        const Vec3 n = normalized(area_vector(needle(position_of_needle(i), kWidths[i])));
        const double expected = std::abs(dot(n, direction));
        const Estimate& lit = lines.at(i, Quantity::incident_direct, 0);
        EXPECT_TRUE(agrees(measured(lit, kReplicates), expected, .02 * expected))
            << kWidths[i] << ": " << lit.mean << " for " << expected;
        EXPECT_NEAR(received(points, i), expected, 1e-3 * expected) << kWidths[i];
    }
}

TEST(Needles, AreLitAsGivenByTheSky) {
    const Result result = run(make_needles(0), {sky({1})}, spec_of(Method::from_organs, 1 << 14));
    for (std::size_t i = 0; i < kWidths.size(); ++i) {
        const Estimate& lit = result.at(i, Quantity::incident_direct, 0);
        EXPECT_TRUE(agrees(measured(lit, kReplicates), 1, .02)) << kWidths[i];
    }
}

/// Where paths hit needles, the difference between the light stopped by rounded and by exact ones
/// passes.
TEST(Needles, KeepTheEnergyBalanced) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("needle", .4, .3));
    std::vector<Triangle> needles;
    for (int i = 0; i < 2000; ++i) {
        const double x = -1 + 1e-3 * i;
        needles.push_back({Vec3{x, -1, .3}, {x + 2e-5, 1, .3 + 1e-5}, {x + 1e-5, 0, .3 + 3e-5}});
    }
    builder.add_organ(organ("needles", "needle", needles));
    builder.add_organ(organ("floor", "needle", floor_of(-1, 1, -1, 1, 0)));
    const Scene scene = std::move(builder).build();
    for (const Method from : {Method::light_tracing, Method::first_hits}) {
        const Result result = run(scene, {sun(25, {1}), sky({1})}, spec_of(from, 1 << 10));
        EXPECT_LT(result.budget[0].closure_error, 1e-9);
        EXPECT_GT(received(result, 0), 0);
    }
}

}  // namespace
}  // namespace quasimc::test

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "geometry/shapes/shapes.h"
#include "light/models/source.h"
#include "support/statistics.h"
#include "unit/samplers/sampler_testing.h"

namespace quasimc::test {
namespace {

constexpr Cell kOpen{};
/// The direction of a light from the side.
Vec3 slanted() {
    return normalized({.3, -.2, -.8});
}

/// The aperture of some triangles, with the mesh that it refers to.
struct MeshAperture {
    LocalMesh mesh;
    SceneProjection projection;

    explicit MeshAperture(
        const std::vector<Triangle>& triangles,
        const Cell& cell = kOpen,
        StartArea shape = StartArea::silhouette)
        : mesh(make_local_mesh(triangles)), projection(mesh, cell, shape) {}
    MeshAperture(const MeshAperture&) = delete;
    MeshAperture& operator=(const MeshAperture&) = delete;
};

/// A floor of 2 x 1 at height 0.
std::vector<Triangle> make_floor() {
    return make_parallelogram({0, 0, 0}, {2, 0, 0}, {0, 1, 0});
}

/// Flux into the scene in square units of the world, 0 if there is none.
double world_flux(const Source& source, const MeshAperture& opening) {
    const auto sampler = model_of(source).make_sampler_in(opening.projection);
    return sampler ? sampler->flux() * opening.projection.world_area() : 0;
}

/// A window may be larger than the silhouette by a tenth, if its map is simpler for it.
TEST(Directional, SendsHardlyMoreLightThanTheSilhouetteCatches) {
    const auto source = make_directional_source("sun", slanted(), {1});
    const double floor = world_flux(*source, MeshAperture(make_floor()));
    EXPECT_GE(floor, -2 * slanted().z);
    EXPECT_LE(floor, -2 * slanted().z / .9);
    const double sphere = world_flux(*source, MeshAperture(make_sphere({5, 6, 7}, 2, 5)));
    EXPECT_NEAR(sphere, 4 * std::numbers::pi, .02);
}

TEST(Directional, SendsTheLightOfTheDiscAcrossTheBoundingSphereIfAsked) {
    const auto source = make_directional_source("sun", slanted(), {1});
    const MeshAperture opening(make_floor(), kOpen, StartArea::bounding_sphere);
    EXPECT_NEAR(world_flux(*source, opening), std::numbers::pi * 1.25, 2e-5);
}

TEST(Directional, SendsTheLightOfOneCellIntoAPeriodicScene) {
    const Cell cell{.along_x = true, .along_y = true, .size_x = 3, .size_y = 5};
    const auto source = make_directional_source("sun", slanted(), {1});
    EXPECT_NEAR(world_flux(*source, MeshAperture(make_floor(), cell)), -15 * slanted().z, 1e-9);
}

TEST(Directional, SendsNothingIntoAFloorSeenEdgeOn) {
    const Cell cell{.along_x = true, .along_y = true, .size_x = 3, .size_y = 5};
    const auto source = make_directional_source("horizontal", {1, 0, 0}, {1});
    EXPECT_EQ(model_of(*source).make_sampler_in(MeshAperture(make_floor()).projection), nullptr);
    EXPECT_EQ(
        model_of(*source).make_sampler_in(MeshAperture(make_floor(), cell).projection), nullptr);
}

TEST(Directional, StartsAllPathsAlikeOutsideTheScene) {
    const auto source = make_directional_source("sun", 3.0 * slanted(), {1});
    const MeshAperture opening(make_floor());
    const auto sampler = model_of(*source).make_sampler_in(opening.projection);
    ASSERT_TRUE(sampler->beam_direction());
    EXPECT_LT(length(*sampler->beam_direction() - slanted()), 1e-15);
    std::mt19937_64 bits(1);
    std::uniform_real_distribution<double> uniform;
    for (int i = 0; i < 1000; ++i) {
        const Emission start = sampler->emit({uniform(bits), uniform(bits), .5, .5});
        EXPECT_EQ(start.weight, 1);
        EXPECT_EQ(start.direction, *sampler->beam_direction());
        EXPECT_GT(start.origin.z, 0) << "the floor is at 0";
    }
}

TEST(Directional, FindsTheOriginsOfManyPathsAtOnce) {
    const auto source = make_directional_source("sun", slanted(), {1});
    for (const StartArea shape : {StartArea::silhouette, StartArea::bounding_sphere}) {
        const MeshAperture opening(make_floor(), kOpen, shape);
        const auto sampler = model_of(*source).make_sampler_in(opening.projection);
        constexpr std::array<double, 5> kU0{0, .1, .5, .7, .999999};
        constexpr std::array<double, 5> kU1{.9, 0, .5, .999999, .2};
        std::array<Vec3, 5> origins;
        sampler->beam_origins(kU0, kU1, origins);
        for (std::size_t i = 0; i < origins.size(); ++i) {
            EXPECT_EQ(origins[i], sampler->emit({kU0[i], kU1[i], 0, 0}).origin);
        }
    }
}

/// Followed down to the floor, the starts fall on it evenly.
TEST(Directional, SpreadsItsPathsEvenlyOverTheScene) {
    const auto source = make_directional_source("sun", slanted(), {1});
    const MeshAperture opening(make_floor());
    const auto sampler = model_of(*source).make_sampler_in(opening.projection);
    std::mt19937_64 bits(2);
    std::uniform_real_distribution<double> uniform;
    std::vector<double> x;
    std::vector<double> y;
    constexpr int kStarts = 40000;
    for (int i = 0; i < kStarts; ++i) {
        const Emission start = sampler->emit({uniform(bits), uniform(bits), 0, 0});
        const Vec3 from = opening.mesh.origin + start.origin / opening.mesh.scale;
        const Vec3 point = from - (from.z / start.direction.z) * start.direction;
        if (point.x >= 0 && point.x < 2 && point.y >= 0 && point.y < 1) {
            x.push_back(point.x / 2);
            y.push_back(point.y);
        }
    }
    EXPECT_GE(x.size(), kStarts * 9U / 10);
    EXPECT_TRUE(equally_likely(counts(x, y, 16, 16), kLevel));
}

TEST(Directional, IlluminatesEveryPointFromOneDirection) {
    const auto source = make_directional_source("sun", slanted(), {2, 3});
    for (const double u : {0.0, .3, .999}) {
        const Illumination seen = model_of(*source).illuminate({u, 1, -u}, u, 1 - u);
        EXPECT_LT(length(seen.to_light + slanted()), 1e-15);
        EXPECT_EQ(seen.weight, 1);
        EXPECT_TRUE(std::isinf(seen.distance));
    }
    EXPECT_EQ(source->traits(), kBeamTraits);
    EXPECT_EQ(model_of(*source).radiance(-slanted()), 0);
    EXPECT_NEAR(source->horizontal_irradiance(), -slanted().z, 1e-15);
    EXPECT_EQ(source->spectrum()[1], 3);
}

TEST(Directional, FromBelowTheHorizonBringsNothingToTheUpperSideOfTheHorizontal) {
    const auto source = make_directional_source("reflected", {0, .6, .8}, {1});
    EXPECT_EQ(source->horizontal_irradiance(), 0);
    const MeshAperture opening(make_floor());
    EXPECT_NEAR(world_flux(*source, opening), 2 * .8, 2e-5);
    EXPECT_LT(
        model_of(*source).make_sampler_in(opening.projection)->emit({.5, .5, 0, 0}).origin.z, 0);
}

}  // namespace
}  // namespace quasimc::test

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

using std::numbers::pi;

/// The corners of a box of 4 x 2 x 1.
std::vector<Triangle> make_box() {
    return {{Vec3{0, 0, 0}, Vec3{4, 2, 0}, Vec3{4, 0, 1}}};
}

/// Mean of f over an even grid of the unit square.
template <typename Function>
double mean_over_square(const Function& f) {
    constexpr int kSide = 400;
    double sum = 0;
    for (int i = 0; i < kSide; ++i) {
        for (int j = 0; j < kSide; ++j) {
            sum += f((i + .5) / kSide, (j + .5) / kSide);
        }
    }
    return sum / (kSide * kSide);
}

/// Integral over the upper hemisphere of a function of the direction towards the light.
template <typename Function>
double over_hemisphere(const Function& f) {
    return mean_over_square([&](double u, double v) {
        const double radius = std::sqrt(1 - u * u);
        return 2 * pi * f(Vec3{radius * std::cos(2 * pi * v), radius * std::sin(2 * pi * v), u});
    });
}

double world_flux(const Cell& cell) {
    const LocalMesh mesh = make_local_mesh(make_box());
    const SceneProjection projection(mesh, cell, StartArea::silhouette);
    return model_of(*make_uniform_sky("sky", {1})).make_sampler_in(projection)->flux() *
           projection.world_area();
}

TEST(UniformSky, SendsTheLightThatEntersTheBoxAroundTheScene) {
    // E through the top, E/2 through each side.
    EXPECT_NEAR(world_flux({}), 4 * 2 + .5 * 2 * (4 * 1 + 2 * 1), 1e-4);
    const LocalMesh mesh = make_local_mesh(make_box());
    const EntryBox box = SceneProjection(mesh, {}, StartArea::silhouette).entry_box();
    const auto sky = make_uniform_sky("sky", {1});
    const double integral = over_hemisphere(
        [&](const Vec3& d) { return model_of(*sky).radiance(d) * box.projected_area(d); });
    const SceneProjection projection(mesh, {}, StartArea::silhouette);
    EXPECT_NEAR(model_of(*sky).make_sampler_in(projection)->flux(), integral, 1e-4 * integral);
}

TEST(UniformSky, EntersAPeriodicSceneThroughItsOpenFacesOnly) {
    const Cell layer{.along_x = true, .along_y = true, .size_x = 3, .size_y = 5};
    EXPECT_NEAR(world_flux(layer), 15, 1e-4);
    const Cell row{.along_x = true, .size_x = 3};
    EXPECT_NEAR(world_flux(row), 3 * 2 + .5 * 2 * 3 * 1, 1e-4);
}

/// Where paths start on one face, and in which directions: coordinates in which both are uniform.
struct Face {
    std::vector<double> across, along;        // position
    std::vector<double> square_sine, around;  // direction about the face's normal
};

/// Many starts, by face: top, low x, high x, low y, high y.
std::array<Face, 5> draw_faces(int starts) {
    const LocalMesh mesh = make_local_mesh(make_box());
    const SceneProjection projection(mesh, {}, StartArea::silhouette);
    const Bounds& box = projection.entry_box().bounds;
    const auto sampler = model_of(*make_uniform_sky("sky", {1})).make_sampler_in(projection);
    std::array<Face, 5> faces;
    std::mt19937_64 bits(3);
    std::uniform_real_distribution<double> uniform;
    for (int i = 0; i < starts; ++i) {
        const Emission e =
            sampler->emit({uniform(bits), uniform(bits), uniform(bits), uniform(bits)});
        EXPECT_EQ(e.weight, 1);
        EXPECT_NEAR(length(e.direction), 1, 1e-14);
        EXPECT_LE(e.direction.z, 0) << "the sky is above";
        const Vec3 origin{
            (e.origin.x - box.low.x) / box.size().x, (e.origin.y - box.low.y) / box.size().y,
            (e.origin.z - box.low.z) / box.size().z};
        const Vec3& d = e.direction;
        const auto put = [&](Face& face, Vec3 p, Vec3 q, double turn) {
            // p.x, p.y on the face; q.z along the inward normal.
            face.across.push_back(p.x);
            face.along.push_back(p.y);
            face.square_sine.push_back(1 - q.z * q.z);
            const double angle = std::atan2(q.y, q.x) / turn;
            face.around.push_back(angle - std::floor(angle));
            EXPECT_GE(q.z, 0) << "inward";
        };
        if (e.origin.z == box.high.z) {
            put(faces[0], origin, {d.x, d.y, -d.z}, 2 * pi);
        } else if (e.origin.x == box.low.x || e.origin.x == box.high.x) {
            const bool low = e.origin.x == box.low.x;
            put(faces[low ? 1 : 2], {origin.y, origin.z, 0}, {d.y, -d.z, low ? d.x : -d.x}, pi);
        } else {
            const bool low = e.origin.y == box.low.y;
            EXPECT_TRUE(low || e.origin.y == box.high.y);
            put(faces[low ? 3 : 4], {origin.x, origin.z, 0}, {d.x, -d.z, low ? d.y : -d.y}, pi);
        }
    }
    return faces;
}

TEST(UniformSky, StartsPathsEvenlyOnEveryFaceByTheCosineLaw) {
    constexpr int kStarts = 200000;
    constexpr std::array<double, 5> kShares{8, 1, 1, 2, 2};  // of the flux, out of 14
    const std::array<Face, 5> faces = draw_faces(kStarts);
    const double level = sidak_level(kLevel, 15);
    for (std::size_t i = 0; i < faces.size(); ++i) {
        SCOPED_TRACE(i);
        const Face& face = faces[i];
        const double share = kShares[i] / 14;
        EXPECT_TRUE(agrees(
            measured_fraction(static_cast<double>(face.across.size()), kStarts, share), share, .01,
            level));
        EXPECT_TRUE(equally_likely(counts(face.across, face.along, 8, 8), level));
        EXPECT_TRUE(equally_likely(counts(face.square_sine, face.around, 8, 8), level));
    }
}

TEST(UniformSky, IlluminatesASurfaceOfAnySlope) {
    const auto sky = make_uniform_sky("sky", {1});
    for (const double slope : {0.0, 30.0, 60.0, 90.0, 120.0, 150.0, 180.0}) {
        const double angle = slope * pi / 180;
        const Vec3 n{std::sin(angle) * .6, std::sin(angle) * .8, std::cos(angle)};
        const double irradiance = mean_over_square([&](double u0, double u1) {
            const Illumination seen = model_of(*sky).illuminate({1, 2, 3}, u0, u1);
            return seen.weight * std::max(0.0, dot(seen.to_light, n));
        });
        EXPECT_NEAR(irradiance, (1 + std::cos(angle)) / 2, 1e-4) << slope;
    }
    EXPECT_EQ(sky->horizontal_irradiance(), 1);
}

/// What is drawn and what is seen are the same sky.
TEST(UniformSky, HasTheRadianceThatItIlluminatesWith) {
    const auto sky = make_uniform_sky("sky", {1});
    const auto view = [](const Vec3& d) { return std::exp(d.x) + 2 * d.y * d.y + d.x * d.z; };
    const double drawn = mean_over_square([&](double u0, double u1) {
        const Illumination seen = model_of(*sky).illuminate({}, u0, u1);
        EXPECT_NEAR(length(seen.to_light), 1, 1e-14);
        EXPECT_TRUE(std::isinf(seen.distance));
        return seen.weight * view(seen.to_light);
    });
    const double looked_at =
        over_hemisphere([&](const Vec3& d) { return model_of(*sky).radiance(d) * view(d); });
    EXPECT_NEAR(drawn, looked_at, 1e-6);
}

TEST(UniformSky, IsDarkBelowTheHorizon) {
    const auto sky = make_uniform_sky("sky", {1});
    EXPECT_EQ(model_of(*sky).radiance({.6, 0, -.8}), 0);
    EXPECT_DOUBLE_EQ(model_of(*sky).radiance({.6, 0, .8}), 1 / pi);
    EXPECT_EQ(sky->traits(), kSkyTraits);
}

void expect_density(const Cell& cell) {
    const LocalMesh mesh = make_local_mesh(make_box());
    const SceneProjection projection(mesh, cell, StartArea::silhouette);
    const auto sampler = model_of(*make_uniform_sky("sky", {1})).make_sampler_in(projection);
    EXPECT_NEAR(over_hemisphere([&](const Vec3& d) { return sampler->density(-d); }), 1, 1e-4);
    EXPECT_EQ(sampler->density({0, .6, .8}), 0);
    constexpr std::size_t kOctants = 4;
    constexpr int kDraws = 60000;
    std::array<double, 2 * kOctants> found{};
    std::array<double, 2 * kOctants> expected{};
    const auto bin_of = [](const Vec3& d) {
        return (d.x > 0 ? 1U : 0U) + (d.y > 0 ? 2U : 0U) + (d.z < -.5 ? 4U : 0U);
    };
    std::mt19937_64 bits(21);
    std::uniform_real_distribution<double> uniform;
    for (int i = 0; i < kDraws; ++i) {
        const double u0 = uniform(bits);
        const DirectionSample drawn = sampler->draw_direction(u0, uniform(bits));
        EXPECT_EQ(drawn.density, sampler->density(drawn.direction));
        found[bin_of(drawn.direction)] += 1;
    }
    for (std::size_t bin = 0; bin < found.size(); ++bin) {
        expected[bin] = over_hemisphere(
            [&](const Vec3& d) { return bin_of(-d) == bin ? sampler->density(-d) : 0; });
        EXPECT_TRUE(agrees(
            measured_fraction(found[bin], kDraws, expected[bin]), expected[bin], .01,
            sidak_level(kLevel, found.size())));
    }
}

TEST(UniformSky, TellsTheDensityThatItDrawsDirectionsWith) {
    expect_density({});
    expect_density({.along_x = true, .along_y = true, .size_x = 3, .size_y = 2});
}

}  // namespace
}  // namespace quasimc::test

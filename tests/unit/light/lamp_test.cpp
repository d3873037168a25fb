#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "geometry/shapes/shapes.h"
#include "light/models/source.h"

namespace quasimc::test {
namespace {

using std::numbers::pi;

/// A lamp at the origin that aims down, flux 1.
LampSpec lamp_of(Opening opening, Pattern pattern) {
    LampSpec spec;
    spec.name = "lamp";
    spec.opening = opening;
    spec.pattern = std::move(pattern);
    spec.flux = {1};
    return spec;
}
LampSpec rectangle() {
    return lamp_of({.kind = Opening::Kind::rectangle, .length = 2, .width = .6}, cosine_pattern());
}
LampSpec disk() {
    return lamp_of({.kind = Opening::Kind::disk, .radius = .5}, cosine_pattern());
}
LampSpec ball() {
    return lamp_of({.kind = Opening::Kind::sphere, .radius = .5}, cosine_pattern());
}
LampSpec tube() {
    LampSpec spec = lamp_of({.kind = Opening::Kind::line, .length = 3}, tube_pattern());
    spec.axes = lamp_axes({1, 0, 0}, {0, 0, 1});
    return spec;
}

/// Irradiance at a point on a plane with normal n, averaged over an even grid of draws.
double irradiance(const Source& lamp, const Vec3& point, const Vec3& n) {
    constexpr int kSide = 300;
    double sum = 0;
    for (int i = 0; i < kSide; ++i) {
        for (int j = 0; j < kSide; ++j) {
            const Illumination seen =
                model_of(lamp).illuminate(point, (i + .5) / kSide, (j + .5) / kSide);
            sum += seen.weight > 0 ? seen.weight * std::max(0.0, dot(seen.to_light, n)) : 0;
        }
    }
    return sum / (kSide * kSide);
}

TEST(Lamp, FollowsTheInverseSquareLaw) {
    const auto lamp = make_lamp(lamp_of({}, isotropic_pattern()));
    for (const double distance : {.01, 1.0, 300.0}) {
        const Vec3 n = normalized({1, 2, 2});
        const Illumination seen = model_of(*lamp).illuminate(-distance * n, .3, .7);
        EXPECT_NEAR(seen.weight, 1 / (4 * pi * distance * distance), 1e-9 * seen.weight);
        EXPECT_NEAR(seen.distance, distance, 1e-12 * distance);
        EXPECT_LT(length(seen.to_light - n), 1e-12);
    }
}

/// E = M R^2 / (R^2 + h^2) below a disk's center, M its exitance.
/// The horizontal angles of photometric files of type C count counterclockwise, as seen from above.
TEST(Lamp, ThatShinesTo90DegreesShinesNorthIfItIsAlongEast) {
    LampSpec spec = lamp_of(
        {},
        web_pattern(
            {{0, 90, 180}, {0, 90, 180, 270, 360}, {1, 1, 1, 3, 3, 3, 2, 2, 2, 0, 0, 0, 1, 1, 1}}));
    spec.axes = lamp_axes({0, 0, -1}, {1, 0, 0});
    const auto lamp = make_lamp(spec);
    const auto intensity = [&](const Vec3& point) {
        return model_of(*lamp).illuminate(point, .5, .5).weight;
    };
    const double east = intensity({1, 0, 0});
    EXPECT_NEAR(intensity({0, 1, 0}) / east, 3, 1e-9);
    EXPECT_NEAR(intensity({-1, 0, 0}) / east, 2, 1e-9);
    EXPECT_NEAR(intensity({0, -1, 0}) / east, 0, 1e-9);
}

TEST(Lamp, ADiskLightsThePointBelowItsCenterByTheClosedForm) {
    const auto lamp = make_lamp(disk());
    const double exitance = 1 / (pi * .25);
    for (const double h : {.2, .5, 3.0}) {
        EXPECT_NEAR(irradiance(*lamp, {0, 0, -h}, {0, 0, 1}), exitance * .25 / (.25 + h * h), 1e-3);
    }
    EXPECT_EQ(irradiance(*lamp, {0, 0, .5}, {0, 0, -1}), 0) << "behind it";
}

/// View factor of a rectangle from a point below its corner (Howell, C-11; here four of them).
TEST(Lamp, ARectangleLightsThePointBelowItsCenterByTheClosedForm) {
    const auto lamp = make_lamp(rectangle());
    for (const double h : {.01, .4, 2.0, 500.0}) {
        const double a = 1 / h;
        const double b = .3 / h;
        const double factor = 4 / (2 * pi) *
                              (a / std::hypot(1, a) * std::atan(b / std::hypot(1, a)) +
                               b / std::hypot(1, b) * std::atan(a / std::hypot(1, b)));
        const double exitance = 1 / 1.2;
        EXPECT_NEAR(
            irradiance(*lamp, {0, 0, -h}, {0, 0, 1}), exitance * factor, 2e-4 * exitance * factor)
            << h;
    }
}

/// Every point near a lamp is lit with a bounded weight.
TEST(Lamp, ARectangleHasNoBrightSpecksNearIt) {
    const auto lamp = make_lamp(rectangle());
    std::mt19937_64 bits(5);
    std::uniform_real_distribution<double> uniform;
    for (int i = 0; i < 10000; ++i) {
        const Vec3 point{uniform(bits) - .5, .5 * uniform(bits) - .25, -1e-3};
        const double weight =
            model_of(*lamp).illuminate(point, uniform(bits), uniform(bits)).weight;
        EXPECT_LE(weight, 2 / 1.2 * 1.001) << "half of the sphere, of radiance M / pi";
    }
}

TEST(Lamp, ASphereLightsAsItsCenterWould) {
    const auto lamp = make_lamp(ball());
    for (const double distance : {.51, 1.0, 40.0}) {
        const Vec3 n = normalized({-1, 2, .5});
        EXPECT_NEAR(irradiance(*lamp, -distance * n, n) * 4 * pi * distance * distance, 1, 1e-4);
    }
    EXPECT_EQ(irradiance(*lamp, {0, .1, 0}, {0, 0, 1}), 0) << "inside";
}

/// Below the middle of a tube of flux 1 per length L, at distance h, on a plane facing it:
/// 1/(pi^2 L h) (sin b cos b + b) with tan b = L / 2h (cos of incidence times sin of emission).
TEST(Lamp, ATubeLightsThePointBelowItsMiddleByTheClosedForm) {
    const auto lamp = make_lamp(tube());
    for (const double h : {.001, .5, 20.0}) {
        const double b = std::atan(1.5 / h);
        const double expected = (std::sin(b) * std::cos(b) + b) / (pi * pi * 3 * h);
        EXPECT_NEAR(irradiance(*lamp, {0, 0, -h}, {0, 0, 1}), expected, 1e-4 * expected);
    }
    EXPECT_EQ(irradiance(*lamp, {9, 0, 0}, {-1, 0, 0}), 0) << "seen along its axis";
}

/// Flux through the floor by light tracing, against the irradiance sampled at points of the floor.
void expect_same_flux_on_the_floor(const LampSpec& spec) {
    const auto lamp = make_lamp(spec);
    const auto triangles = make_parallelogram({-1, -.5, -1}, {2, 0, 0}, {0, 1.5, 0});
    const LocalMesh mesh = make_local_mesh(triangles);
    const SceneProjection projection(mesh, {}, StartArea::silhouette);
    const auto sampler = model_of(*lamp).make_sampler_in(projection);
    ASSERT_NE(sampler, nullptr);
    std::mt19937_64 bits(7);
    std::uniform_real_distribution<double> uniform;
    constexpr int kStarts = 200000;
    double sent = 0;
    double weights = 0;
    for (int i = 0; i < kStarts; ++i) {
        const Emission e =
            sampler->emit({uniform(bits), uniform(bits), uniform(bits), uniform(bits)});
        weights += e.weight;
        EXPECT_NEAR(length(e.direction), 1, 1e-12);
        const Vec3 from = mesh.to_world(e.origin);
        const double t = (-1 - from.z) / e.direction.z;
        const Vec3 point = from + t * e.direction;
        const bool hits = e.direction.z < 0 && t > -1e-3 && std::abs(point.x) <= 1 &&
                          point.y >= -.5 && point.y <= 1;
        sent += hits ? e.weight : 0;
    }
    EXPECT_NEAR(weights / kStarts, 1, .01);
    const double flux = sampler->flux() * projection.world_area() * sent / kStarts;
    double seen = 0;
    constexpr int kPoints = 400000;
    for (int i = 0; i < kPoints; ++i) {
        const Vec3 point{2 * uniform(bits) - 1, 1.5 * uniform(bits) - .5, -1};
        const Illumination light = model_of(*lamp).illuminate(point, uniform(bits), uniform(bits));
        seen += light.weight * std::max(0.0, light.to_light.z) * 3 / kPoints;
    }
    EXPECT_NEAR(flux, seen, .02 * seen);
}

TEST(Lamp, SendsWhatIsSeenOfIt) {
    LampSpec slanted = rectangle();
    slanted.axes = lamp_axes({.3, .5, -.7}, {1, 0, 0});
    LampSpec far = lamp_of({}, spot_pattern(.2, 1));
    far.position = {3, 1, 20};
    far.axes = lamp_axes(-far.position, {1, 0, 0});
    LampSpec beside = ball();
    beside.position = {2, 0, -.5};
    for (const LampSpec& spec :
         {rectangle(), disk(), ball(), tube(), slanted, far, beside,
          lamp_of({}, isotropic_pattern())}) {
        expect_same_flux_on_the_floor(spec);
    }
}

TEST(Lamp, FarAwayAimsAtTheScene) {
    LampSpec spec = lamp_of({}, isotropic_pattern());
    spec.position = {0, 0, 1000};
    const LocalMesh mesh = make_local_mesh(make_parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    const SceneProjection projection(mesh, {}, StartArea::silhouette);
    const auto sampler = model_of(*make_lamp(spec)).make_sampler_in(projection);
    // The cone of the bounding sphere, of radius sqrt(1/2).
    EXPECT_NEAR(sampler->flux() * projection.world_area(), .5 / (4 * 1e6), 1e-9);
    for (const double u : {0.0, .1, .3, .45}) {
        const Emission e = sampler->emit({u, .3, .5, .5});
        EXPECT_LT(length(e.origin), 3) << "starts near the scene";
    }
}

TEST(Lamp, ThatShinesAwayFromTheSceneSendsNothing) {
    LampSpec spec = lamp_of({}, spot_pattern(.2, .5));
    spec.position = {0, 0, 5};
    spec.axes = lamp_axes({0, 0, 1}, {1, 0, 0});
    const LocalMesh mesh = make_local_mesh(make_parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    const SceneProjection open(mesh, {}, StartArea::silhouette);
    EXPECT_EQ(model_of(*make_lamp(spec)).make_sampler_in(open), nullptr);
    const Cell cell{.along_x = true, .along_y = true, .size_x = 1, .size_y = 1};
    const SceneProjection layer(mesh, cell, StartArea::silhouette);
    EXPECT_EQ(model_of(*make_lamp(spec)).make_sampler_in(layer), nullptr);
}

TEST(Lamp, IsNoSky) {
    const auto lamp = make_lamp(disk());
    EXPECT_EQ(lamp->traits(), kLampTraits);
    EXPECT_EQ(model_of(*lamp).radiance({0, 0, 1}), 0);
    EXPECT_TRUE(std::isnan(lamp->horizontal_irradiance()));
}

TEST(LampAxes, AreRightHandedWhateverIsAsked) {
    for (const Vec3& along : {Vec3{1, 0, 0}, Vec3{0, 0, 1}, Vec3{.3, .2, .1}}) {
        const Frame f = lamp_axes({0, 0, -2}, along);
        EXPECT_LT(length(cross(f.s, f.t) - f.n), 1e-12);
        EXPECT_LT(length(f.n - Vec3{0, 0, -1}), 1e-15);
    }
    EXPECT_LT(length(lamp_axes({0, 0, -1}, {3, 0, 0}).s - Vec3{1, 0, 0}), 1e-15);
}

}  // namespace
}  // namespace quasimc::test

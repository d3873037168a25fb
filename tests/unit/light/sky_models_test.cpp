// What is particular to one model: the weather of Perez, tables, sums, the disk of the sun.

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "light/daylight/period_light.h"
#include "light/models/entry.h"
#include "light/models/source.h"
#include "support/skies.h"
#include "support/statistics.h"
#include "unit/light/hemisphere_testing.h"

namespace quasimc::test {
namespace {

using std::numbers::pi;

SkyState weather_of(double direct, double diffuse, double elevation_deg) {
    SkyState state;
    state.to_sun = sun_at(elevation_deg);
    state.direct_normal = direct;
    state.diffuse_horizontal = diffuse;
    return state;
}

/// By hand, at a zenith angle of 60 degrees: 1.041 (pi/3)^3 = 1.195464; air mass of Kasten 1.9928.
TEST(PerezSky, GoesByClearnessAndBrightness) {
    const PerezWeather clear = perez_weather(weather_of(800, 100, 30));
    EXPECT_NEAR(clear.clearness, (9 + 1.195464) / 2.195464, 2e-6);
    EXPECT_NEAR(clear.brightness, 100 * 1.9928 / 1367, 1e-5);
    EXPECT_EQ(perez_weather(weather_of(0, 100, 30)).clearness, 1);
    SkyState far = weather_of(800, 100, 30);
    far.distance_au = 1.02;
    EXPECT_NEAR(perez_weather(far).brightness / clear.brightness, 1.02 * 1.02, 1e-12);
}

/// Coefficients of the range 6.2 and over and of overcast skies, by the paper's formula.
TEST(PerezSky, IsThePapersFormula) {
    const Vec3 sun{0, 0, 1};
    SkyState clear;
    clear.to_sun = sun;
    clear.direct_normal = 900;
    clear.diffuse_horizontal = 100;
    const double delta = perez_weather(clear).brightness;
    const double a = -1.05 + .4260 * delta;
    const double b = -.3250 + .7781 * delta;
    const double c = 31.0625 - 46.1148 * delta;
    const double d = -7.2312 + 13.35 * delta;
    const double e = 1.5 + 1.8564 * delta;
    const Vec3 from = upward(1, .5);
    const double gamma = pi / 3;
    EXPECT_NEAR(
        perez_shape(clear).radiance(from),
        (1 + a * std::exp(b / .5)) *
            (1 + c * std::exp(d * gamma) + e * std::cos(gamma) * std::cos(gamma)),
        1e-12);
    SkyState overcast = clear;
    overcast.direct_normal = 0;
    const double c1 = std::exp(std::pow(delta * 2.8, 1.2375)) - 1;
    const double d1 = -std::exp(delta * 1.8734) + .9738 + .2809 * delta;
    EXPECT_NEAR(
        perez_shape(overcast).radiance(from),
        (1 + (1.3525 - .2690 * delta) * std::exp((-.7670 + 1.2734 * delta) / .5)) *
            (1 + c1 * std::exp(d1 * gamma) + (.0356 - .5718 * delta) * .25),
        1e-12);
}

/// Nor does weather that never was make it dark or infinite.
RC_GTEST_PROP(PerezSky, IsASkyInAnyWeather, ()) {
    const SkyState state =
        weather_of(*rc::gen::inRange(0, 1100), *rc::gen::inRange(1, 700), *rc::gen::inRange(0, 91));
    const SkyShape shape = perez_shape(state);
    double sum = 0;
    for (const double sine : {0.0, 1e-6, .01, .3, .9, 1.0}) {
        for (const double azimuth : {0.0, 2.0, 4.0}) {
            const double radiance = shape.radiance(upward(azimuth, sine));
            RC_ASSERT(std::isfinite(radiance) && radiance >= 0);
            sum += radiance;
        }
    }
    RC_ASSERT(sum > 0);
}

/// Weather of other units has skies darker than any that was measured.
TEST(PerezSky, IsNeverDarkEverywhere) {
    for (const double direct : {0., 1e-4, .05, .3, 5., 50., 200., 1000.}) {
        for (const double diffuse : {1e-4, .02, .1, 1., 20., 60., 300.}) {
            for (const double elevation : {.1, 2., 10., 30., 50., 61., 75., 89.}) {
                EXPECT_GT(
                    horizontal_irradiance(perez_shape(weather_of(direct, diffuse, elevation))), 0)
                    << direct << " " << diffuse << " " << elevation;
            }
        }
    }
}

TEST(PerezSky, RefusesWhatIsNoDaylight) {
    EXPECT_THROW(static_cast<void>(perez_shape(weather_of(100, 0, 30))), InputError);
    EXPECT_THROW(static_cast<void>(perez_shape(weather_of(-1, 100, 30))), InputError);
    EXPECT_THROW(static_cast<void>(perez_shape(weather_of(0, NAN, 30))), InputError);
    try {
        static_cast<void>(perez_shape(weather_of(-1, 0, -5)));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.faults().size(), 3);
    }
}

TEST(SkyTables, HaveTheRadianceOfTheirCells) {
    SkyTable table{4, 2, {1, 2, 3, 4, 5, 6, 7, 8}, 0, 1};
    const double low = std::sin(pi / 8);
    const double high = std::sin(3 * pi / 8);
    for (std::size_t i = 0; i < 4; ++i) {
        const double azimuth = pi / 2 * (static_cast<double>(i) + .5);
        EXPECT_EQ(table.towards(upward(azimuth, low)), static_cast<double>(i + 1));
        EXPECT_EQ(table.towards(upward(azimuth, high)), static_cast<double>(i + 5));
    }
    table.turn = -1;  // as a compass, from the x axis
    EXPECT_EQ(table.towards(upward(-pi / 4, low)), 1);
    EXPECT_EQ(table.towards(upward(pi / 4, low)), 4);
    table.first_azimuth = pi / 2;  // from the y axis
    EXPECT_EQ(table.towards(upward(pi / 4, low)), 1);
    EXPECT_EQ(table.towards({0, 0, 1}) > 4, true);
}

/// Closed form: a cell of radiance L contributes L (sin^2 e1 - sin^2 e0) / 2 per radian of azimuth.
TEST(SkyTables, GiveTheSumOfTheirCells) {
    for (const auto& [azimuths, elevations] :
         {std::pair{3U, 2U}, std::pair{32U, 32U}, std::pair{100U, 7U}}) {
        const SkyTable table = uneven_table(azimuths, elevations);
        double sum = 0;
        for (std::size_t e = 0; e < elevations; ++e) {
            const double s0 = std::sin(pi / 2 * static_cast<double>(e) / elevations);
            const double s1 = std::sin(pi / 2 * static_cast<double>(e + 1) / elevations);
            for (std::size_t a = 0; a < azimuths; ++a) {
                sum += table.at(a, e) * (s1 * s1 - s0 * s0) / 2 * 2 * pi / azimuths;
            }
        }
        EXPECT_NEAR(horizontal_irradiance(table_shape(table)), sum, 1e-9 * sum);
    }
}

/// The original program's constant table acted as 0.637 (2/pi) of what falls on the horizontal,
/// since it drew angles evenly; one of equal radiance is the uniform sky.
TEST(SkyTables, OfEqualValuesAreTheUniformSky) {
    const auto sky = make_sky("table", table_shape({32, 32, std::vector<double>(1024, 7.0)}), {1});
    EXPECT_NEAR(model_of(*sky).radiance(sun_at(20)), 1 / pi, 1e-9);
    double upper = 0;
    constexpr int kDraws = 100000;
    std::mt19937_64 bits(9);
    std::uniform_real_distribution<double> uniform;
    for (int i = 0; i < kDraws; ++i) {
        const Illumination seen = model_of(*sky).illuminate({}, uniform(bits), uniform(bits));
        upper += seen.to_light.z > .5 ? 1 : 0;
    }
    EXPECT_TRUE(agrees(measured_fraction(upper, kDraws, .5), .5, .01));
}

TEST(SkySums, AddUpToWhatWasAdded) {
    SkySum sum(48, 24);
    sum.add_sky(cie_clear_shape(sun_at(20)), 30);
    sum.add_sky(uniform_sky_shape(), 70);
    EXPECT_EQ(sum.horizontal_irradiance(), 100);
    EXPECT_NEAR(horizontal_irradiance(table_shape(sum.table())), 100, 1e-6);
}

/// Its cells are small: a sum of one sky sheds nearly the same light on surfaces of any slope.
TEST(SkySums, OfOneSkyAreNearlyThatSky) {
    SkySum sum;
    sum.add_sky(cie_clear_shape(sun_at(40)), 1);
    const auto table = make_sky("sum", table_shape(sum.table()), {1});
    const auto sky = make_sky("sky", cie_clear_shape(sun_at(40)), {1});
    for (const Vec3& n : {Vec3{1, 0, 0}, Vec3{0, -1, 0}, normalized({.3, .4, .5})}) {
        const auto on_plate = [&](const Source& source, const GradedMesh& mesh) {
            return mesh.integral([&](const Vec3& d) {
                return model_of(source).radiance(d) * std::max(0.0, dot(d, n));
            });
        };
        const SkyShape shape = table_shape(sum.table());
        EXPECT_NEAR(
            on_plate(*table, GradedMesh(shape.azimuths, shape.sines)), on_plate(*sky, GradedMesh()),
            2e-4);
    }
}

/// The box of a scene, [0, 4] x [0, 2] x [0, 1].
EntryBox make_entry_box() {
    EntryBox box;
    box.bounds.low = {0, 0, 0};
    box.bounds.high = {4, 2, 1};
    box.face_area = {2, 4, 8};
    return box;
}

/// Seen along the light, starts are even over the box: each face has its share.
TEST(EntryPoint, IsEvenOverTheBoxAsSeenAlongTheLight) {
    const EntryBox box = make_entry_box();
    std::mt19937_64 bits(10);
    std::uniform_real_distribution<double> uniform;
    for (const Vec3& d :
         {normalized({.5, -.3, -.7}), normalized({-.5, .3, .2}), Vec3{0, 0, -1}, Vec3{0, 1, 0}}) {
        constexpr int kStarts = 20000;
        std::array<double, 3> faces{};
        for (int i = 0; i < kStarts; ++i) {
            const Vec3 p = entry_point(box, d, uniform(bits), uniform(bits));
            const bool at_z = p.z == (d.z > 0 ? 0 : 1) && d.z != 0;
            const bool at_x = !at_z && d.x != 0 && p.x == (d.x > 0 ? 0 : 4);
            faces[at_z ? 2 : at_x ? 0 : 1] += 1;
            EXPECT_TRUE(at_z || at_x || p.y == (d.y > 0 ? 0 : 2));
        }
        const std::array<double, 3> areas{2 * std::abs(d.x), 4 * std::abs(d.y), 8 * std::abs(d.z)};
        const double all = box.projected_area(d);
        for (std::size_t i = 0; i < 3; ++i) {
            if (areas[i] > 0 && areas[i] < all) {
                EXPECT_TRUE(agrees(
                    measured_fraction(faces[i], kStarts, areas[i] / all), areas[i] / all, .03,
                    sidak_level(kLevel, 6)));
            } else {
                EXPECT_EQ(faces[i], areas[i] > 0 ? kStarts : 0);
            }
        }
    }
}

TEST(SunDisk, HasTheSizeOfTheSun) {
    EXPECT_NEAR(solar_radius_deg(1), .26656, 1e-5);
    EXPECT_NEAR(solar_radius_deg(.983), .2711, 1e-4);
}

/// The plane that faces the disk gets its irradiance, and others cos times as much.
TEST(SunDisk, GivesItsIrradianceToThePlaneThatFacesIt) {
    for (const double radius : {.2666, 5.0, 40.0}) {
        const Vec3 to_sun = sun_at(60);
        const auto disk = make_sun_disk("sun", to_sun, radius, {1});
        double facing = 0;
        double horizontal = 0;
        constexpr int kSide = 300;
        for (int i = 0; i < kSide; ++i) {
            for (int j = 0; j < kSide; ++j) {
                const Illumination seen =
                    model_of(*disk).illuminate({}, (i + .5) / kSide, (j + .5) / kSide);
                EXPECT_NEAR(
                    seen.weight * model_of(*disk).radiance(seen.to_light) * pi * pi,
                    seen.weight * model_of(*disk).radiance(to_sun) * pi * pi, 1e-9);
                facing += seen.weight * dot(seen.to_light, to_sun);
                horizontal += seen.weight * seen.to_light.z;
            }
        }
        EXPECT_NEAR(facing / (kSide * kSide), 1, 1e-5) << radius;
        EXPECT_NEAR(horizontal / (kSide * kSide), to_sun.z, 1e-5) << radius;
        EXPECT_EQ(model_of(*disk).radiance(-1.0 * to_sun), 0);
        EXPECT_EQ(disk->traits(), kSunDiskTraits);
        EXPECT_NEAR(disk->horizontal_irradiance(), to_sun.z, 1e-9);
    }
}

/// Half of the disk is above the horizon: closed form of a half disk of small radius r is
/// 2 r^3 / 3 over pi r^2.
TEST(SunDisk, MayBeOnTheHorizon) {
    constexpr double kRadius = .5 * pi / 180;
    const auto disk = make_sun_disk("sun", {1, 0, 0}, .5, {1});
    EXPECT_NEAR(disk->horizontal_irradiance(), 2 * kRadius / (3 * pi), 1e-4 * kRadius);
    EXPECT_EQ(make_sun_disk("sun", sun_at(-1), .5, {1})->horizontal_irradiance(), 0);
    const auto low = make_sun_disk("sun", sun_at(.2), .5, {1});
    double above = 0;
    constexpr int kSide = 400;
    for (int i = 0; i < kSide * kSide; ++i) {
        const Illumination seen =
            model_of(*low).illuminate({}, (i / kSide + .5) / kSide, (i % kSide + .5) / kSide);
        above += seen.weight * std::max(0.0, seen.to_light.z) / (kSide * kSide);
    }
    EXPECT_NEAR(low->horizontal_irradiance(), above, 1e-5 * above);
}

/// Weights, whose mean must be 1, over the starts of a disk into a box; the flux is that of a beam
/// into the same box.
TEST(SunDisk, SendsTheLightThatEntersTheBox) {
    const std::vector<Triangle> triangles{{Vec3{0, 0, 0}, Vec3{4, 2, 0}, Vec3{4, 0, 1}}};
    const LocalMesh mesh = make_local_mesh(triangles);
    const SceneProjection projection(mesh, {}, StartArea::silhouette);
    for (const Vec3& to_sun : {sun_at(60), sun_at(1), Vec3{0, 0, 1}, Vec3{0, 1, 0}}) {
        const auto sampler =
            model_of(*make_sun_disk("sun", to_sun, 3, {1})).make_sampler_in(projection);
        double mean = 0;
        constexpr int kSide = 300;
        for (int i = 0; i < kSide * kSide; ++i) {
            const Emission start =
                sampler->emit({.3, .6, (i / kSide + .5) / kSide, (i % kSide + .5) / kSide});
            EXPECT_GE(dot(-start.direction, to_sun), std::cos(3 * pi / 180) - 1e-12);
            mean += start.weight / (kSide * kSide);
        }
        EXPECT_NEAR(mean, 1, 1e-5);
        if (to_sun.z > .5 && to_sun.z < 1) {
            EXPECT_NEAR(
                sampler->flux(), projection.entry_box().projected_area(to_sun),
                1e-9 * sampler->flux());
        }
    }
}

TEST(SunDisk, DrawsItsDirectionsEvenly) {
    const std::vector<Triangle> triangles{{Vec3{0, 0, 0}, Vec3{4, 2, 0}, Vec3{4, 0, 1}}};
    const LocalMesh mesh = make_local_mesh(triangles);
    const SceneProjection projection(mesh, {}, StartArea::silhouette);
    constexpr double kRadius = 3 * pi / 180;
    const Vec3 to_sun = sun_at(60);
    const auto sampler =
        model_of(*make_sun_disk("sun", to_sun, 3, {1})).make_sampler_in(projection);
    const double inside = 1 / (2 * pi * (1 - std::cos(kRadius)));
    EXPECT_NEAR(sampler->density(-to_sun), inside, 1e-9 * inside);
    EXPECT_NEAR(sampler->draw_direction(.999, .2).density, inside, 1e-9 * inside);
    EXPECT_EQ(sampler->density(to_sun), 0);
    EXPECT_EQ(sampler->density(-sun_at(56.9)), 0);
    const auto beam =
        model_of(*make_directional_source("sun", -to_sun, {1})).make_sampler_in(projection);
    EXPECT_EQ(beam->density(-to_sun), 0);  // has none
}

}  // namespace
}  // namespace quasimc::test

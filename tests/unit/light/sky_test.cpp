// Every sky that there is: normalization, sampling, what enters a scene.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "geometry/shapes/shapes.h"
#include "light/models/source.h"
#include "support/skies.h"
#include "support/statistics.h"
#include "unit/light/hemisphere_testing.h"

namespace quasimc::test {
namespace {

using std::numbers::pi;

/// A box of 4 x 2 x 1 to be lit, and its aperture.
struct LitBox {
    LocalMesh mesh;
    SceneProjection projection;

    explicit LitBox(const Cell& cell = {})
        : mesh(make_local_mesh(
              std::vector<Triangle>{{Vec3{0, 0, 0}, Vec3{4, 2, 0}, Vec3{4, 0, 1}}})),
          projection(mesh, cell, StartArea::silhouette) {}
    LitBox(const LitBox&) = delete;
    LitBox& operator=(const LitBox&) = delete;
};

class EverySky : public ::testing::TestWithParam<NamedSky> {
  protected:
    const SkyShape& shape_ = GetParam().shape;
    const std::shared_ptr<const Source> sky_ = make_sky("sky", GetParam().shape, {2, 3});
    const GradedMesh mesh_{GetParam().shape.azimuths, GetParam().shape.sines};

    static constexpr unsigned kFamily = 128;  // tests like these: more than there are skies
};

TEST_P(EverySky, BringsTheIrradianceAskedForToTheHorizontal) {
    const double integral =
        mesh_.integral([&](const Vec3& d) { return model_of(*sky_).radiance(d) * d.z; });
    EXPECT_NEAR(integral, 1, 1e-6);
    EXPECT_EQ(sky_->horizontal_irradiance(), 1);
    EXPECT_EQ(sky_->spectrum()[1], 3);
    EXPECT_EQ(sky_->traits(), kSkyTraits);
    std::mt19937_64 bits(5);
    std::uniform_real_distribution<double> uniform;
    for (int i = 0; i < 1000; ++i) {
        const Vec3 d = upward(2 * pi * uniform(bits), uniform(bits));
        EXPECT_GE(model_of(*sky_).radiance(d), 0);
        EXPECT_TRUE(std::isfinite(model_of(*sky_).radiance(d)));
        EXPECT_EQ(model_of(*sky_).radiance({d.x, d.y, -d.z}), 0);
    }
}

TEST_P(EverySky, IlluminatesWithTheRadianceThatIsSeen) {
    std::mt19937_64 bits(6);
    std::uniform_real_distribution<double> uniform;
    std::vector<WeightedDirection> draws;
    for (int i = 0; i < 20000; ++i) {
        const Illumination seen = model_of(*sky_).illuminate({}, uniform(bits), uniform(bits));
        EXPECT_NEAR(length(seen.to_light), 1, 1e-14);
        draws.push_back({seen.to_light, seen.weight});
    }
    EXPECT_TRUE(follow(
        draws, [&](const Vec3& d) { return model_of(*sky_).radiance(d); }, mesh_,
        sidak_level(kLevel, kFamily)));
}

/// Cells are so small, too, that weights hardly differ: a path's noise is that of its position.
TEST_P(EverySky, SendsItsRadianceThroughTheBoxAroundTheScene) {
    const LitBox lit;
    const EntryBox& box = lit.projection.entry_box();
    const auto sampler = model_of(*sky_).make_sampler_in(lit.projection);
    ASSERT_NE(sampler, nullptr);
    const auto entering = [&](const Vec3& d) {
        return model_of(*sky_).radiance(d) * box.projected_area(d);
    };
    EXPECT_NEAR(sampler->flux(), mesh_.integral(entering), 1e-6 * sampler->flux());
    std::mt19937_64 bits(7);
    std::uniform_real_distribution<double> uniform;
    std::vector<WeightedDirection> draws;
    std::vector<double> weights;
    double squares = 0;
    constexpr int kDraws = 20000;
    for (int i = 0; i < kDraws; ++i) {
        const Emission start =
            sampler->emit({uniform(bits), uniform(bits), uniform(bits), uniform(bits)});
        EXPECT_LE(start.direction.z, 0);
        draws.push_back({-start.direction, start.weight * sampler->flux()});
        weights.push_back(start.weight);
        squares += (start.weight - 1) * (start.weight - 1);
    }
    EXPECT_TRUE(agrees(measured(weights), 1, .02));
    EXPECT_TRUE(follow(draws, entering, mesh_, sidak_level(kLevel, kFamily)));
    EXPECT_LT(std::sqrt(squares / kDraws), .1);
}

/// Sorted borders of which density() may have steps at some.
std::vector<double> borders(std::vector<double> some, std::span<const double> more, double turn) {
    for (const double x : more) {
        some.push_back(turn > 0 ? x - turn * std::floor(x / turn) : x);
    }
    std::sort(some.begin(), some.end());
    return some;
}

/// The integral of an emitter's density over all directions: it is the same all over a cell.
double integral_of_density(const SourceSampler& sampler, const SkyShape& shape) {
    std::vector<double> azimuths;
    std::vector<double> sines;
    for (int i = 0; i <= 64; ++i) {
        azimuths.push_back(2 * pi * i / 64);
    }
    for (int i = 0; i <= 32; ++i) {
        sines.push_back(std::sin(pi / 2 * i / 32));
    }
    azimuths = borders(azimuths, shape.azimuths, 2 * pi);
    sines = borders(sines, shape.sines, 0);
    double sum = 0;
    for (std::size_t i = 0; i + 1 < azimuths.size(); ++i) {
        for (std::size_t j = 0; j + 1 < sines.size(); ++j) {
            const Vec3 d =
                upward(.5 * (azimuths[i] + azimuths[i + 1]), .5 * (sines[j] + sines[j + 1]));
            EXPECT_EQ(sampler.density(d), 0);  // light doesn't come from below
            sum +=
                sampler.density(-d) * (azimuths[i + 1] - azimuths[i]) * (sines[j + 1] - sines[j]);
        }
    }
    return sum;
}

TEST_P(EverySky, TellsTheDensityThatItDrawsDirectionsWith) {
    const LitBox lit;
    const auto sampler = model_of(*sky_).make_sampler_in(lit.projection);
    ASSERT_NE(sampler, nullptr);
    EXPECT_NEAR(integral_of_density(*sampler, shape_), 1, 1e-9);
    std::mt19937_64 bits(17);
    std::uniform_real_distribution<double> uniform;
    for (int i = 0; i < 20000; ++i) {
        const double u0 = uniform(bits);
        const double u1 = uniform(bits);
        const Emission start = sampler->emit({.5, .5, u0, u1});
        const Vec3& d = start.direction;
        const DirectionSample drawn = sampler->draw_direction(u0, u1);
        EXPECT_EQ(length(drawn.direction - d), 0);
        EXPECT_NEAR(drawn.density, sampler->density(d), 1e-12 * drawn.density);
        const double light = model_of(*sky_).radiance(-d) *
                             lit.projection.entry_box().projected_area(d) / sampler->flux();
        EXPECT_NEAR(start.weight * sampler->density(d), light, 1e-9 * light);
    }
}

/// A smooth sky that is black for the most part, with a border that runs through cells.
SkyShape half_dark_shape() {
    return {[](const Vec3& d) { return std::max(0.0, d.x + .7 * d.y + .3 * d.z - .6); }, {}, {}};
}

TEST(Skies, SendLightFromEveryPointThatHasSome) {
    const LitBox lit;
    const SkyShape shape = half_dark_shape();
    const auto sky = make_sky("sky", shape, {1});
    const auto sampler = model_of(*sky).make_sampler_in(lit.projection);
    std::mt19937_64 bits(18);
    std::uniform_real_distribution<double> uniform;
    int lit_points = 0;
    for (int i = 0; i < 100000; ++i) {
        const Vec3 d = upward(2 * pi * uniform(bits), uniform(bits));
        if (shape.radiance(d) > 0) {
            ++lit_points;
            ASSERT_GT(sampler->density(-d), 0);
        }
    }
    EXPECT_GT(lit_points, 1000);
    std::vector<double> weights;
    for (int i = 0; i < 20000; ++i) {
        weights.push_back(sampler->emit({.5, .5, uniform(bits), uniform(bits)}).weight);
    }
    EXPECT_TRUE(agrees(measured(weights), 1, .02));
}

/// A season has thousands of skies; reading it must not integrate them.
TEST(Skies, AreIntegratedWhenTheirLightIsAskedFor) {
    const auto calls = std::make_shared<int>(0);
    const SkyShape shape{
        [calls](const Vec3& d) {
            ++*calls;
            return d.z;
        },
        {},
        {}};
    const auto sky = make_sky("sky", shape, {1});
    EXPECT_EQ(*calls, 1);
    EXPECT_NEAR(model_of(*sky).radiance({0, 0, 1}), 1.5 / pi, 1e-7);
    EXPECT_GT(*calls, 100);
    const int so_far = *calls;
    EXPECT_GT(model_of(*sky).radiance({0, .6, .8}), 0);
    EXPECT_EQ(*calls, so_far + 1);
    const SkyShape black{[](const Vec3&) { return 0.0; }, {}, {}};
    EXPECT_THROW((void)make_sky("black", black, {1}), InputError);
}

TEST(Skies, EnterPeriodicScenesThroughTheirOpenFaces) {
    const Cell layer{.along_x = true, .along_y = true, .size_x = 3, .size_y = 5};
    const Cell row{.along_x = true, .size_x = 3};
    for (const auto& sky : sample_of_skies({1})) {
        const LitBox lit(layer);
        const auto sampler = model_of(*sky).make_sampler_in(lit.projection);
        const double expected = 15 * sky->horizontal_irradiance();
        EXPECT_NEAR(sampler->flux() * lit.projection.world_area(), expected, 1e-6 * expected)
            << sky->name();
        const double top = lit.projection.entry_box().bounds.high.z;
        EXPECT_EQ(sampler->emit({.1, .2, .3, .4}).origin.z, top);
        const LitBox lit_row(row);
        EXPECT_GT(
            model_of(*sky).make_sampler_in(lit_row.projection)->flux() *
                lit_row.projection.world_area(),
            6 * sky->horizontal_irradiance());
    }
}

INSTANTIATE_TEST_SUITE_P(AllSkies, EverySky, ::testing::ValuesIn(all_skies()), [](const auto& sky) {
    return sky.param.name;
});

/// A control: a sky a hundredth brighter around the sun is noticed.
TEST(Skies, DifferFromOnesThatAreSlightlyBrighterSomewhere) {
    const auto sky = make_sky("sky", cie_overcast_shape(), {1});
    std::mt19937_64 bits(8);
    std::uniform_real_distribution<double> uniform;
    std::vector<WeightedDirection> draws;
    for (int i = 0; i < 20000; ++i) {
        const Illumination seen = model_of(*sky).illuminate({}, uniform(bits), uniform(bits));
        draws.push_back({seen.to_light, seen.weight});
    }
    const auto brighter = [&](const Vec3& d) {
        return model_of(*sky).radiance(d) * (d.x > .5 ? 1.15 : 1);
    };
    EXPECT_FALSE(follow(draws, brighter, GradedMesh(), kLevel));
}

/// Irradiance on a plate of normal n.
double on_plate(const Source& sky, const Vec3& n) {
    return GradedMesh().integral(
        [&](const Vec3& d) { return model_of(sky).radiance(d) * std::max(0.0, dot(d, n)); });
}

TEST(Skies, HaveTheClosedFormsOfTheOvercastSky) {
    const auto sky = make_sky("overcast", cie_overcast_shape(), {1});
    EXPECT_NEAR(horizontal_irradiance(cie_overcast_shape()), 7 * pi / 9, 1e-8);
    EXPECT_NEAR(model_of(*sky).radiance({0, 0, 1}), 9 / (7 * pi), 1e-9);
    EXPECT_NEAR(on_plate(*sky, {0, 1, 0}), .396177, 1e-6);
    EXPECT_NEAR(on_plate(*sky, {0, 1, 0}), 3.0 / 14 + 4 / (7 * pi), 1e-6);
    EXPECT_NEAR(horizontal_irradiance(uniform_sky_shape()), pi, 1e-8);
}

TEST(Skies, TypeFiveIsUniformAndTypeTwelveNearlyTheOldClearSky) {
    const Vec3 sun = sun_at(40);
    const auto uniform = make_sky("5", cie_general_shape(5, sun), {1});
    const auto twelve = make_sky("12", cie_general_shape(12, sun), {1});
    const auto clear = make_sky("clear", cie_clear_shape(sun), {1});
    for (const Vec3& d : {sun_at(5), sun_at(60), normalized({-.3, .2, .4})}) {
        EXPECT_NEAR(model_of(*uniform).radiance(d), 1 / pi, 1e-9);
        EXPECT_NEAR(model_of(*twelve).radiance(d) / model_of(*clear).radiance(d), 1, 1e-3);
    }
}

/// Models that know of a sun show it.
TEST(Skies, AreBrightestAtTheSun) {
    const Vec3 sun = sun_at(50);
    SkyState state;
    state.to_sun = sun;
    state.direct_normal = 800;
    for (const SkyEntry& entry : sky_catalogue()) {
        if (entry.needs == SkyNeeds::nothing) {
            continue;
        }
        const SkyShape shape = entry.make(state);
        const double at_sun = shape.radiance(sun);
        EXPECT_GT(at_sun, 3 * shape.radiance(normalized({-sun.x, -sun.y, sun.z}))) << entry.name;
    }
}

TEST(Skies, AreFoundByTheirNames) {
    EXPECT_EQ(find_sky("perez")->needs, SkyNeeds::sun_and_weather);
    EXPECT_EQ(find_sky("pink"), nullptr);
}

}  // namespace
}  // namespace quasimc::test

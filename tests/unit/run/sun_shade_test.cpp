// The light of sunlit and shaded parts against geometry, and against light by origin.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "geometry/shapes/shapes.h"
#include "optics/material.h"
#include "quasimc/series.h"
#include "statistical/scenes.h"
#include "support/listening.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

using Q = SunShadeQuantity;

constexpr double kDegree = std::numbers::pi / 180;

RunSpec spec_of_parts(Method from, std::uint64_t paths) {
    RunSpec spec = spec_of(from, paths);
    spec.sun_shade = SunShade::apart;
    return spec;
}

/// Leaves over a bright ground, in two bands.
Scene make_leafy_stand() {
    SceneBuilder builder = make_builder(2);
    builder.add_material(diffuse("leaf", .3, .2, 2));
    builder.add_material(diffuse("soil", .5, 0, 2));
    add_leaves(builder, random_leaves(10, .6, 1, 3));
    builder.set_ground(ground("soil"));
    return std::move(builder).build();
}

const Sources& daylight() {
    static const Sources kDaylight{sun(30, {1, 2}), sky({.5, .2})};
    return kDaylight;
}

class SunShadeParts : public ::testing::TestWithParam<Method> {
  protected:
    [[nodiscard]] Result run_parts(
        const Scene& scene, const Sources& sources, std::uint64_t paths) const {
        return run(scene, sources, spec_of_parts(GetParam(), paths));
    }
};

/// Two black leaves of 1 x 1, one above the other, and a sun whose shadow moves by half of that.
/// The lower one receives the sky that the upper one does not hide.
TEST_P(SunShadeParts, OfTwoLeavesFollowFromGeometry) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("low", "black", floor_of(0, 1, 0, 1, 0)));
    builder.add_organ(organ("high", "black", floor_of(0, 1, 0, 1, 1)));
    const Scene scene = std::move(builder).build();
    const double zenith = std::atan(.5), sky_light = .5;
    const Result result = run_parts(scene, {sun(zenith / kDegree, {2}), sky({sky_light})}, 1 << 13);
    const double beam = 2 * std::cos(zenith), shaded = sky_light * (1 - tube_view_factor(1));
    const auto expect = [&](const Estimate& e, double expected, const char* what) {
        const bool is_exact = e.standard_error == 0 || std::isnan(e.standard_error);
        if (is_exact) {
            EXPECT_NEAR(e.mean, expected, 1e-6) << what;
        } else {
            EXPECT_TRUE(agrees(measured(e, kReplicates), expected, .05, sidak_level(kLevel, 12)))
                << what;
        }
    };
    const SunShadeLight& leaves = result.sun_shade;
    expect(leaves.at(0, Q::sunlit_fraction_upper), .5, "fraction of the lower leaf");
    expect(leaves.at(0, Q::sunlit_fraction_lower), 0, "its lower side");
    expect(leaves.at(0, Q::incident_upper_shaded), shaded, "shaded");
    expect(leaves.at(0, Q::incident_upper_sunlit), beam + shaded, "sunlit");
    expect(leaves.at(0, Q::incident_upper_direct), beam / 2 + shaded, "direct");
    expect(leaves.at(0, Q::incident_lower_shaded), 0, "light from below");
    expect(leaves.at(0, Q::absorbed_flux_density_sunlit), beam + shaded, "absorbed, sunlit");
    expect(leaves.at(0, Q::absorbed_flux_density_shaded), shaded, "absorbed, shaded");
    expect(leaves.at(1, Q::sunlit_fraction_upper), 1, "fraction of the upper leaf");
    expect(leaves.at(1, Q::incident_upper_sunlit), beam + sky_light, "its sunlit side");
    EXPECT_TRUE(std::isnan(leaves.at(0, Q::incident_lower_sunlit).mean));
    // Three quarters of both together are sunlit; the shaded rest belongs to the lower one.
    const SunShadeLight& both = result.groups.sun_shade;
    expect(both.at(0, Q::sunlit_fraction_upper), .75, "fraction of both");
    expect(
        both.at(0, Q::incident_upper_sunlit), beam + (shaded + 2 * sky_light) / 3, "both, sunlit");
    expect(both.at(0, Q::incident_upper_shaded), shaded, "both, shaded");
}

/// Half of a sphere is sunlit, and receives the light of its cross-section.
TEST_P(SunShadeParts, OfASphereHaveTheMeanAngle) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("skin", .4, 0));
    builder.add_organ(organ("sphere", "skin", make_sphere({0, 0, 0}, 1, 4)));
    const Result result = run_parts(std::move(builder).build(), {sun(50, {3})}, 1 << 12);
    const Estimate lit = result.sun_shade.at(0, Q::incident_upper_sunlit);
    EXPECT_TRUE(agrees(measured(lit, kReplicates), 1.5, .05));
    EXPECT_EQ(result.sun_shade.at(0, Q::incident_upper_shaded).mean, 0);
}

/// The mean of both parts, by their areas, is the light of the whole.
void expect_whole(
    const SunShadeLight& parts, std::size_t row, std::size_t band, Q lit, double all) {
    const double fraction = parts.at(row, lit, band).mean;
    const auto next = [&](int more) {
        const auto quantity =
            static_cast<std::size_t>(lit) + (lit == Q::sunlit_fraction_upper ? 2 : 3);
        return parts.at(row, static_cast<Q>(quantity + static_cast<std::size_t>(more)), band).mean;
    };
    const double sunlit = fraction > 0 ? fraction * next(0) : 0;
    const double shaded = std::isnan(next(1)) ? 0 : (1 - fraction) * next(1);
    EXPECT_NEAR(sunlit + shaded, all, 1e-9 * (1 + all)) << row;
}

template <typename Light>
void expect_parts_of(const Light& light, const SunShadeLight& parts, std::size_t rows) {
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t b = 0; b < 2; ++b) {
            expect_whole(
                parts, row, b, Q::sunlit_fraction_upper,
                light.at(row, Quantity::incident_upper, b).mean);
            expect_whole(
                parts, row, b, Q::sunlit_fraction_lower,
                light.at(row, Quantity::incident_lower, b).mean);
            const double both = parts.at(row, Q::sunlit_fraction_upper, b).mean +
                                parts.at(row, Q::sunlit_fraction_lower, b).mean;
            EXPECT_NEAR(both, light.sunlit_fraction[row].mean, 1e-12);
            const double dark = parts.at(row, Q::absorbed_flux_density_shaded, b).mean;
            const double lit =
                both > 0 ? parts.at(row, Q::absorbed_flux_density_sunlit, b).mean : 0;
            const double all = light.at(row, Quantity::absorbed_flux_density, b).mean;
            EXPECT_NEAR(both * lit + (1 - both) * dark, all, 1e-9 * (1 + all));
        }
    }
}

TEST_P(SunShadeParts, AddUpToTheWhole) {
    const Scene scene = make_leafy_stand();
    const Result result = run_parts(scene, daylight(), 1 << 10);
    expect_parts_of(result, result.sun_shade, result.organs());
    expect_parts_of(result.groups, result.groups.sun_shade, result.groups.groups.size());
}

TEST_P(SunShadeParts, LeaveTheWholeAsItIs) {
    const Scene scene = make_leafy_stand();
    const Result apart = run_parts(scene, daylight(), 1 << 10);
    const Result together = run(scene, daylight(), spec_of(GetParam(), 1 << 10));
    EXPECT_TRUE(together.sun_shade.empty());
    for (std::size_t i = 0; i < together.values.size(); ++i) {
        EXPECT_EQ(apart.values[i].mean, together.values[i].mean);
        EXPECT_EQ(apart.values[i].ci95_high, together.values[i].ci95_high);
    }
}

TEST_P(SunShadeParts, AreTheSameOnAnyNumberOfThreads) {
    const Scene scene = make_leafy_stand();
    RunSpec spec = spec_of_parts(GetParam(), 1 << 10);
    const Result one = run(scene, daylight(), spec);
    spec.threads = 3;
    const Result three = run(scene, daylight(), spec);
    for (std::size_t i = 0; i < one.sun_shade.values.size(); ++i) {
        const Estimate &a = one.sun_shade.values[i], &b = three.sun_shade.values[i];
        EXPECT_TRUE(a.mean == b.mean || (std::isnan(a.mean) && std::isnan(b.mean)));
    }
}

/// Without scattered light, the light of a sun is its beam: also where the absorptance depends on
/// the angle.
TEST_P(SunShadeParts, DifferByTheBeamOfLightByOrigin) {
    const bool is_bundles = GetParam() == Method::ray_bundles;
    SceneBuilder builder = make_builder();
    MaterialSpec waxy = diffuse("leaf", .3, .2);
    for (auto* side : {&waxy.upper, &waxy.lower}) {
        for (SideOptics& optics : *side) {
            if (!is_bundles) {
                optics.reflection_model = optics.transmission_model = "coated_lambertian";
            }
        }
    }
    builder.add_material(waxy);
    add_leaves(builder, random_leaves(10, .6, 1, 3));
    const Scene scene = std::move(builder).build();
    RunSpec spec = spec_of_parts(GetParam(), 1 << 11);
    spec.max_depth = is_bundles ? 0 : 1;
    spec.origins = {"sun", "sky"};
    const Result result = run(scene, {sun(30, {1}), sky({.5})}, spec);
    const Result& of_sun = result.origins[0].light;
    EXPECT_TRUE(of_sun.sun_shade.empty());
    int sunlit = 0;
    for (std::size_t i = 0; i < result.organs(); ++i) {
        const double fraction = result.sunlit_fraction[i].mean;
        if (!(fraction > 0)) {
            continue;
        }
        ++sunlit;
        const double beam =
            fraction * (result.sun_shade.at(i, Q::absorbed_flux_density_sunlit).mean -
                        result.sun_shade.at(i, Q::absorbed_flux_density_shaded).mean);
        const double expected = is_bundles ? .5 * of_sun.at(i, Quantity::incident_direct, 0).mean
                                           : of_sun.at(i, Quantity::absorbed_flux_density, 0).mean;
        EXPECT_NEAR(beam, expected, 1e-9) << i;
    }
    EXPECT_GT(sunlit, 3);
}

TEST_P(SunShadeParts, WithoutASunAreAllShaded) {
    const Scene scene = make_leafy_stand();
    const Result result = run_parts(scene, {sky({.5, .2})}, 1 << 8);
    for (std::size_t i = 0; i < result.organs(); ++i) {
        EXPECT_EQ(result.sun_shade.at(i, Q::sunlit_fraction_upper).mean, 0);
        EXPECT_TRUE(std::isnan(result.sun_shade.at(i, Q::incident_upper_sunlit).mean));
        EXPECT_EQ(
            result.sun_shade.at(i, Q::incident_upper_shaded).mean,
            result.at(i, Quantity::incident_upper, 0).mean);
    }
}

INSTANTIATE_TEST_SUITE_P(
    EveryWay,
    SunShadeParts,
    ::testing::Values(
        Method::light_tracing, Method::from_organs, Method::first_hits, Method::ray_bundles),
    name_of);

/// Sunlit leaves lie high and receive more of the sky. So the mean of all leaves' skylight is not
/// that of the sunlit area: groups weigh leaf by leaf, without a bias that few paths would show.
TEST(SunShadeGroups, WeighLeavesByTheirSunlitArea) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .1, .1));
    builder.add_organ(organ("high", "leaf", floor_of(0, 1, 0, 1, 1)));
    builder.add_organ(organ("low", "leaf", floor_of(0, 1, 0, 1, .8)));
    const Scene scene = std::move(builder).build();
    const Sources sources{sun(30, {1}), sky({2})};
    const Result many = run(scene, sources, spec_of_parts(Method::first_hits, 1 << 16));
    double light = 0, area = 0, naive = 0;
    for (std::size_t i = 0; i < 2; ++i) {
        const double lit = many.sun_shade.at(i, Q::sunlit_fraction_upper).mean;
        light += lit * many.sun_shade.at(i, Q::incident_upper_sunlit).mean;
        area += lit;
        naive += many.sun_shade.at(i, Q::incident_upper_sunlit).mean / 2;
    }
    EXPECT_GT(std::abs(naive / (light / area) - 1), .1);
    std::vector<double> few;
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
        RunSpec spec = spec_of_parts(Method::light_tracing, 128);
        spec.replicates = 8;
        spec.seed = seed;
        few.push_back(
            run(scene, sources, spec).groups.sun_shade.at(0, Q::incident_upper_sunlit).mean);
    }
    EXPECT_TRUE(agrees(measured(few), light / area, .02));
}

/// Hours in the sun, and light by area and time, against the light of each time.
TEST(SunShadeSums, WeighTimesByTheirSunlitArea) {
    const Scene scene = make_leafy_stand();
    const std::vector<TimeStep> time_steps{
        {"morning", {sun(60, {1, 2}), sky({.5, .2})}, "a", 3600, 0},
        {"noon", {sun(10, {3, 1}), sky({.7, .1})}, "b", 7200, 0},
        {"cloud", {sky({.4, .3})}, "c", 3600, 0},
        {"night", {}, "d", 1800, 0}};
    std::vector<Result> results;
    std::vector<SeriesSum> days;
    Listening events;
    events.time_step = [&](std::size_t, const Result& result, std::size_t) {
        results.push_back(result);
    };
    events.day = [&](std::size_t, const SeriesSum& sum) { days.push_back(sum); };
    RunSpec spec = spec_of_parts(Method::first_hits, 1 << 10);
    run_series(scene, time_steps, spec, {.listeners = {&events}});
    ASSERT_EQ(results.size(), 4U);
    ASSERT_EQ(days.size(), 1U);
    EXPECT_EQ(results[3].sun_shade.at(0, Q::incident_upper_shaded).mean, 0);
    EXPECT_TRUE(std::isnan(results[3].groups.sun_shade.at(0, Q::incident_upper_sunlit).mean));
    const SeriesSum& day = days.front();
    for (std::size_t organ = 0; organ < scene.organs().size(); ++organ) {
        double hours = 0, sunlit = 0, shaded = 0, direct = 0, dark_hours = 0;
        for (std::size_t t = 0; t < 4; ++t) {
            const SunShadeLight& parts = results[t].sun_shade;
            const double time = time_steps[t].seconds / 3600;
            const double lit = time * parts.at(organ, Q::sunlit_fraction_upper).mean;
            hours += lit;
            dark_hours += time - lit;
            sunlit += lit > 0 ? lit * parts.at(organ, Q::incident_upper_sunlit, 1).mean : 0;
            shaded += (time - lit) * parts.at(organ, Q::incident_upper_shaded, 1).mean;
            direct += 3600 * time * parts.at(organ, Q::incident_upper_direct, 1).mean;
        }
        EXPECT_NEAR(day.sun_shade.at(organ, Q::sunlit_fraction_upper).mean, hours, 1e-9);
        EXPECT_NEAR(
            day.sun_shade.at(organ, Q::incident_upper_direct, 1).mean, direct, 1e-9 * direct);
        EXPECT_NEAR(
            day.sun_shade.at(organ, Q::incident_upper_shaded, 1).mean, shaded / dark_hours, 1e-9);
        if (hours > 0) {
            EXPECT_NEAR(
                day.sun_shade.at(organ, Q::incident_upper_sunlit, 1).mean, sunlit / hours, 1e-9);
        }
    }
    EXPECT_NEAR(
        day.groups.sunlit_area[0].mean,
        day.groups.sunlit_fraction[0].mean * day.groups.groups[0].area, 1e-9);
}

}  // namespace
}  // namespace quasimc::test

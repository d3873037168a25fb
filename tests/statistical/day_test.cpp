// A clear day, hour by hour, from site and date to its sums.

#include <utility>
#include <vector>

#include "light/daylight/hour_light.h"
#include "light/daylight/period_light.h"
#include "quasimc/series.h"
#include "statistical/scenes.h"
#include "support/listening.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

constexpr std::size_t kBand = 0;
const Site kSite{.latitude_deg = 51.97, .longitude_deg = 5.67};

/// The hours of 21 June, and the total light on the horizontal, J m-2 of PAR.
struct ClearDay {
    std::vector<TimeStep> hours;
    double horizontal = 0;
};

ClearDay make_day() {
    ClearDay day;
    DaylightSources how;
    how.bands = {{400, 700}};
    for (int hour = 0; hour < 24; ++hour) {
        const SunPath path = sun_path(kSite, {2024, 6, 21, hour, 0, 0, 1}, 3600, 300);
        const HourLight light = clear_light(path, {});
        HourSources sources = make_hour_sources(make_hour_parts(path, light, how));
        day.hours.push_back({"hour", std::move(sources.sources), sources.directional_key, 3600, 0});
        day.horizontal += 3600 * (how.spectra.direct(how.bands[0]) * light.daylight.direct +
                                  how.spectra.diffuse(how.bands[0], light.daylight));
    }
    return day;
}

/// The cumulative light of a day: one sky, and all suns.
Sources cumulative_day() {
    DaylightSources how;
    how.bands = {{400, 700}};
    PeriodLight light(1);
    for (int hour = 0; hour < 24; ++hour) {
        const SunPath path = sun_path(kSite, {2024, 6, 21, hour, 0, 0, 1}, 3600, 300);
        const HourParts parts = make_hour_parts(path, clear_light(path, {}), how);
        for (const HourParts::Sun& sun : parts.suns) {
            light.add_sun(sun.to_sun, sun.facing);
        }
        if (parts.sky) {
            light.add_sky(*parts.sky, parts.sky_horizontal);
        }
    }
    return light.sources("sky", 1 / 24.0);
}

/// The sums of the day, and the errors of its brightest hours.
struct TracedDay {
    SeriesSum sum;
    std::vector<double> hourly_errors;  ///< relative, of organ 0
};

TracedDay trace_day(const Scene& scene, const ClearDay& day, const RunSpec& spec) {
    TracedDay traced;
    Listening events;
    events.time_step = [&](std::size_t, const Result& result, std::size_t) {
        const Estimate& e = result.at(0, Quantity::absorbed_flux, kBand);
        if (e.mean > 0) {
            traced.hourly_errors.push_back(e.standard_error / e.mean);
        }
    };
    traced.sum = run_series(scene, day.hours, spec, {.listeners = {&events}}).total;
    return traced;
}

class Day : public BothWays {};

TEST_P(Day, BringsToAHorizontalPlateTheLightOfItsHours) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("plate", "black", floor_of(0, 1, 0, 1, 0)));
    const Scene scene = std::move(builder).build();
    const ClearDay day = make_day();
    const TracedDay traced = trace_day(scene, day, spec_of(GetParam(), 1 << 11));
    EXPECT_EQ(traced.sum.seconds, 86400);
    EXPECT_TRUE(holds(
        {"clear day on a black plate, J m-2 of PAR", day.horizontal,
         resolution(2e-3, 5e-3) * day.horizontal},
        traced.sum.at(0, Quantity::incident_upper, kBand)));
}

/// Errors of hours are independent and partly cancel in the sum of a day.
TEST_P(Day, IsKnownBetterThanAnyOfItsHours) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .1, .1));
    add_leaves(builder, random_leaves(40, .3, 1, 3));
    const Scene scene = std::move(builder).build();
    const TracedDay traced = trace_day(scene, make_day(), spec_of(GetParam(), 1 << 10));
    const Estimate& sum = traced.sum.at(0, Quantity::absorbed_flux, kBand);
    ASSERT_GE(traced.hourly_errors.size(), 16U);
    for (const double error : traced.hourly_errors) {
        EXPECT_LT(sum.standard_error / sum.mean, error);
    }
}

/// Cumulative light of a day as one sky and all suns: one trace gives the sum over the hours.
TEST_P(Day, CumulativeLightIsTheSumOfItsHours) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .1, .1));
    add_leaves(builder, random_leaves(40, .3, 1, 3));
    const Scene scene = std::move(builder).build();
    const TracedDay by_hours = trace_day(scene, make_day(), spec_of(GetParam(), 1 << 12));
    ClearDay cumulative;
    cumulative.hours.push_back({"day", cumulative_day(), "cumulative", 86400, 0});
    const TracedDay at_once = trace_day(scene, cumulative, spec_of(GetParam(), 1 << 16));
    for (std::size_t i = 0; i < scene.organs().size(); ++i) {
        const Estimate& sum = by_hours.sum.at(i, Quantity::absorbed_flux, kBand);
        const Estimate& one = at_once.sum.at(i, Quantity::absorbed_flux, kBand);
        const Measured a = measured(sum, kReplicates);
        const Measured b = measured(one, kReplicates);
        const double level = sidak_level(kLevel, 80);
        EXPECT_TRUE(agrees(a, b, .15 * sum.mean, level)) << i;
        const Measured brighter{1.3 * b.mean, 1.3 * b.standard_error, b.replicates};
        EXPECT_FALSE(agrees(a, brighter, .15 * sum.mean, level)) << "a control";
    }
}

QUASIMC_BOTH_WAYS(Day);

}  // namespace
}  // namespace quasimc::test

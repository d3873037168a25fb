#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "light/daylight/hour_light.h"
#include "light/daylight/period_light.h"
#include "parts.h"
#include "quasimc/series.h"
#include "scenes.h"

namespace quasimc::bench {
namespace {

constexpr int kFirstHour = 5;
constexpr int kHours = 15;
constexpr double kHour = 3600;

/// 21 June at 52 degrees north, 5 to 20 h, without clouds: the sun every 5 minutes, and a sky.
struct ClearDay {
    std::vector<TimeStep> hours;
    std::vector<HourParts> parts;
};

ClearDay make_day() {
    const Site site{.latitude_deg = 51.97, .longitude_deg = 5.67};
    DaylightSources how;
    how.bands = {{400, 700}};
    ClearDay day;
    for (int i = 0; i < kHours; ++i) {
        const SunPath path = sun_path(site, {2024, 6, 21, kFirstHour + i, 0, 0, 1}, kHour, 300);
        day.parts.push_back(make_hour_parts(path, clear_light(path, {}), how));
        HourSources hour = make_hour_sources(day.parts.back());
        day.hours.push_back(
            {"hour", std::move(hour.sources), std::move(hour.directional_key), kHour, 0});
    }
    return day;
}

/// Cumulative light of all hours, as one time step.
TimeStep cumulative(const ClearDay& day) {
    PeriodLight light(1);
    for (const HourParts& hour : day.parts) {
        for (const HourParts::Sun& sun : hour.suns) {
            light.add_sun(sun.to_sun, sun.facing);
        }
        if (hour.sky) {
            light.add_sky(*hour.sky, hour.sky_horizontal);
        }
    }
    return {"day", light.sources("sky", 1.0 / kHours), "day", kHours * kHour, 0};
}

/// CPU time of all, including preparation, and the median over leaves of the relative error of
/// their absorbed flux.
struct Cost {
    double seconds = 0, error = 0;
};

Cost cost_of(const Scene& scene, const std::vector<TimeStep>& time_steps, const RunSpec& spec) {
    const double start = thread_seconds();
    const SeriesSum sum = run_series(scene, time_steps, spec).total;
    Cost cost{thread_seconds() - start, 0};
    std::vector<double> errors;
    for (std::size_t i = 0; i < scene.organs().size(); ++i) {
        const Estimate& e = sum.at(i, Quantity::absorbed_flux, 0);
        if (e.mean > 0) {
            errors.push_back(e.standard_error / e.mean);
        }
    }
    cost.error = median(errors);
    return cost;
}

void print_row(const std::string& what, const Cost& cost, const Cost& hour) {
    std::printf(
        "%-34s %9.3f %9.1f %9.2f\n", what.c_str(), cost.seconds, cost.seconds / hour.seconds,
        100 * cost.error);
}

void print_canopy(std::uint32_t leaves, Method from, const Effort& effort) {
    const Scene scene = make_canopy({leaves, {0.2}, 1});
    RunSpec spec;
    spec.method = from;
    spec.paths = effort.paths;
    spec.replicates = effort.replicates;
    spec.threads = 1;
    RunSpec thorough = spec;
    thorough.paths *= 16;
    const ClearDay day = make_day();
    const std::vector<TimeStep> one_hour{day.hours[kHours / 2]};
    const Cost hour = cost_of(scene, one_hour, spec);
    std::printf(
        "%u leaves, from %s, %llu paths x %u\n", leaves,
        from == Method::light_tracing ? "sources" : "lit surfaces",
        static_cast<unsigned long long>(spec.paths), spec.replicates);
    print_row("one hour (12 to 13 h)", hour, hour);
    print_row("15 hours", cost_of(scene, day.hours, spec), hour);
    print_row("cumulative", cost_of(scene, {cumulative(day)}, spec), hour);
    print_row("cumulative, 16 times the paths", cost_of(scene, {cumulative(day)}, thorough), hour);
}

}  // namespace

void print_day(const Effort& effort) {
    std::printf(
        "\n== A clear day in June: the sun every 5 minutes and a sky; one thread, from scratch\n"
        "%-34s %9s %9s %9s\n",
        "", "CPU s", "hours", "error %");
    print_canopy(500, Method::light_tracing, effort);
    print_canopy(10000, Method::light_tracing, effort);
    print_canopy(10000, Method::first_hits, effort);
}

}  // namespace quasimc::bench

#include "runfile/run_file_time.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/text.h"
#include "runfile/series_builder.h"

namespace quasimc {
namespace {

constexpr std::array<std::string_view, 3> kModels{"erbs", "reindl", "spitters"};
constexpr std::array<std::string_view, 3> kCumulativeSky{"none", "day", "period"};

SeriesRules read_rules(TimeContext& context) {
    TableReader& table = *context.table;
    SeriesRules rules;
    rules.how = read_daylight(context);
    rules.unit = read_light_unit(table);
    const std::string model = table.choice("diffuse_fraction", kModels).value_or("erbs");
    rules.model = model == "reindl"     ? DiffuseModel::reindl
                  : model == "spitters" ? DiffuseModel::spitters
                                        : DiffuseModel::erbs;
    rules.air.linke_turbidity =
        table.real("linke_turbidity", {1, 10}).value_or(rules.air.linke_turbidity);
    const std::string cumulative = table.choice("cumulative_sky", kCumulativeSky).value_or("none");
    rules.cumulative_sky = cumulative == "day"      ? CumulativeSky::day
                           : cumulative == "period" ? CumulativeSky::period
                                                    : CumulativeSky::none;
    rules.sun_step = 60 * table.real("sun_step_minutes", {0, 1440}).value_or(rules.sun_step / 60);
    constexpr double kShortestStep = 1;
    if (rules.sun_step > 0 && rules.sun_step < kShortestStep) {
        table.fault_at(
            "sun_step_minutes", "sun_step_minutes is less than a second",
            "each step is one sun position", "give 0 for a single sun position");
    }
    return rules;
}

/// Refuses a cumulative sky of instants, which have no length.
void check_cumulative_sky(
    const SeriesRules& rules, const std::vector<Interval>& intervals, TableReader& table) {
    const bool has_instant = std::any_of(
        intervals.begin(), intervals.end(), [](const auto& each) { return each.seconds == 0; });
    if (rules.cumulative_sky != CumulativeSky::none && has_instant) {
        table.fault_at(
            "cumulative_sky", "instants have no cumulative sky",
            "the sum over times depends on how long each of them is",
            "give duration_minutes, or leave cumulative_sky out");
    }
}

/// Hours by which a clock is ahead of the sun at a longitude, -12 to 12.
double ahead_of_sun(double utc_offset_hours, double longitude_deg) {
    return std::remainder(utc_offset_hours - longitude_deg / 15, 24);
}

/// Whether a clock is in civil use: from 1 hour behind the sun to 2.6 ahead (western Spain in
/// summer).
bool is_usual_clock(double ahead_hours) {
    return ahead_hours > -1.25 && ahead_hours < 2.75;
}

/// Warns of a clock that is far from the sun's: it is probably the clock of another site.
void check_clock(const std::vector<Interval>& intervals, TimeContext& context) {
    std::optional<double> offset = context.utc_offset_hours;
    if (!offset && !intervals.empty() && intervals.front().start.utc_offset_hours != 0) {
        offset = intervals.front().start.utc_offset_hours;
    }
    if (!offset || !context.site) {
        return;
    }
    constexpr double kFarHours = 4;
    const double latitude = context.site->latitude_deg;
    const double longitude = context.site->longitude_deg;
    const double ahead = ahead_of_sun(*offset, longitude);
    // UTC is used everywhere.
    const bool is_exchanged = *offset != 0 && std::abs(longitude) <= 90 && !is_usual_clock(ahead) &&
                              is_usual_clock(ahead_of_sun(*offset, latitude));
    if (std::abs(ahead) > kFarHours || is_exchanged) {
        context.table->warn(fmt::format(
            "the clock is {} hours ahead of UTC, the sun at longitude {} {:.1f} hours: {}",
            shortest(*offset), shortest(longitude), longitude / 15,
            is_exchanged ? "are latitude and longitude swapped?"
                         : "is the sign of the longitude right (east is positive)?"));
    }
}

std::vector<std::string> describe_rules(const SeriesRules& rules, bool is_measured) {
    const Site& site = rules.site;
    std::vector<std::string> words{fmt::format(
        "site: latitude {} deg, longitude {} deg (east positive), elevation {} m",
        shortest(site.latitude_deg), shortest(site.longitude_deg), shortest(site.elevation_m))};
    words.push_back(
        is_measured ? "daylight: measured; split into direct and diffuse by the readings or the "
                      "model of diffuse_fraction"
                    : fmt::format(
                          "daylight: clear sky (Ineichen and Perez 2002), Linke turbidity {}",
                          shortest(rules.air.linke_turbidity)));
    if (rules.cumulative_sky != CumulativeSky::none) {
        words.push_back(fmt::format(
            "sky: one cumulative sky of cells and all sun positions for {}; its light is the mean",
            rules.cumulative_sky == CumulativeSky::day ? "each day" : "the whole period"));
    }
    words.push_back(fmt::format(
        "sky: {}; without direct light {}; a sun position every {} min", rules.how.sky,
        rules.how.overcast_sky, shortest(rules.sun_step / 60)));
    return words;
}

/// Warns if it is night at all times.
void check_light(const TimeSeries& series, TableReader& table) {
    const auto plans = plan_series(series.time_steps);
    const bool is_dark =
        std::all_of(plans.begin(), plans.end(), [](const auto& plan) { return plan.factor == 0; });
    if (is_dark && !series.time_steps.empty()) {
        table.warn(
            "it is night at all time steps: the sun is below the horizon, and no lamp is on");
    }
}

/// Warns of daylight that is added to that of all time steps.
void check_daylight(const SourceList& lamps, TableReader& table) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < lamps.sources.size(); ++i) {
        if (!lamps.sources[i]->is_lamp() && !lamps.hours[i]) {
            names.push_back(fmt::format("'{}'", lamps.sources[i]->name()));
        }
    }
    if (!names.empty()) {
        table.warn(fmt::format(
            "sources are daylight as well: {} (beside the sun and the sky of the times they shine "
            "at every time step, by night too); keep lamps alone, or say on_hours",
            fmt::join(names, ", ")));
    }
}

}  // namespace

std::optional<TimeSeries> read_time(
    TableReader& top, const RunFileContext& run, const SourceList& lamps) {
    const Node* node = top.any("time");
    if (node == nullptr) {
        return std::nullopt;
    }
    TableReader table(*node, top.table_name("time"), top.reporter());
    TimeContext context{&table, &run, run.site, table.real("utc_offset_hours", {-14, 14})};
    const bool has_weather = table.any("weather") != nullptr;
    const std::vector<Interval> intervals =
        has_weather ? read_weather(context) : read_intervals(context);
    SeriesRules rules = read_rules(context);
    check_cumulative_sky(rules, intervals, table);
    table.finish();
    // The unreadable weather file could have given the site.
    const bool is_weather_broken = has_weather && intervals.empty();
    if (!context.site && top.any("site") == nullptr && !is_weather_broken) {
        const std::string site = top.table_name("site");
        top.fault(
            site + " is missing", "the sun's path depends on it",
            fmt::format("add {} with latitude_deg and longitude_deg", site));
    }
    if (table.failed() || !context.site) {
        return std::nullopt;
    }
    check_clock(intervals, context);
    rules.site = *context.site;
    rules.air.elevation_m = rules.site.elevation_m;
    rules.air.pressure_hpa = rules.site.pressure_hpa;
    SeriesBuilder builder(rules, lamps, top.reporter());
    bool is_measured = false;
    for (const Interval& interval : intervals) {
        is_measured = is_measured || interval.reading.has_value();
        builder.add(interval);
    }
    TimeSeries series = builder.finish();
    series.words = describe_rules(rules, is_measured);
    if (!table.failed()) {
        check_light(series, table);
        check_daylight(lamps, table);
    }
    return series;
}

}  // namespace quasimc

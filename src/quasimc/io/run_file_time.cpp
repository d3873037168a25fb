#include "quasimc/io/run_file_time.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "quasimc/base/text.h"
#include "quasimc/io/civil_time_text.h"
#include "quasimc/io/collapsed_moment.h"

namespace quasimc {
namespace {

constexpr std::array<std::string_view, 3> kModels{"erbs", "reindl", "spitters"};
constexpr std::array<std::string_view, 3> kCollapse{"none", "days", "period"};

/// How intervals become moments.
struct SeriesRules {
    Place place;
    DaylightSources how;
    LightUnit unit = LightUnit::full_spectrum;
    DiffuseModel model = DiffuseModel::erbs;
    ClearAir air;
    double sun_step = 300;  ///< seconds; 0: the sun stands still in the middle
    Collapse collapse = Collapse::none;
};

/// Builds the moments of a series, and gathers what is to be said of them.
class SeriesBuilder {
  public:
    SeriesBuilder(const SeriesRules& rules, const Sources& lamps, Reporter& reporter)
        : rules_(rules), lamps_(lamps), reporter_(reporter) {}

    void add(const Interval& interval) {
        const SunPath path =
            sun_path(rules_.place, interval.start, interval.seconds, rules_.sun_step);
        const HourLight light = interval.reading ? measured_light(
                                                       path, *interval.reading, rules_.unit,
                                                       rules_.model, rules_.how.spectra)
                                                 : clear_light(path, rules_.air);
        note(light.note, interval);
        if (light.fault != ReadingFault::none) {
            report(light.fault, path, interval);
            return;
        }
        HourParts parts = make_hour_parts(path, light, rules_.how);
        if (rules_.collapse == Collapse::none) {
            add_moment(interval, path, light.daylight, std::move(parts));
        } else {
            gather(interval, light.daylight, parts);
        }
    }

    TimeSeries finish() {
        close_gathered();
        series_.collapse = rules_.collapse;
        warn(
            direct_too_large_,
            "times have more direct light than light in all, by a tenth at "
            "most: it counts as direct");
        warn(
            sun_too_low_,
            "times have direct light with the sun too low for it: it counts as "
            "diffuse");
        return std::move(series_);
    }

  private:
    void add_moment(
        const Interval& interval, const SunPath& path, const Daylight& daylight, HourParts parts) {
        const std::size_t suns = parts.suns.size();
        HourSources hour = make_hour_sources(std::move(parts));
        Moment moment;
        moment.name = civil_time_text(interval.start);
        moment.sources = lamps_;
        std::move(hour.sources.begin(), hour.sources.end(), std::back_inserter(moment.sources));
        moment.shapes = std::move(hour.shapes);
        moment.seconds = interval.seconds;
        moment.day = day_of(interval.start);
        const SunPosition sun = path.middle();
        const Orientation& axes = rules_.how.orientation;
        series_.notes.push_back(
            {moment.name, moment.seconds, sun,
             axes.outward(axes.towards(sun.azimuth_deg, sun.elevation_deg)), daylight, suns});
        series_.moments.push_back(std::move(moment));
    }

    /// Adds to the moment that times are collapsed into, which a new day may end.
    void gather(const Interval& interval, const Daylight& daylight, const HourParts& parts) {
        const std::string date = date_text(interval.start);
        if (rules_.collapse == Collapse::days && date != last_date_) {
            close_gathered();
        }
        first_date_ = gathered_.empty() ? date : first_date_;
        last_date_ = date;
        gathered_.add(
            parts, daylight, interval.seconds, civil_time_text(interval.start),
            civil_time_text(later(interval.start, interval.seconds)));
    }
    void close_gathered() {
        if (gathered_.empty()) {
            return;
        }
        CollapsedMoment::Made made = gathered_.make(lamps_, series_.days.size());
        series_.days.push_back(
            first_date_ == last_date_ ? first_date_ : first_date_ + "/" + last_date_);
        series_.moments.push_back(std::move(made.moment));
        series_.notes.push_back(std::move(made.notes));
        gathered_ = CollapsedMoment(rules_.how.bands.size());
    }

    /// Times with the same note, and the first.
    struct Noted {
        std::size_t count = 0;
        std::string first;
    };

    void note(ReadingNote note, const Interval& interval) {
        if (note == ReadingNote::none) {
            return;
        }
        Noted& noted = note == ReadingNote::sun_too_low ? sun_too_low_ : direct_too_large_;
        noted.first = noted.count++ == 0 ? interval.place : noted.first;
    }
    void warn(const Noted& noted, std::string_view text) {
        if (noted.count > 0) {
            reporter_.warnings.push_back({noted.first, fmt::format("{} {}", noted.count, text)});
        }
    }

    void report(ReadingFault fault, const SunPath& path, const Interval& interval) {
        const std::string time = civil_time_text(interval.start);
        if (reporter_.is_full()) {
            return;
        }
        switch (fault) {
            case ReadingFault::incomplete:
                reporter_.faults.add(
                    {interval.place, fmt::format("the light at {} is not known", time), "",
                     "give global, or diffuse with direct_horizontal or beam_normal"});
                break;
            case ReadingFault::direct_exceeds_global:
                reporter_.faults.add(
                    {interval.place,
                     fmt::format("at {} there is more direct or diffuse light than global", time),
                     "direct and diffuse light on the horizontal are parts of the global", ""});
                break;
            default:
                reporter_.faults.add(
                    {interval.place,
                     fmt::format(
                         "light at {} with the sun {:.1f} degrees below the horizon", time,
                         -path.highest_deg()),
                     "time zone, place or stamp are wrong",
                     "check utc_offset_hours, [place] and stamp"});
        }
    }

    std::size_t day_of(const CivilTime& time) {
        const std::string date = date_text(time);
        if (series_.days.empty() || series_.days.back() != date) {
            series_.days.push_back(date);
        }
        return series_.days.size() - 1;
    }

    const SeriesRules& rules_;
    const Sources& lamps_;
    Reporter& reporter_;
    TimeSeries series_;
    CollapsedMoment gathered_{rules_.how.bands.size()};
    std::string first_date_, last_date_;  // of what is gathered
    Noted direct_too_large_, sun_too_low_;
};

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
    const std::string collapse = table.choice("collapse", kCollapse).value_or("none");
    rules.collapse = collapse == "days"     ? Collapse::days
                     : collapse == "period" ? Collapse::period
                                            : Collapse::none;
    rules.sun_step = 60 * table.real("sun_step_minutes", {0, 1440}).value_or(rules.sun_step / 60);
    return rules;
}

/// Instants have no length by which they could be summed.
void check_collapse(
    const SeriesRules& rules, const std::vector<Interval>& intervals, TableReader& table) {
    const bool has_instant = std::any_of(
        intervals.begin(), intervals.end(), [](const auto& each) { return each.seconds == 0; });
    if (rules.collapse != Collapse::none && has_instant) {
        table.fault_at(
            "collapse", "instants are to be collapsed",
            "the sum over times depends on how long each of them is",
            "give duration_minutes, or leave collapse out");
    }
}

/// A clock that is far from the sun's is probably that of another place.
void check_clock(TimeContext& context) {
    if (!context.utc_offset_hours || !context.place) {
        return;
    }
    constexpr double kFarHours = 4;
    const double sundial = context.place->longitude_deg / 15;
    double apart = std::abs(*context.utc_offset_hours - sundial);
    apart = std::min(apart, 24 - apart);
    if (apart > kFarHours) {
        context.table->reporter().warnings.push_back(
            {context.table->place(),
             fmt::format(
                 "the clock is {} hours ahead of UTC, the sun at longitude {} {:.1f} hours: is the "
                 "sign of the longitude right (east is positive)?",
                 shortest(*context.utc_offset_hours), shortest(context.place->longitude_deg),
                 sundial)});
    }
}

std::vector<std::string> words_of(const SeriesRules& rules, bool is_measured) {
    const Place& place = rules.place;
    std::vector<std::string> words{fmt::format(
        "latitude {} deg, longitude {} deg (east positive), elevation {} m",
        shortest(place.latitude_deg), shortest(place.longitude_deg), shortest(place.elevation_m))};
    words.push_back(
        is_measured ? "light: as measured; direct and diffuse told apart by the readings or the "
                      "model of diffuse_fraction"
                    : fmt::format(
                          "light: clear sky (Ineichen and Perez 2002), Linke turbidity {}",
                          shortest(rules.air.linke_turbidity)));
    if (rules.collapse != Collapse::none) {
        words.push_back(fmt::format(
            "collapse: {} one sky, of cells, and all of its suns; one trace gives the mean",
            rules.collapse == Collapse::days ? "each day is" : "the whole period is"));
    }
    words.push_back(fmt::format(
        "sky: {}; without direct light {}; sun every {} min", rules.how.sky, rules.how.overcast_sky,
        shortest(rules.sun_step / 60)));
    return words;
}

void check_light(const TimeSeries& series, TableReader& table) {
    const auto plans = plan_series(series.moments);
    const bool is_dark =
        std::all_of(plans.begin(), plans.end(), [](const auto& plan) { return plan.factor == 0; });
    if (is_dark && !series.moments.empty()) {
        table.fault(
            "it is dark at all these times", "the sun stays below the horizon, and no lamp shines",
            "choose other times, or add a lamp");
    }
}

}  // namespace

std::optional<TimeSeries> read_time(
    TableReader& top, const RunFileContext& run, const Sources& lamps) {
    const Node* node = top.any("time");
    if (node == nullptr) {
        return std::nullopt;
    }
    TableReader table(*node, "[time]", top.reporter());
    TimeContext context{&table, &run, run.place, table.real("utc_offset_hours", {-14, 14})};
    const bool has_weather = table.any("weather") != nullptr;
    const std::vector<Interval> intervals =
        has_weather ? read_weather(context) : read_intervals(context);
    SeriesRules rules = read_rules(context);
    check_collapse(rules, intervals, table);
    table.finish();
    if (!context.place && top.any("place") == nullptr) {
        top.fault(
            "the place is missing", "the sun's path depends on it",
            "add [place] with latitude_deg and longitude_deg");
    }
    if (table.failed() || !context.place) {
        return std::nullopt;
    }
    check_clock(context);
    rules.place = *context.place;
    rules.air.elevation_m = rules.place.elevation_m;
    rules.air.pressure_hpa = rules.place.pressure_hpa;
    SeriesBuilder builder(rules, lamps, top.reporter());
    bool is_measured = false;
    for (const Interval& interval : intervals) {
        is_measured = is_measured || interval.reading.has_value();
        builder.add(interval);
    }
    TimeSeries series = builder.finish();
    series.words = words_of(rules, is_measured);
    if (!table.failed()) {
        check_light(series, table);
    }
    return series;
}

}  // namespace quasimc

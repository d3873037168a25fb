#include "runfile/series_builder.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/text.h"
#include "quasimc/source.h"
#include "weather/civil_time_text.h"

namespace quasimc {
namespace {

/// Suggests the probable unit of light that is too bright by a ratio.
std::string_view unit_probably_meant(LightUnit unit, double ratio) {
    // On a clear day: PPFD in umol m-2 s-1 is twice the irradiance in W m-2, lux a hundred times.
    constexpr double kMaxPpfd = 4, kMaxLux = 200, kMaxHourly = 5000;
    const bool is_watts = unit == LightUnit::full_spectrum || unit == LightUnit::par;
    if (is_watts && ratio < kMaxPpfd) {
        return "is it in umol m-2 s-1 (unit = \"PPFD\") or kJ m-2 an hour (divide by 3.6), or are "
               "the clock or the stamp wrong?";
    }
    if (ratio < kMaxLux) {
        return "is it in lux (unit = \"lux\")?";
    }
    if (ratio < kMaxHourly) {
        return "is it in J m-2 an hour (divide by 3600)?";
    }
    return "is it in J m-2 a day (divide by 86400)?";
}

/// Texts of warnings about times with a note, which follow their number.
constexpr std::array<std::pair<ReadingNote, std::string_view>, 7> kNotes{{
    {ReadingNote::more_direct_than_global,
     "times have direct light above the total by up to 10 % or 5 W m-2; the total is used as "
     "direct"},
    {ReadingNote::more_diffuse_than_global,
     "times have diffuse light above the total by up to 10 % or 5 W m-2; the total is used as "
     "diffuse"},
    {ReadingNote::beam_too_strong,
     "times have a direct beam more than twice as strong as under a clear sky (linke_turbidity); "
     "the excess is used as diffuse"},
    {ReadingNote::more_direct_than_outside,
     "times have more direct light than the sun gives outside the atmosphere; all of it is used as "
     "diffuse; check the unit, the clock and the site"},
    {ReadingNote::negative_by_day,
     "times have negative light with the sun up, and 0 is used; if the number marks missing "
     "values, list it in missing_values"},
    {ReadingNote::light_at_night,
     "times have light with the sun more than 6 degrees below the horizon, and 0 is used (sensor "
     "offset)"},
    {ReadingNote::parts_disagree,
     "times have columns that disagree by more than 10 % and 20 W m-2; direct_horizontal is used "
     "for direct light, and the sum of direct and diffuse for global"},
}};

/// The smallest amount of a reading.
double lowest(const std::optional<Reading>& reading) {
    double low = 0;
    if (reading) {
        for (const auto& part :
             {reading->global, reading->direct_horizontal, reading->beam_normal,
              reading->diffuse}) {
            low = std::min(low, part.value_or(0));
        }
    }
    return low;
}

}  // namespace

SeriesBuilder::SeriesBuilder(const SeriesRules& rules, const SourceList& lamps, Reporter& reporter)
    : rules_(rules), lamps_(lamps), reporter_(reporter), gathered_(rules.how.bands.size()) {}

void SeriesBuilder::add(const Interval& interval) {
    const SunPath path = sun_path(rules_.site, interval.start, interval.seconds, rules_.sun_step);
    const HourLight light = interval.reading ? measured_light(
                                                   path, *interval.reading, rules_.unit,
                                                   rules_.model, rules_.how.spectra, rules_.air)
                                             : clear_light(path, rules_.air);
    if (light.note != ReadingNote::none) {
        noted_[light.note].add(interval);
    }
    if (light.fault != ReadingFault::none) {
        report(light.fault, path, interval);
        return;
    }
    if (interval.reading) {
        note_brightness(light.daylight, path, interval);
        note_darkness(light, path, interval);
    }
    HourParts parts = make_hour_parts(path, light, rules_.how);
    if (rules_.cumulative_sky == CumulativeSky::none) {
        add_time_step(interval, path, light.daylight, std::move(parts));
    } else {
        gather(interval, light.daylight, parts);
    }
}

TimeSeries SeriesBuilder::finish() {
    close_gathered();
    add_faults();
    series_.cumulative_sky = rules_.cumulative_sky;
    warn_of_brightness();
    warn_of_dim_light();
    for (const auto& [note, text] : kNotes) {
        warn(noted_[note], text);
    }
    return std::move(series_);
}

/// The sources of the file, each multiplied by the share of its hours.
template <typename Share>
Sources SeriesBuilder::dimmed_lamps(const Share& share) const {
    Sources sources;
    for (std::size_t i = 0; i < lamps_.sources.size(); ++i) {
        const auto& hours = lamps_.hours[i];
        sources.push_back(make_dimmed(lamps_.sources[i], hours ? share(*hours) : 1));
    }
    return sources;
}

void SeriesBuilder::add_time_step(
    const Interval& interval, const SunPath& path, const Daylight& daylight, HourParts parts) {
    const std::size_t suns = parts.suns.size();
    HourSources hour = make_hour_sources(std::move(parts));
    TimeStep time_step;
    time_step.name = civil_time_text(interval.start);
    time_step.sources = dimmed_lamps(
        [&](const DailyHours& hours) { return hours.share(interval.start, interval.seconds); });
    std::move(hour.sources.begin(), hour.sources.end(), std::back_inserter(time_step.sources));
    time_step.directional_key = std::move(hour.directional_key);
    time_step.seconds = interval.seconds;
    time_step.day = day_of(interval.start);
    const SunPosition sun = path.middle();
    const Orientation& axes = rules_.how.orientation;
    series_.notes.push_back(
        {time_step.name, time_step.seconds, sun,
         axes.outward(axes.towards(sun.azimuth_deg, sun.elevation_deg)), daylight, suns});
    series_.time_steps.push_back(std::move(time_step));
}

/// Adds an interval to the cumulative sky, which a new day may end.
void SeriesBuilder::gather(
    const Interval& interval, const Daylight& daylight, const HourParts& parts) {
    const std::string date = date_text(interval.start);
    if (rules_.cumulative_sky == CumulativeSky::day && date != last_date_) {
        close_gathered();
    }
    first_date_ = gathered_.empty() ? date : first_date_;
    last_date_ = date;
    gathered_times_.push_back({interval.start, interval.seconds});
    gathered_.add(
        parts, daylight, interval.seconds, civil_time_text(interval.start),
        civil_time_text(later(interval.start, interval.seconds)));
}

void SeriesBuilder::close_gathered() {
    if (gathered_.empty()) {
        return;
    }
    const Sources lamps = dimmed_lamps([&](const DailyHours& hours) {
        double lit = 0;
        double all = 0;
        for (const auto& [start, seconds] : gathered_times_) {
            lit += seconds * hours.share(start, seconds);
            all += seconds;
        }
        return lit / all;
    });
    CumulativeStep::Made made = gathered_.make(lamps, series_.days.size());
    series_.days.push_back(
        first_date_ == last_date_ ? first_date_ : first_date_ + "/" + last_date_);
    series_.time_steps.push_back(std::move(made.time_step));
    series_.notes.push_back(std::move(made.notes));
    gathered_ = CumulativeStep(rules_.how.bands.size());
    gathered_times_.clear();
}

void SeriesBuilder::warn(const Noted& noted, std::string_view text) {
    if (noted.count > 0) {
        constexpr std::string_view kMany = "times have";
        const bool is_one = noted.count == 1 && text.starts_with(kMany);
        reporter_.warnings.push_back(
            {noted.first, is_one ? fmt::format("1 time has{}", text.substr(kMany.size()))
                                 : fmt::format("{} {}", noted.count, text)});
    }
}

/// Records light that is brighter than outside the atmosphere. Reflecting clouds and slightly wrong
/// clocks cause small excesses for a short time.
void SeriesBuilder::note_brightness(
    const Daylight& daylight, const SunPath& path, const Interval& interval) {
    constexpr double kMuch = 1.25;
    constexpr double kFaint = 50;
    const double outside = path.outside() * path.mean_sine();
    if (!(daylight.global() > kMuch * outside + kFaint)) {
        return;
    }
    too_bright_.add(interval);
    if (daylight.global() > brightest_) {
        brightest_ = daylight.global();
        brightest_ratio_ = brightest_ / std::max(outside, kFaint);
    }
}

void SeriesBuilder::warn_of_brightness() {
    warn(
        too_bright_, fmt::format(
                         "times have more light than the sun gives outside the atmosphere, up to "
                         "{:.3g} times as much: {}",
                         brightest_ratio_, unit_probably_meant(rules_.unit, brightest_ratio_)));
}

void SeriesBuilder::note_darkness(
    const HourLight& light, const SunPath& path, const Interval& interval) {
    constexpr double kLowSine = 0.1, kHighDeg = 10;
    const bool is_high = std::all_of(
        path.steps.begin(), path.steps.end(),
        [](const SunPosition& sun) { return sun.elevation_deg > kHighDeg; });
    if (is_high && light.daylight.global() <= 0 && light.note == ReadingNote::none) {
        dark_by_day_.add(interval);
    }
    if (path.mean_sine() > kLowSine) {
        by_day_.add(interval);
        clearest_ =
            std::max(clearest_, light.daylight.global() / (path.outside() * path.mean_sine()));
        longest_ = std::max(longest_, interval.seconds);
    }
}

/// Warns of a probably wrong unit. Of the light outside the atmosphere, the darkest clouds transmit
/// about 5 % and a clear day 80 %, which reads as 0.3 % in MJ m-2 per hour and as 7 % in MJ m-2 per
/// day.
void SeriesBuilder::warn_of_dim_light() {
    warn(
        dark_by_day_,
        "times have no light with the sun more than 10 degrees up: is the clock wrong, or does 0 "
        "mark missing values (missing_values)?");
    constexpr double kLeast = 0.03, kMinOfDays = 0.07, kLong = 12 * 3600;
    if (clearest_ <= 0 || clearest_ >= (longest_ < kLong ? kLeast : kMinOfDays)) {
        return;
    }
    const bool is_watts = rules_.unit == LightUnit::full_spectrum || rules_.unit == LightUnit::par;
    const double hours = longest_ > 0 ? longest_ / 3600 : 1;
    warn(
        by_day_,
        fmt::format(
            "daytime values are at most {:.2g} % of the light outside the atmosphere, less than "
            "under the darkest clouds: {}",
            100 * clearest_,
            is_watts ? fmt::format(
                           "is it in MJ m-2 or kWh m-2, not in W m-2 (multiply by {:.4g} or {:.4g} "
                           "for {:.3g} hours)?",
                           1e3 / 3.6 / hours, 1e3 / hours, hours)
                     : "is the unit right?"));
}

/// Each kind of fault is reported once, at its first time.
void SeriesBuilder::report(ReadingFault fault, const SunPath& path, const Interval& interval) {
    auto& [first, count] = faults_[fault];
    if (count++ > 0) {
        return;
    }
    const std::string time = civil_time_text(interval.start);
    switch (fault) {
        case ReadingFault::incomplete:
            first = {
                interval.where, fmt::format("the light at {} is unknown", time), "",
                "give global, or diffuse with direct_horizontal or beam_normal"};
            break;
        case ReadingFault::negative:
            first = {
                interval.where, fmt::format("the light at {} is negative", time),
                "beyond the 20 W m-2 of sensor offsets at night, for which 0 is used",
                fmt::format(
                    "if it marks missing values, write missing_values = [\"{}\"]",
                    shortest(lowest(interval.reading)))};
            break;
        case ReadingFault::part_exceeds_global:
            first = {
                interval.where,
                fmt::format("at {} there is more direct or diffuse light than global", time),
                "direct and diffuse light on the horizontal can't exceed the global", ""};
            break;
        default:
            first = {
                interval.where,
                fmt::format(
                    "light at {} with the sun {:.1f} degrees below the horizon", time,
                    -path.highest_deg()),
                "the time zone, the site or stamp is wrong",
                fmt::format(
                    "check utc_offset_hours, {} (are latitude and longitude exchanged?) and stamp",
                    reporter_.table_name("site"))};
    }
}

void SeriesBuilder::add_faults() {
    for (auto& [kind, fault] : faults_) {
        auto& [first, count] = fault;
        if (count > 1) {
            first.suggestion += fmt::format(
                "{}{} with this error", first.suggestion.empty() ? "" : "; ",
                counted(count - 1, "more time"));
        }
        reporter_.faults.add(first);
    }
}

std::size_t SeriesBuilder::day_of(const CivilTime& time) {
    const std::string date = date_text(time);
    if (series_.days.empty() || series_.days.back() != date) {
        series_.days.push_back(date);
    }
    return series_.days.size() - 1;
}

}  // namespace quasimc

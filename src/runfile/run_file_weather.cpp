#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/text.h"
#include "runfile/run_file_time.h"
#include "weather/check_clock.h"
#include "weather/civil_time_text.h"

namespace quasimc {
namespace {

constexpr std::array<std::string_view, 2> kWeatherFormats{"epw", "csv"};
constexpr std::array<std::string_view, 3> kStamps{"end", "start", "middle"};
constexpr std::array<std::string_view, 2> kGaps{"fault", "skip"};

WeatherColumns read_columns(TimeContext& context) {
    TableReader& table = *context.table;
    WeatherColumns columns;
    columns.utc_offset_hours = context.utc_offset_hours;
    if (const auto stamp = table.choice("stamp", kStamps)) {
        columns.stamp = *stamp == "start"    ? WeatherColumns::Stamp::start
                        : *stamp == "middle" ? WeatherColumns::Stamp::middle
                                             : WeatherColumns::Stamp::end;
    }
    columns.seconds = 60 * table.real("step_minutes", {1, 1440}).value_or(0);
    if (const auto words = table.texts("missing_values")) {
        columns.missing.insert(words->begin(), words->end());
    }
    if (const auto year = table.integer("year", {kFirstYear, kLastYear})) {
        columns.year = static_cast<int>(*year);
    }
    if (const Node* node = table.any("columns")) {
        TableReader names(*node, table.what() + ": columns", table.reporter());
        columns.time = names.text("time").value_or("");
        columns.day_of_year = names.text("day_of_year").value_or("");
        columns.hour = names.text("hour").value_or("");
        columns.year_column = names.text("year").value_or("");
        for (const std::string_view part : weather_light_names()) {
            if (const auto name = names.text(part)) {
                columns.light[std::string(part)] = *name;
            }
        }
        names.finish();
    }
    return columns;
}

/// Uses the site and time zone of the file if the run file has none.
void settle_site(const WeatherFile& file, TimeContext& context) {
    TableReader& table = *context.table;
    if (file.utc_offset_hours && context.utc_offset_hours &&
        *file.utc_offset_hours != *context.utc_offset_hours) {
        table.fault_at(
            "utc_offset_hours",
            fmt::format("utc_offset_hours is {}", shortest(*context.utc_offset_hours)),
            fmt::format(
                "the weather file's clock is {} hours ahead of UTC",
                shortest(*file.utc_offset_hours)),
            "remove it");
    }
    if (file.utc_offset_hours) {
        context.utc_offset_hours = file.utc_offset_hours;
    } else if (!context.utc_offset_hours) {
        context.utc_offset_hours = file.records.front().start.utc_offset_hours;
    }
    if (file.site && context.site) {
        constexpr double kNear = 0.5;
        const bool is_far =
            std::abs(file.site->latitude_deg - context.site->latitude_deg) > kNear ||
            std::abs(file.site->longitude_deg - context.site->longitude_deg) > kNear;
        if (is_far) {
            table.warn_at(
                *table.any("weather"),
                fmt::format(
                    "the weather file is for latitude {}, longitude {}, which differs from {}",
                    shortest(file.site->latitude_deg), shortest(file.site->longitude_deg),
                    table.table_name("site")));
        }
    } else if (file.site) {
        context.site = file.site;
    }
}

/// Moves the records of a typical year to the first requested year, without 29 February if this
/// year has none. @returns number of omitted records in the requested days
std::size_t set_year(std::vector<WeatherRecord>& records, const TimeSpan& span) {
    for (WeatherRecord& record : records) {
        const bool next_year =
            span.last.year > span.first.year && std::pair(record.start.month, record.start.day) <
                                                    std::pair(span.first.month, span.first.day);
        record.start.year = span.first.year + (next_year ? 1 : 0);
    }
    std::size_t skipped = 0;
    std::erase_if(records, [&](const WeatherRecord& record) {
        if (record.start.day <= days_in_month(record.start.year, record.start.month)) {
            return false;
        }
        CivilTime march = record.start;
        march.month = 3;
        march.day = 1;
        march.hour = march.minute = 0;
        march.second = 0;
        const double begin = julian_day(march);
        skipped += begin > julian_day(span.first) && begin < julian_day(span.last) ? 1 : 0;
        return true;
    });
    std::stable_sort(records.begin(), records.end(), [](const auto& a, const auto& b) {
        return julian_day(a.start) < julian_day(b.start);
    });
    return skipped;
}

/// Whether a span of a typical year is at most 365 days.
bool fits_a_year(TableReader& table, const TimeSpan& span) {
    if (julian_day(span.last) - julian_day(span.first) <= 366) {
        return true;
    }
    table.fault("more than a year is requested", "the weather file contains a typical year");
    return false;
}

void warn_of_clock(const WeatherFile& file, TimeContext& context) {
    if (context.site) {
        if (const auto warning = warning_of_clock(file.records, *context.site)) {
            context.table->warn_at(*context.table->any("weather"), *warning);
        }
    }
}

/// The requested records. Missing records, and gaps between records, are faults or skipped.
class Selection {
  public:
    Selection(
        TimeContext& context, std::string file, const std::optional<TimeSpan>& span, bool skips)
        : context_(context), file_(std::move(file)), span_(span), skips_(skips) {
        if (span) {
            end_ = span->first;
        }
    }

    void add(const WeatherRecord& record) {
        note_hole(record.start, record);
        end_ = later(record.start, record.seconds);
        const TimeSpan::Part part = asked_part(record.start, record.seconds);
        if (part.seconds <= 0) {
            return;
        }
        found_ = true;
        cut_ += part.seconds < record.seconds ? 1 : 0;
        if (record.is_missing) {
            note_gap(record.line, fmt::format("no light at {}", civil_time_text(record.start)));
            return;
        }
        intervals_.push_back(
            {part.start, part.seconds, record.reading, fmt::format("{}:{}", file_, record.line)});
    }
    /// Called after the last record of the file.
    void finish(const WeatherRecord& last) {
        if (span_ && found_) {
            note_hole(span_->last, last);
        }
        if (cut_ > 0) {
            context_.table->warn_at(
                *context_.table->any("hours"),
                fmt::format("{} beyond these hours, used in proportion", counted(cut_, "record")));
        }
        if (gaps_ > 0) {
            context_.table->reporter().warnings.push_back(
                {first_gap_, fmt::format("{} left out; this is the first", counted(gaps_, "gap"))});
        }
    }
    [[nodiscard]] bool found() const { return found_; }
    [[nodiscard]] std::vector<Interval>& intervals() { return intervals_; }

  private:
    [[nodiscard]] TimeSpan::Part asked_part(const CivilTime& start, double seconds) const {
        return span_ ? span_->part_of(start, seconds) : TimeSpan::Part{start, seconds};
    }

    /// Reports requested steps between the last record and `next`.
    void note_hole(const CivilTime& next, const WeatherRecord& record) {
        constexpr double kMaxSteps = 1e6;
        const double length = end_ ? kSecondsADay * (julian_day(next) - julian_day(*end_)) : 0;
        if (length > kMaxSteps * record.seconds) {
            note_gap(record.line, "more than a million rows are missing");
            return;
        }
        // One second of tolerance for computed times.
        const auto steps = static_cast<int>(std::ceil((length - 1) / record.seconds));
        int asked = 0;
        std::string first;
        for (int i = 0; i < steps; ++i) {
            const CivilTime start = later(*end_, i * record.seconds);
            if (asked_part(start, record.seconds).seconds > 0) {
                first = asked++ == 0 ? civil_time_text(start) : first;
            }
        }
        if (asked > 0) {
            note_gap(record.line, fmt::format("{} rows are missing from {}", asked, first));
        }
    }

    void note_gap(std::uint32_t line, const std::string& text) {
        const std::string where = fmt::format("{}:{}", file_, line);
        if (!skips_) {
            context_.table->reporter().faults.add(
                {where, text, "daily sums need every hour", "gaps = \"skip\" leaves them out"});
        } else if (gaps_++ == 0) {
            first_gap_ = where + ": " + text;
        }
    }

    TimeContext& context_;
    std::string file_;
    const std::optional<TimeSpan>& span_;
    bool skips_;
    std::vector<Interval> intervals_;
    std::optional<CivilTime> end_;
    bool found_ = false;
    std::size_t gaps_ = 0, cut_ = 0;
    std::string first_gap_;
};

/// Reads and checks a weather file; empty after a fault.
std::optional<WeatherFile> read_file_of_weather(TimeContext& context, const std::string& path) {
    TableReader& table = *context.table;
    const bool looks_epw = path.ends_with(".epw") || path.ends_with(".EPW");
    const bool is_epw =
        table.choice("weather_format", kWeatherFormats).value_or(looks_epw ? "epw" : "csv") ==
        "epw";
    const Node* unit = table.any("unit");
    const auto* unit_name = unit != nullptr ? unit->as<std::string>() : nullptr;
    if (is_epw && unit_name != nullptr && *unit_name != "full_spectrum") {
        table.fault_at(
            "unit", "unit is given for an EPW file", "its irradiance is always in W m-2",
            "remove it");
    }
    const WeatherColumns columns = is_epw ? WeatherColumns() : read_columns(context);
    Reporter own{path, {}, {}};
    WeatherFile file;
    try {
        const std::string text = context.run->files->read(path);
        file = is_epw ? read_epw(text, own) : read_weather_csv(text, columns, own);
    } catch (const InputError& error) {
        own.faults.add(error);
    }
    const bool good = own.faults.empty();
    table.reporter().add(own);
    return good ? std::optional(std::move(file)) : std::nullopt;
}

}  // namespace

LightUnit read_light_unit(TableReader& table) {
    constexpr std::array<std::string_view, 4> kUnits{"full_spectrum", "PAR", "PPFD", "lux"};
    const std::string unit = table.choice("unit", kUnits).value_or("full_spectrum");
    return unit == "PAR"    ? LightUnit::par
           : unit == "PPFD" ? LightUnit::ppfd
           : unit == "lux"  ? LightUnit::lux
                            : LightUnit::full_spectrum;
}

std::vector<Interval> read_weather(TimeContext& context) {
    TableReader& table = *context.table;
    const std::string path = table.text("weather").value_or("");
    const bool skips = table.choice("gaps", kGaps).value_or("fault") == "skip";
    std::optional<WeatherFile> file = read_file_of_weather(context, path);
    if (!file) {
        static_cast<void>(read_span(context));
        return {};
    }
    settle_site(*file, context);
    const auto span = read_span(context);
    if (table.failed() || (span && file->is_typical_year && !fits_a_year(table, *span))) {
        return {};
    }
    if (span && file->is_typical_year) {
        const std::size_t skipped = set_year(file->records, *span);
        if (skipped > 0) {
            table.warn_at(
                *table.any("weather"),
                fmt::format(
                    "{} of 29 February left out: the requested year has none",
                    counted(skipped, "record")));
        }
    }
    warn_of_clock(*file, context);
    Selection selection(context, path, span, skips);
    for (const WeatherRecord& record : file->records) {
        if (table.reporter().is_full()) {
            return {};
        }
        selection.add(record);
    }
    if (!selection.found()) {
        table.fault_at(
            "weather", "the weather file has no light at the requested times",
            fmt::format(
                "it covers {} to {}", civil_time_text(file->records.front().start),
                civil_time_text(file->records.back().start)));
    }
    selection.finish(file->records.back());
    if (selection.found() && selection.intervals().empty() && !table.failed()) {
        table.fault_at("weather", "no requested time has light", "all are gaps (missing values)");
    }
    return std::move(selection.intervals());
}

}  // namespace quasimc

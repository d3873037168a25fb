#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/text.h"
#include "runfile/run_file_time.h"
#include "weather/civil_time_text.h"

namespace quasimc {
namespace {

constexpr std::size_t kMaxTimeSteps = 1000000;
/// Tolerance of computed times, which are accurate to 0.1 ms.
constexpr double kSlack = 1e-3;

double seconds_from(const CivilTime& a, const CivilTime& b) {
    return kSecondsADay * (julian_day(b) - julian_day(a));
}

/// A date of [time], at midnight; empty after a fault.
std::optional<CivilTime> read_date(TimeContext& context, std::string_view key) {
    const std::optional<std::string> text = context.table->time_text(key);
    if (!text) {
        return std::nullopt;
    }
    const Node* node = context.table->any(key);
    Reporter& reporter = context.table->reporter();
    const auto time = parse_civil_time(
        *text, context.utc_offset_hours.value_or(0), reporter.where(node->line), reporter.faults);
    if (time && (time->hour != 0 || time->minute != 0 || time->second != 0)) {
        context.table->fault_at(
            key, fmt::format("{} is a time", key), "it must be a date", "write it as 2024-06-21");
        return std::nullopt;
    }
    return time;
}

/// Reads hours = [from, to] of each day.
void read_hours(TableReader& table, TimeSpan& span) {
    const Node* node = table.any("hours");
    const auto hours = node ? table.interval_at("hours", *node, {0, 24}) : std::nullopt;
    span.from_hour = hours ? hours->low : 0;
    span.to_hour = hours ? hours->high : 24;
}

/// The amounts of light of `times`: lists, or numbers for all.
std::optional<std::vector<Reading>> read_amounts(TableReader& table, std::size_t count) {
    std::vector<Reading> readings(count);
    bool any = false;
    for (const std::string_view name : reading_names()) {
        const Node* node = table.any(name);
        if (node == nullptr) {
            continue;
        }
        any = true;
        const auto* list = node->as<Node::List>();
        if (list != nullptr && list->size() != count) {
            table.fault_at(
                name, fmt::format("{} has {} values", name, list->size()),
                fmt::format("there are {} time steps", count));
            continue;
        }
        for (std::size_t i = 0; i < count; ++i) {
            *part_of(readings[i], name) =
                table.real_at(name, list ? (*list)[i] : *node, TableReader::kLight);
        }
    }
    return any ? std::optional(readings) : std::nullopt;
}

/// Warns of overlapping intervals, whose light counts twice. @param intervals  sorted
void warn_of_overlaps(const std::vector<Interval>& intervals, TableReader& table) {
    std::size_t overlaps = 0;
    std::string first;
    for (std::size_t i = 1; i < intervals.size(); ++i) {
        const Interval& before = intervals[i - 1];
        const double apart = seconds_from(before.start, intervals[i].start);
        if (before.seconds > 0 && apart < before.seconds - kSlack) {
            first = overlaps++ == 0
                        ? fmt::format(
                              "{} begins {:.0f} min after {}, which lasts {} min",
                              civil_time_text(intervals[i].start), apart / 60,
                              civil_time_text(before.start), shortest(before.seconds / 60))
                        : first;
        }
    }
    if (overlaps > 0) {
        table.warn_at(
            *table.any("times"),
            fmt::format(
                "{} of the time steps overlap, and daily sums count their light twice: {}",
                overlaps, first));
    }
}

std::vector<Interval> read_times(TimeContext& context) {
    TableReader& table = *context.table;
    std::vector<Interval> intervals;
    const Node* node = table.any("times");
    const std::string where = table.reporter().where(node->line);
    const std::vector<std::string> texts =
        table.time_texts("times").value_or(std::vector<std::string>());
    const double minutes = table.real("duration_minutes", {0, 1440}).value_or(0);
    const auto readings = read_amounts(table, texts.size());
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const auto time =
            parse_civil_time(texts[i], context.utc_offset_hours, where, table.reporter().faults);
        if (time) {
            intervals.push_back(
                {*time, 60 * minutes,
                 readings ? std::optional((*readings)[i]) : std::optional<Reading>(),
                 fmt::format("{}: time '{}'", where, texts[i])});
        }
    }
    if (texts.empty() && !table.failed()) {
        table.fault_at("times", "times is empty");
    }
    std::stable_sort(intervals.begin(), intervals.end(), [](const auto& a, const auto& b) {
        return julian_day(a.start) < julian_day(b.start);
    });
    warn_of_overlaps(intervals, table);
    return intervals;
}

/// The steps of a span, day by day.
std::vector<Interval> steps_of(TimeContext& context, const TimeSpan& span, double step) {
    TableReader& table = *context.table;
    std::vector<Interval> intervals;
    const double days = std::round(seconds_from(span.first, span.last) / kSecondsADay);
    const double each = (span.to_hour - span.from_hour) * 3600 / step;
    if (days * each > static_cast<double>(kMaxTimeSteps)) {
        table.fault(fmt::format("{} times", days * each), fmt::format("at most {}", kMaxTimeSteps));
        return intervals;
    }
    const auto a_day = static_cast<int>(std::ceil(each - kSlack));
    for (int i = 0; i < static_cast<int>(days) * a_day; ++i) {
        const int day = i / a_day;
        const double at = span.from_hour * 3600 + i % a_day * step;
        const CivilTime start = later(span.first, day * kSecondsADay + at);
        intervals.push_back(
            {start, std::min(step, span.to_hour * 3600 - at), std::nullopt, table.where()});
    }
    return intervals;
}

}  // namespace

TimeSpan::Part TimeSpan::part_of(const CivilTime& start, double seconds) const {
    const CivilTime middle = later(start, 0.5 * seconds);
    if (seconds_from(first, middle) < 0 || seconds_from(middle, last) <= 0) {
        return {start, 0};
    }
    // Without hours, the whole day of the middle.
    CivilTime midnight = middle;
    midnight.hour = midnight.minute = 0;
    midnight.second = 0;
    const double begin = seconds_from(midnight, start);
    const double from = from_hour > 0 ? std::max(begin, 3600 * from_hour) : begin;
    const double end = begin + seconds;
    const double to = to_hour < 24 ? std::min(end, 3600 * to_hour) : end;
    if (to - from >= seconds - kSlack) {
        return {start, seconds};
    }
    const double length = std::round((to - from) / kSlack) * kSlack;
    return {later(midnight, from), std::max(0.0, length)};
}

std::optional<TimeSpan> read_span(TimeContext& context) {
    TableReader& table = *context.table;
    const bool has_day = table.any("day") != nullptr;
    const bool has_from = table.any("from") != nullptr, has_to = table.any("to") != nullptr;
    const bool has_period = has_from || has_to;
    if (!has_day && !has_period) {
        return std::nullopt;
    }
    if (has_day && has_period) {
        table.fault("both day and from, to are given", "", "give one of them");
        static_cast<void>(table.any("hours"));  // marks the key as known
        return std::nullopt;
    }
    TimeSpan span;
    const auto first = read_date(context, has_day ? "day" : "from");
    const auto last = has_day ? first : read_date(context, "to");
    if (!has_day) {
        static_cast<void>(table.required("from", first));
        static_cast<void>(table.required("to", last));
    }
    read_hours(table, span);
    if (!first || !last) {
        return std::nullopt;
    }
    if (seconds_from(*first, *last) < 0) {
        table.fault_at("to", "to is before from");
        return std::nullopt;
    }
    span.first = *first;
    span.last = later(*last, kSecondsADay);
    return span;
}

std::vector<Interval> read_intervals(TimeContext& context) {
    TableReader& table = *context.table;
    const bool has_times = table.any("times") != nullptr;
    const bool has_span =
        table.any("day") != nullptr || table.any("from") != nullptr || table.any("to") != nullptr;
    if (has_times == has_span) {
        table.fault(
            has_times ? "both times and a day or period are given" : "the times are missing", "",
            "give times, or day, or from and to, or a weather file");
        return {};
    }
    if (!has_times && !context.utc_offset_hours) {
        if (table.any("utc_offset_hours") == nullptr) {
            table.missing(
                "utc_offset_hours",
                "write the clock's offset from UTC, 2 for central European summer time");
        }
        return {};
    }
    if (has_times) {
        return read_times(context);
    }
    const double minutes = table.real("step_minutes", {1, 1440}).value_or(60);
    const auto span = read_span(context);
    return span ? steps_of(context, *span, 60 * minutes) : std::vector<Interval>();
}

}  // namespace quasimc

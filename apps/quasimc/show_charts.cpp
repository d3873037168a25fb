#include "show_charts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "io/results/read_rounds.h"
#include "io/runfile/civil_time_text.h"
#include "organ_chart.h"
#include "quasimc/sun.h"

namespace {

using quasimc::Chart;
using quasimc::ChartMarks;
using quasimc::ChartPoint;
using quasimc::ChartSeries;
using quasimc::Estimate;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr quasimc::Rgb kBlue{0, 114, 178};
constexpr quasimc::Rgb kOrange{213, 94, 0};

std::string with_unit(const std::string& name, const std::string& unit) {
    return unit.empty() ? name : fmt::format("{} ({})", name, unit);
}

/// The least and the largest of what is finite.
struct Span {
    double low = std::numeric_limits<double>::infinity(), high = -low;

    void add(double value) {
        if (std::isfinite(value)) {
            low = std::min(low, value);
            high = std::max(high, value);
        }
    }
};

/// Means of the organs of each of twenty layers, weighted with their areas.
ChartSeries layer_means(
    const ChartSeries& organs, const std::vector<double>& areas, const Span& heights) {
    constexpr std::size_t kLayers = 20;
    std::vector<double> light(kLayers), area(kLayers);
    for (std::size_t i = 0; i < organs.points.size(); ++i) {
        const ChartPoint& p = organs.points[i];
        if (std::isfinite(p.x) && std::isfinite(p.y) && heights.high > heights.low) {
            const double part = (p.y - heights.low) / (heights.high - heights.low);
            const auto layer = std::min(kLayers - 1, static_cast<std::size_t>(part * kLayers));
            light[layer] += areas[i] * p.x;
            area[layer] += areas[i];
        }
    }
    ChartSeries means{ChartMarks::line, kOrange, {}};
    for (std::size_t i = 0; i < kLayers; ++i) {
        if (area[i] > 0) {
            const double middle = heights.low + (static_cast<double>(i) + 0.5) *
                                                    (heights.high - heights.low) / kLayers;
            means.points.push_back({light[i] / area[i], middle, kNone, kNone, kNone, kNone});
        }
    }
    return means;
}

Chart profile(const ShownRun& shown, const ShownValues& values) {
    const quasimc::Scene& scene = shown.run.scene;
    ChartSeries organs{ChartMarks::dots, kBlue, {}};
    std::vector<double> areas;
    Span light, heights;
    light.add(0);
    for (std::size_t i = 0; i < values.estimates.size(); ++i) {
        const quasimc::Organ& organ = scene.organs()[i];
        const Estimate& e = values.estimates[i];
        if (!organ.is_ground) {
            organs.points.push_back({e.mean, height_of(scene, organ), e.low, e.high, kNone, kNone});
            areas.push_back(organ.area);
            light.add(e.mean);
            heights.add(organs.points.back().y);
        }
    }
    ChartSeries means = layer_means(organs, areas, heights);
    Chart chart;
    chart.subtitle = "organs with 95 % intervals; the line is the mean of a layer by area";
    chart.x = quasimc::axis_about(light.low, light.high, with_unit(values.name, values.unit));
    chart.y =
        quasimc::axis_about(heights.low, heights.high, with_unit("height", scene.length_unit()));
    chart.series = {std::move(organs), std::move(means)};
    return chart;
}

Chart histogram(const ShownRun& shown, const ShownValues& values) {
    constexpr std::size_t kColumns = 30;
    Span light;
    light.add(0);
    for (const Estimate& e : values.estimates) {
        light.add(e.mean);
    }
    Chart chart;
    chart.subtitle = "part of the one-sided area of all organs";
    chart.x = quasimc::axis_about(light.low, light.high, with_unit(values.name, values.unit));
    std::vector<double> areas(kColumns);
    double all = 0;
    for (std::size_t i = 0; i < values.estimates.size(); ++i) {
        const quasimc::Organ& organ = shown.run.scene.organs()[i];
        const double part = chart.x.part(values.estimates[i].mean);
        if (!organ.is_ground && std::isfinite(part)) {
            // What lies on the border of two columns, as a fraction of 1 does, belongs to the
            // lower.
            const double column = std::ceil(part * kColumns - 1e-9) - 1;
            areas[static_cast<std::size_t>(std::max(0.0, column))] += organ.area;
            all += organ.area;
        }
    }
    ChartSeries columns{ChartMarks::columns, kBlue, {}};
    Span parts;
    parts.add(0);
    for (std::size_t i = 0; i < kColumns; ++i) {
        const double middle =
            chart.x.low + (static_cast<double>(i) + 0.5) * (chart.x.high - chart.x.low) / kColumns;
        const double part = all > 0 ? 100 * areas[i] / all : 0;
        columns.points.push_back({middle, part, kNone, kNone, kNone, kNone});
        parts.add(part);
    }
    chart.y = quasimc::axis_about(0, parts.high, "area (%)");
    chart.series = {std::move(columns)};
    return chart;
}

/// Hours from the beginning of a day to a time, "2024-06-21T12:00+02:00"; NaN if it is none.
double hours_of(const std::string& time, const std::string& first_day) {
    quasimc::Faults faults;
    const auto at = quasimc::parse_civil_time(time, std::nullopt, "", faults);
    const std::string offset = time.size() > 16 ? time.substr(16) : "Z";
    const auto start =
        quasimc::parse_civil_time(first_day + "T00:00" + offset, std::nullopt, "", faults);
    return at && start ? 24 * (quasimc::julian_day(*at) - quasimc::julian_day(*start)) : kNone;
}

Chart course(const ShownRun& shown, const std::string& path, const ValueChoice& choice) {
    const ShownCourse read = read_shown_course(shown, path, choice);
    const std::string day = read.times.front().place.label.substr(0, 10);
    ChartSeries line{ChartMarks::line, kBlue, {}};
    Span hours, light;
    light.add(0);
    for (const quasimc::PlacedRows& time : read.times) {
        const Estimate& e = time.columns.front().front();
        const double hour = hours_of(time.place.label, day);
        line.points.push_back({hour, e.mean, kNone, kNone, e.low, e.high});
        hours.add(hour);
        light.add(e.mean);
    }
    Chart chart;
    chart.subtitle = "all organs together, with 95 % intervals";
    chart.x = quasimc::axis_about(hours.low, hours.high, fmt::format("hours of {}", day));
    chart.y = quasimc::axis_about(light.low, light.high, with_unit(read.name, read.unit));
    chart.series = {std::move(line)};
    return chart;
}

Chart convergence(const ShownRun& shown, const std::string& path, const ValueChoice& choice) {
    const auto point = shown.run.sweep ? std::optional(shown.run.point) : std::nullopt;
    const std::vector<quasimc::RoundErrors> rounds =
        quasimc::read_rounds(shown.result_text, path, point, choice.time);
    if (rounds.empty()) {
        throw quasimc::InputError(
            {{path, "tells of no rounds", "the run had one",
              "set target_error or max_paths in [run]"}});
    }
    ChartSeries worst{ChartMarks::line, kOrange, {}, "worst organ"};
    ChartSeries median{ChartMarks::line, kBlue, {}, "median"};
    Span errors, paths;
    for (const quasimc::RoundErrors& round : rounds) {
        const auto x = static_cast<double>(round.paths);
        paths.add(x);
        for (const auto& [series, error] :
             {std::pair(&worst, round.worst), std::pair(&median, round.median)}) {
            if (error > 0) {
                series->points.push_back({x, 100 * error, kNone, kNone, kNone, kNone});
                errors.add(100 * error);
            }
        }
    }
    Chart chart;
    chart.subtitle = "of the flux that organs absorb, after each round";
    chart.x = quasimc::logarithmic_axis_about(paths.low, paths.high, "paths of each replicate");
    chart.y =
        quasimc::logarithmic_axis_about(errors.low, errors.high, "relative standard error (%)");
    chart.series = {std::move(worst), std::move(median)};
    return chart;
}

Chart organs(
    const ChartChoice& kind,
    const ShownRun& shown,
    const std::string& path,
    const ValueChoice& choice) {
    std::vector<NamedRun> runs{{&shown, path}};
    std::optional<ShownRun> other;
    if (!kind.with.empty()) {
        other = read_shown_run(kind.with, choice.point);
        if (other->result_text.empty()) {
            throw quasimc::InputError(
                {{kind.with, "is no result", "a chart shows light",
                  "give what `quasimc run --json` wrote"}});
        }
        runs.push_back({&*other, kind.with});
    }
    return organ_chart(runs, choice, kind.aspect);
}

}  // namespace

ChartKind chart_kind(const std::string& name) {
    return name == "profile"     ? ChartKind::profile
           : name == "histogram" ? ChartKind::histogram
           : name == "organs"    ? ChartKind::organs
           : name == "course"    ? ChartKind::course
                                 : ChartKind::convergence;
}

Chart make_chart(
    const ChartChoice& kind,
    const ShownRun& shown,
    const std::string& path,
    const ValueChoice& choice) {
    if (shown.result_text.empty()) {
        throw quasimc::InputError(
            {{path, "is no result", "a chart shows light",
              "give what `quasimc run --json` wrote"}});
    }
    Chart chart;
    if (kind.kind == ChartKind::course) {
        chart = course(shown, path, choice);
    } else if (kind.kind == ChartKind::convergence) {
        chart = convergence(shown, path, choice);
    } else if (kind.kind == ChartKind::organs) {
        chart = organs(kind, shown, path, choice);
    } else {
        const ShownValues values = read_shown_values(shown, path, choice);
        chart = kind.kind == ChartKind::profile ? profile(shown, values) : histogram(shown, values);
        chart.subtitle += values.when.empty() ? "" : "; " + values.when;
    }
    chart.title = title_of(shown.run);
    chart.subtitle = kind.note.empty() ? chart.subtitle : kind.note;
    return chart;
}

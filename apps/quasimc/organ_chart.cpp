#include "organ_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "view/exponential_fit.h"

namespace {

using quasimc::ChartMarks;
using quasimc::ChartSeries;
using quasimc::Estimate;

constexpr double kNoEnd = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<std::pair<quasimc::Rgb, quasimc::Rgb>, 2> kPointsAndCurves{
    {{{0, 114, 178}, {0, 60, 100}}, {{230, 159, 0}, {170, 70, 0}}}};

/// Organs from the top down, without the ground and what has no area.
std::vector<std::size_t> from_the_top(const quasimc::Scene& scene) {
    std::vector<std::pair<double, std::size_t>> heights;
    for (std::size_t i = 0; i < scene.organs().size(); ++i) {
        const quasimc::Organ& organ = scene.organs()[i];
        const double height = height_of(scene, organ);
        if (!organ.is_ground && std::isfinite(height)) {
            heights.emplace_back(-height, i);
        }
    }
    std::sort(heights.begin(), heights.end());
    std::vector<std::size_t> order;
    order.reserve(heights.size());
    for (const auto& [height, organ] : heights) {
        order.push_back(organ);
    }
    return order;
}

/// "monte_carlo.json": "monte carlo".
std::string name_of_file(const std::string& path) {
    std::string name = std::filesystem::path(path).stem().string();
    std::replace(name.begin(), name.end(), '_', ' ');
    return name;
}

/// Dots, and the curve through them if there is one.
struct OrganSeries {
    ChartSeries dots;
    std::optional<ChartSeries> curve;
};

ChartSeries curve_of(
    const quasimc::ExponentialCurve& fit, std::size_t count, const quasimc::Rgb& color) {
    constexpr std::size_t kSteps = 200;
    ChartSeries curve{
        ChartMarks::curve, color, {}, fmt::format("{:.3g} exp({:.3g} n)", fit.amount, -fit.rate)};
    for (std::size_t i = 0; i <= kSteps; ++i) {
        const double x = 1 + static_cast<double>((count - 1) * i) / kSteps;
        curve.points.push_back({x, fit.at(x), kNoEnd, kNoEnd, kNoEnd, kNoEnd});
    }
    return curve;
}

OrganSeries series_of(
    const NamedRun& run, const ShownValues& values, OrganAspect aspect, std::size_t number) {
    const auto& [color, curve_color] = kPointsAndCurves.at(number);
    const double replicates = run.shown->run.spec.replicates;
    OrganSeries series{{ChartMarks::dots, color, {}, ""}, {}};
    std::vector<double> x, y;
    for (const std::size_t organ : from_the_top(run.shown->run.scene)) {
        const Estimate& e = values.estimates[organ];
        x.push_back(static_cast<double>(x.size() + 1));
        if (aspect == OrganAspect::value) {
            y.push_back(e.mean);
            series.dots.points.push_back({x.back(), e.mean, kNoEnd, kNoEnd, e.low, e.high});
        } else {
            y.push_back(replicates * e.standard_error * e.standard_error);
            series.dots.points.push_back({x.back(), y.back(), kNoEnd, kNoEnd, kNoEnd, kNoEnd});
        }
    }
    double sum = 0;
    for (const double value : y) {
        sum += value;
    }
    series.dots.name =
        fmt::format("{}: mean {:.4g}", name_of_file(run.path), sum / static_cast<double>(y.size()));
    if (const auto fit = quasimc::fit_exponential(x, y)) {
        series.curve = curve_of(*fit, x.size(), curve_color);
    }
    return series;
}

/// Dots of all first, curves on top of them.
std::vector<ChartSeries> in_order(std::vector<OrganSeries> all) {
    std::vector<ChartSeries> series;
    series.reserve(2 * all.size());
    for (OrganSeries& each : all) {
        series.push_back(std::move(each.dots));
    }
    for (OrganSeries& each : all) {
        if (each.curve) {
            series.push_back(std::move(*each.curve));
        }
    }
    return series;
}

quasimc::Axis axis_of(const std::vector<ChartSeries>& series, std::string title) {
    double high = 0, low = 0;
    for (const ChartSeries& each : series) {
        for (const quasimc::ChartPoint& point : each.points) {
            high = std::isfinite(point.y) ? std::max(high, point.y) : high;
            low = std::isfinite(point.y) ? std::min(low, point.y) : low;
        }
    }
    return quasimc::axis_about(low, high, std::move(title));
}

}  // namespace

double height_of(const quasimc::Scene& scene, const quasimc::Organ& organ) {
    double moment = 0, area = 0;
    for (const quasimc::Triangle& t : scene.triangles_of(organ)) {
        const double own = quasimc::area(t);
        moment += own * (t[0].z + t[1].z + t[2].z) / 3;
        area += own;
    }
    return area > 0 ? moment / area : kNoEnd;
}

quasimc::Chart organ_chart(
    const std::vector<NamedRun>& runs, const ValueChoice& choice, OrganAspect aspect) {
    const std::size_t organs = runs.front().shown->run.scene.organs().size();
    std::vector<OrganSeries> all;
    std::string name, unit;
    for (const NamedRun& run : runs) {
        if (run.shown->run.scene.organs().size() != organs) {
            throw quasimc::InputError(
                {{run.path, "has another number of organs", "organs are compared one by one",
                  "give results of one scene"}});
        }
        const ShownValues values = read_shown_values(*run.shown, run.path, choice);
        name = values.name;
        unit = values.unit;
        all.push_back(series_of(run, values, aspect, all.size()));
    }
    if (aspect == OrganAspect::variance) {
        name = "variance of " + name;
        unit = unit.empty() ? "" : fmt::format("({})²", unit);
    }
    quasimc::Chart chart;
    chart.series = in_order(std::move(all));
    chart.subtitle = aspect == OrganAspect::value ? "organs with 95 % intervals, and fitted curves"
                                                  : "between replicates, and fitted curves";
    chart.x = quasimc::axis_about(0, static_cast<double>(organs), "organ n, counted from the top");
    chart.y = axis_of(chart.series, unit.empty() ? name : fmt::format("{} ({})", name, unit));
    return chart;
}

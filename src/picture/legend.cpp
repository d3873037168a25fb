#include "picture/legend.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace quasimc {
namespace {

constexpr double kTextSize = 13;
constexpr double kBarWidth = 18;

/// The 99.5 % quantile of values, weighted by area; the maximum for few organs.
double usual_most(const std::vector<double>& values, const std::vector<double>& areas) {
    std::vector<std::size_t> order;
    double area = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (std::isfinite(values[i])) {
            order.push_back(i);
            area += areas[i];
        }
    }
    if (order.empty()) {
        return std::nan("");
    }
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return values[a] < values[b];
    });
    double above = 0;
    for (std::size_t i = order.size(); i-- > 0;) {
        above += areas[order[i]];
        if (above > area / 200) {
            return values[order[i]];
        }
    }
    return values[order.back()];
}

void draw_bar(
    Canvas& canvas, const Legend& legend, const PixelPoint& corner, double height, double s) {
    const int steps = static_cast<int>(height);
    for (int i = 0; i < steps; ++i) {
        const double part = 1 - (i + 0.5) / steps;
        // Each overlaps the next one, so that no seam shows between them.
        canvas.rectangle(
            {corner.x, corner.y + i}, kBarWidth * s, i + 1 < steps ? 2 : 1,
            color_at(*legend.map, part));
    }
    const double bar = corner.x + kBarWidth * s;
    if (legend.is_exceeded) {
        const Rgb last = color_at(*legend.map, 1);
        canvas.polygon(
            std::array<PixelPoint, 3>{
                {{corner.x, corner.y},
                 {bar, corner.y},
                 {0.5 * (corner.x + bar), corner.y - 12 * s}}},
            last);
    }
    const std::vector<double> ticks = ticks_between(legend.low, legend.high, 6);
    const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1;
    for (const double tick : ticks) {
        const double y = corner.y + height * (1 - legend.part(tick));
        canvas.line({bar, y}, {bar + 5 * s, y}, {30, 30, 30}, s);
        canvas.text({bar + 8 * s, y + 4.5 * s}, tick_text(tick, step), {.size = kTextSize * s});
    }
}

void draw_category(
    Canvas& canvas, const PixelPoint& corner, const std::string& name, const Rgb& color, double s) {
    canvas.rectangle(corner, kBarWidth * s, 12 * s, color);
    canvas.text({corner.x + 26 * s, corner.y + 11 * s}, name, {.size = kTextSize * s});
}

}  // namespace

double round_number_below(double most) {
    const double power = std::pow(10, std::floor(std::log10(most)));
    return (5 * power <= most ? 5 : 2 * power <= most ? 2 : 1) * power;
}

std::vector<double> ticks_between(double low, double high, int about) {
    const double step = round_number_below((high - low) / about * 1.5);
    std::vector<double> ticks;
    const double first = std::ceil(low / step - 1e-9), last = high / step + 1e-9;
    for (int i = 0; first + i <= last; ++i) {
        ticks.push_back((first + i) * step);
    }
    return ticks;
}

std::string tick_text(double tick, double step) {
    const double large = std::max(std::abs(tick), step);
    if (large >= 1e6 || step < 1e-4) {
        const int digits =
            static_cast<int>(std::floor(std::log10(large)) - std::floor(std::log10(step)));
        return tick == 0 ? "0" : fmt::format("{:.{}e}", tick, std::max(0, digits));
    }
    const int digits = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
    return fmt::format("{:.{}f}", tick == 0 ? 0.0 : tick, digits);
}

Legend scale_of(
    const std::vector<double>& values,
    const std::vector<double>& areas,
    const ColorMap& map,
    std::pair<double, double> range) {
    Legend legend;
    legend.map = &map;
    double least = 0, most = -1;
    for (const double value : values) {
        legend.has_unknown = legend.has_unknown || !std::isfinite(value);
        if (std::isfinite(value)) {
            least = std::min(least, value);
            most = std::max(most, value);
        }
    }
    if (range.first < range.second) {
        legend.low = range.first;
        legend.high = range.second;
    } else {
        const double usual = usual_most(values, areas);
        legend.low = least;
        legend.high = usual > least ? usual : most > least ? most : least + 1;
    }
    legend.is_exceeded = most > legend.high;
    return legend;
}

std::vector<Rgb> colors_of(const std::vector<double>& values, const Legend& legend) {
    std::vector<Rgb> colors;
    colors.reserve(values.size());
    for (const double value : values) {
        colors.push_back(color_at(*legend.map, legend.part(value)));
    }
    return colors;
}

void draw_legend(
    Canvas& canvas, const Legend& legend, const PixelPoint& corner, double height, double scale) {
    double y = corner.y;
    if (legend.map != nullptr) {
        draw_bar(canvas, legend, {corner.x, y}, height, scale);
        y += height + 14 * scale;
        if (legend.has_unknown) {
            draw_category(canvas, {corner.x, y}, "no value", kNoValue, scale);
        }
        return;
    }
    const double row = 20 * scale;
    const auto room = static_cast<std::size_t>(std::max(1.0, height / row));
    for (std::size_t i = 0; i < legend.categories.size(); ++i, y += row) {
        if (i + 1 >= room && legend.categories.size() > room) {
            canvas.text(
                {corner.x, y + 11 * scale},
                fmt::format("and {} more", legend.categories.size() - i),
                {.size = kTextSize * scale});
            return;
        }
        const auto& [name, color] = legend.categories[i];
        draw_category(canvas, {corner.x, y}, name, color, scale);
    }
}

}  // namespace quasimc

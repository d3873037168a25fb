#include "picture/legend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

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

/// A number of small raised digits.
std::string superscript(int number) {
    constexpr std::array<const char*, 10> kDigits{"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                                  "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    std::string text = number < 0 ? "\u207b" : "";
    for (const char digit : std::to_string(std::abs(number))) {
        text += kDigits[static_cast<std::size_t>(digit - '0')];
    }
    return text;
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
    const int exponent = tick_exponent(legend.low, legend.high, step);
    if (exponent != 0) {
        canvas.text(
            {bar + 8 * s, corner.y - 16 * s}, "\u00d7 10" + superscript(exponent),
            {.size = kTextSize * s});
    }
    const double unit = std::pow(10, exponent);
    for (const double tick : ticks) {
        const double y = corner.y + height * (1 - legend.part(tick));
        canvas.line({bar, y}, {bar + 5 * s, y}, {30, 30, 30}, s);
        canvas.text(
            {bar + 8 * s, y + 4.5 * s}, tick_text(tick / unit, step / unit),
            {.size = kTextSize * s});
    }
}

/// Draws as many categories as there is room for, one below the other.
void draw_categories(
    Canvas& canvas, const Legend& legend, PixelPoint corner, double bottom, double s) {
    constexpr std::size_t kMaxLines = 2;
    const double row = 20 * s, line = 15 * s, indent = 26 * s;
    const double width = static_cast<double>(canvas.image().width) - corner.x - indent;
    const std::size_t count = legend.categories.size();
    for (std::size_t i = 0; i < count; ++i) {
        const auto& [name, color] = legend.categories[i];
        const std::vector<std::string> lines = folded(name, kTextSize * s, width, kMaxLines);
        const double height = row + line * static_cast<double>(lines.size() - 1);
        if (corner.y + height + (i + 1 < count ? row : 0) > bottom) {
            canvas.text(
                {corner.x, corner.y + 11 * s}, fmt::format("and {} more", count - i),
                {.size = kTextSize * s});
            return;
        }
        canvas.rectangle(corner, kBarWidth * s, 12 * s, color);
        for (std::size_t k = 0; k < lines.size(); ++k) {
            canvas.text(
                {corner.x + indent, corner.y + 11 * s + line * static_cast<double>(k)}, lines[k],
                {.size = kTextSize * s});
        }
        corner.y += height;
    }
}

}  // namespace

const std::array<ErrorClass, 7>& error_class_table() {
    static const std::array<ErrorClass, 7> table{{
        {0.01, "below 1 %", {0x3A, 0x78, 0xA1}},
        {0.02, "1 to 2 %", {0x59, 0xA4, 0xC0}},
        {0.05, "2 to 5 %", {0x96, 0xD0, 0xD7}},
        {0.1, "5 to 10 %", {0xF0, 0xDC, 0x7B}},
        {0.2, "10 to 20 %", {0xFB, 0x9B, 0x20}},
        {0.5, "20 to 50 %", {0xDE, 0x3F, 0x25}},
        {std::numeric_limits<double>::infinity(), "above 50 %", {0x8A, 0x08, 0x5A}},
    }};
    return table;
}

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

int tick_exponent(double low, double high, double step) {
    constexpr double kLarge = 1e6, kSmall = 1e-4;
    const double large = std::max(std::abs(low), std::abs(high));
    return large >= kLarge || step < kSmall ? static_cast<int>(std::floor(std::log10(large))) : 0;
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
    if (std::ranges::any_of(values, [](double value) { return !std::isfinite(value); })) {
        legend.categories.emplace_back("no value", kNoValue);
    }
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
    PixelPoint below = corner;
    if (legend.map != nullptr) {
        const double rows = 20 * scale * static_cast<double>(legend.categories.size());
        const double bar = std::max(20.0, height - rows);
        draw_bar(canvas, legend, corner, bar, scale);
        below.y += bar + 14 * scale;
    }
    draw_categories(canvas, legend, below, corner.y + height + 20 * scale, scale);
}

}  // namespace quasimc

#include "view/axis.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace quasimc {

double round_number_below(double most) {
    const double power = std::pow(10, std::floor(std::log10(most)));
    for (const double digit : {5.0, 2.0}) {
        if (digit * power <= most) {
            return digit * power;
        }
    }
    return power;
}

namespace {

/// Powers of ten from low to high, and 2 and 5 times these where there are few.
std::vector<double> decades_of(const Axis& axis) {
    constexpr double kFew = 3, kRounding = 1e-9;
    const bool has_few = std::log10(axis.high / axis.low) <= kFew;
    std::vector<double> ticks;
    const int first = static_cast<int>(std::floor(std::log10(axis.low)));
    for (int power = first; power <= std::log10(axis.high); ++power) {
        for (const double digit : {1.0, 2.0, 5.0}) {
            const double tick = digit * std::pow(10, power);
            const bool is_within =
                tick >= axis.low * (1 - kRounding) && tick <= axis.high * (1 + kRounding);
            if (is_within && (digit == 1 || has_few)) {
                ticks.push_back(tick);
            }
        }
    }
    return ticks;
}

}  // namespace

std::vector<double> ticks_of(const Axis& axis, int about) {
    if (axis.is_logarithmic) {
        return decades_of(axis);
    }
    const double step = round_number_below((axis.high - axis.low) / about * 1.5);
    std::vector<double> ticks;
    const double first = std::ceil(axis.low / step - 1e-9), last = axis.high / step + 1e-9;
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

std::vector<std::string> texts_of(const Axis& axis, const std::vector<double>& ticks) {
    const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1;
    std::vector<std::string> texts;
    texts.reserve(ticks.size());
    for (const double tick : ticks) {
        texts.push_back(axis.is_logarithmic ? fmt::format("{:.6g}", tick) : tick_text(tick, step));
    }
    return texts;
}

Axis logarithmic_axis_about(double low, double high, std::string title) {
    if (!(low > 0) || !(high >= low) || !std::isfinite(high)) {
        return {1, 10, std::move(title), true};
    }
    const double from = round_number_below(low);
    const double above = 1 / round_number_below(1 / high);  // 1/2 is 5, 1/5 is 2 times a power
    const double to = above > from ? above : 10 * from;
    return {from, to, std::move(title), true};
}

Axis axis_about(double low, double high, std::string title) {
    if (!std::isfinite(low) || !std::isfinite(high)) {
        return {0, 1, std::move(title)};
    }
    if (!(low < high)) {
        const double room = low == 0 ? 1 : 0.5 * std::abs(low);
        return {low - (low == 0 ? 0 : room), high + room, std::move(title)};
    }
    const double step = round_number_below((high - low) / 4);
    return {
        step * std::floor(low / step + 1e-9), step * std::ceil(high / step - 1e-9),
        std::move(title)};
}

}  // namespace quasimc

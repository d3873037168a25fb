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

std::vector<double> ticks_of(const Axis& axis, int about) {
    const double step = round_number_below((axis.high - axis.low) / about * 1.5);
    std::vector<double> ticks;
    const double first = std::ceil(axis.low / step - 1e-9), last = axis.high / step + 1e-9;
    for (double i = first; i <= last; ++i) {
        ticks.push_back(i * step);
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

#include "weather/daily_hours.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/text.h"

namespace quasimc {

namespace {

/// The end, later than the beginning: up to 48.
double end_of(const DailyHours::Span& span) {
    return span.to > span.from ? span.to : span.to + 24;
}

bool have_common(const DailyHours::Span& a, const DailyHours::Span& b) {
    for (const int shift : {-24, 0, 24}) {
        if (std::max(a.from, b.from + shift) < std::min(end_of(a), end_of(b) + shift)) {
            return true;
        }
    }
    return false;
}

}  // namespace

bool DailyHours::overlap() const {
    for (std::size_t i = 0; i < spans.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (have_common(spans[i], spans[j])) {
                return true;
            }
        }
    }
    return false;
}

double DailyHours::share(const CivilTime& start, double seconds) const {
    const double begin = start.hour + start.minute / 60.0 + start.second / 3600;
    const double length = seconds / 3600;
    const int days = static_cast<int>(std::ceil((begin + length) / 24));
    double within = 0;
    for (const Span& span : spans) {
        for (int day = -1; day <= days; ++day) {
            const double from = span.from + 24 * day;
            const double to = end_of(span) + 24 * day;
            if (length == 0) {
                within += begin >= from && begin < to ? 1 : 0;
            } else {
                within +=
                    std::max(0.0, std::min(begin + length, to) - std::max(begin, from)) / length;
            }
        }
    }
    // Rounding must not change a lamp that is always on.
    constexpr double kRounding = 1e-9;
    return std::abs(within - 1) < kRounding ? 1 : within < kRounding ? 0 : within;
}

std::string DailyHours::describe() const {
    std::string out;
    for (const Span& span : spans) {
        out += fmt::format(
            "{}from {} to {} h", out.empty() ? "" : ", ", shortest(span.from), shortest(span.to));
    }
    return out;
}

}  // namespace quasimc

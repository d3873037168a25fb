#pragma once

#include <cmath>
#include <string>
#include <vector>

namespace quasimc {

/// The numbers that an axis shows.
struct Axis {
    double low = 0, high = 1;  ///< low < high
    std::string title;
    bool is_logarithmic = false;  ///< then low > 0

    /// Where a value stands: 0 at the low end, 1 at the high one.
    [[nodiscard]] double part(double value) const {
        return is_logarithmic ? std::log(value / low) / std::log(high / low)
                              : (value - low) / (high - low);
    }
};

/// Round numbers on an axis, in order, `about` of them.
[[nodiscard]] std::vector<double> ticks_of(const Axis& axis, int about);
/// The same as they are written.
[[nodiscard]] std::vector<std::string> texts_of(const Axis& axis, const std::vector<double>& ticks);
/// A tick in as many digits as tell it from the next one.
[[nodiscard]] std::string tick_text(double tick, double step);
/// The largest 1, 2 or 5 times a power of ten that is not above `most` > 0.
[[nodiscard]] double round_number_below(double most);
/// An axis from and to round numbers about values. Finite ones count; none give 0 to 1.
[[nodiscard]] Axis axis_about(double low, double high, std::string title);

/// A logarithmic axis over values, from and to 1, 2 or 5 times a power of ten. Positive ones count;
/// none give 1 to 10.
[[nodiscard]] Axis logarithmic_axis_about(double low, double high, std::string title);

}  // namespace quasimc

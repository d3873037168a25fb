#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "picture/canvas.h"
#include "picture/color_map.h"

namespace quasimc {

/// A class of relative errors, with the same colour in all pictures.
struct ErrorClass {
    double below;  ///< upper end, a fraction of the value
    std::string_view name;
    Rgb color;
};
[[nodiscard]] const std::array<ErrorClass, 7>& error_class_table();
/// Colour of organs whose light is so little that its error does not matter.
inline constexpr Rgb kTooFaint{0x7D, 0x85, 0x81};

/// The legend of a picture's colours: a scale, categories, or both.
struct Legend {
    const ColorMap* map = nullptr;  ///< of the scale
    double low = 0, high = 1;       ///< ends of the scale
    bool is_exceeded = false;       ///< some values are above the scale
    std::vector<std::pair<std::string, Rgb>> categories;

    /// Position of a value on the scale: 0 at the low end, 1 at the high one.
    [[nodiscard]] double part(double value) const { return (value - low) / (high - low); }
};

/// About `about` round numbers between two others, in order.
[[nodiscard]] std::vector<double> ticks_between(double low, double high, int about);
/// The power of ten that all ticks are multiples of where they are very large or small; else 0.
[[nodiscard]] int tick_exponent(double low, double high, double step);
/// A tick with enough digits to differ from the next one.
[[nodiscard]] std::string tick_text(double tick, double step);
/// The largest 1, 2 or 5 times a power of ten that does not exceed `most` > 0.
[[nodiscard]] double round_number_below(double most);

/// Scale of values: from 0, unless some are negative, to the 99.5 % quantile by area, so that
/// single organs do not darken all others.
/// @param areas  of the organs: their weights
/// @param range  low and high end instead; equal ones: automatic
[[nodiscard]] Legend scale_of(
    const std::vector<double>& values,
    const std::vector<double>& areas,
    const ColorMap& map,
    std::pair<double, double> range = {});

[[nodiscard]] std::vector<Rgb> colors_of(const std::vector<double>& values, const Legend& legend);

/// Draws a legend into a column. @param scale  1 for letters 13 pixels high
void draw_legend(
    Canvas& canvas, const Legend& legend, const PixelPoint& corner, double height, double scale);

}  // namespace quasimc

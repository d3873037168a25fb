#pragma once

#include <string>
#include <utility>
#include <vector>

#include "picture/canvas.h"
#include "picture/color_map.h"

namespace quasimc {

/// What the colours of a picture mean: a scale, categories, or nothing.
struct Legend {
    const ColorMap* map = nullptr;  ///< of a scale
    double low = 0, high = 1;       ///< ends of the scale
    bool is_exceeded = false;       ///< there are values above the scale
    bool has_unknown = false;       ///< there are organs without a value
    std::vector<std::pair<std::string, Rgb>> categories;

    /// Where a value stands on the scale: 0 at the low end, 1 at the high one.
    [[nodiscard]] double part(double value) const { return (value - low) / (high - low); }
};

/// Round numbers between two others, in order, `about` of them.
[[nodiscard]] std::vector<double> ticks_between(double low, double high, int about);
/// A tick in as many digits as tell it from the next one.
[[nodiscard]] std::string tick_text(double tick, double step);
/// The largest 1, 2 or 5 times a power of ten that is not above `most` > 0.
[[nodiscard]] double round_number_below(double most);

/// Colours of values on a scale: from 0, unless some are negative, to what a two-hundredth of the
/// area exceeds, so that single organs do not darken all others.
/// @param areas  of the organs: how much each of them counts
/// @param range  low and high end instead; equal ones: none given
[[nodiscard]] Legend scale_of(
    const std::vector<double>& values,
    const std::vector<double>& areas,
    const ColorMap& map,
    std::pair<double, double> range = {});

[[nodiscard]] std::vector<Rgb> colors_of(const std::vector<double>& values, const Legend& legend);

/// Draws a legend into a column. @param scale  how large: 1 for letters 13 pixels high
void draw_legend(
    Canvas& canvas, const Legend& legend, const PixelPoint& corner, double height, double scale);

}  // namespace quasimc

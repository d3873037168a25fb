#pragma once

#include <string>
#include <utility>
#include <vector>

#include "view/axis.h"
#include "view/canvas.h"
#include "view/color_map.h"

namespace quasimc {

/// What the colours of a picture mean: a scale, categories, or nothing.
struct Legend {
    const ColorMap* map = nullptr;  ///< of a scale
    Axis axis;
    bool is_exceeded = false;  ///< there are values above the scale
    bool has_unknown = false;  ///< there are organs without a value
    std::vector<std::pair<std::string, Rgb>> categories;
};

/// Colours of values on a scale: from 0, unless some are negative, to what a two-hundredth of the
/// area exceeds, so that single organs do not darken all others.
/// @param areas  of the organs: how much each of them counts
/// @param range  low and high end instead; equal ones: none given
[[nodiscard]] Legend scale_of(
    const std::vector<double>& values,
    const std::vector<double>& areas,
    const ColorMap& map,
    std::string title,
    std::pair<double, double> range = {});

[[nodiscard]] std::vector<Rgb> colors_of(const std::vector<double>& values, const Legend& legend);

/// Draws a legend into a column. @param scale  how large: 1 for letters 13 pixels high
void draw_legend(
    Canvas& canvas, const Legend& legend, const PixelPlace& corner, double height, double scale);

}  // namespace quasimc

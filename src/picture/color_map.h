#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "picture/image.h"

namespace quasimc {

/// A perceptually uniform colour map, lighter for larger values, readable with any colour vision.
struct ColorMap {
    std::string_view name;
    std::span<const std::uint32_t> stops;  ///< 0xRRGGBB, equally spaced
};

[[nodiscard]] const std::array<ColorMap, 3>& color_map_table();
/// The map with a name, or null.
[[nodiscard]] const ColorMap* find_color_map(std::string_view name);

/// Colour of organs without a value.
inline constexpr Rgb kNoValue{200, 200, 200};

/// @param part  0 for the first colour, 1 for the last; values beyond have the colour of the end,
/// NaN has kNoValue
[[nodiscard]] Rgb color_at(const ColorMap& map, double part);

/// The map of differences: from blue for negative over white to red for positive ones.
[[nodiscard]] const ColorMap& difference_map();

/// Colour of the ground where colours show something else than light.
inline constexpr Rgb kEarth{190, 170, 150};

/// Different colours for a number of categories. Eight differ for any colour vision.
[[nodiscard]] std::vector<Rgb> category_colors(std::size_t count);

}  // namespace quasimc

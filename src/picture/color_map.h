#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "picture/image.h"

namespace quasimc {

/// Colours for values in order: of equal steps to the eye, lighter for more, to be told apart
/// whatever colours one sees.
struct ColorMap {
    std::string_view name;
    std::span<const std::uint32_t> stops;  ///< 0xRRGGBB, equal steps apart
};

[[nodiscard]] const std::array<ColorMap, 3>& color_map_table();
/// Null if there is none of that name.
[[nodiscard]] const ColorMap* find_color_map(std::string_view name);

/// Of organs without a value.
inline constexpr Rgb kNoValue{200, 200, 200};

/// @param part  0 for the first colour, 1 for the last; what is beyond has the colour of the end.
///        NaN has kNoValue
[[nodiscard]] Rgb color_at(const ColorMap& map, double part);

/// For things without order; after eight they come again.
[[nodiscard]] Rgb category_color(std::size_t number);

}  // namespace quasimc

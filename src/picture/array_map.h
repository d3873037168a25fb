#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "picture/image.h"
#include "picture/legend.h"

namespace quasimc {

/// Values on a regular array of points.
struct ArrayMap {
    std::string title;  ///< name, quantity and unit
    std::size_t columns = 0, rows = 0;
    double aspect = 1;           ///< distance of columns over that of rows
    std::vector<double> values;  ///< [row * columns + column]; NaN: unknown
    Legend legend;
};

/// Draws an array as a map: columns from left to right, rows from below, each point as a cell in
/// the colour of its value, beside a legend. Needs has_png().
/// @param map  at least one column and row; a legend with a scale
[[nodiscard]] Image draw_array_map(const ArrayMap& map);

/// Puts images above each other. @param images  at least one
[[nodiscard]] Image stacked(const std::vector<Image>& images);

}  // namespace quasimc

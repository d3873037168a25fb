#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace quasimc {

/// A text as a picture of how much of each pixel it covers, row by row.
struct TextMask {
    std::size_t width = 0, height = 0;
    double baseline = 0;  ///< row that letters stand on, from the top
    std::vector<std::uint8_t> coverage;
};

/// A text in DejaVu Sans. What is no UTF-8, and letters that the font has not, are boxes.
/// @param size  height of a line, pixels
[[nodiscard]] TextMask draw_text(std::string_view utf8, double size);

}  // namespace quasimc

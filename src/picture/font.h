#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace quasimc {

/// Coverage of pixels by a text, row by row.
struct TextMask {
    std::size_t width = 0, height = 0;
    double baseline = 0;  ///< row of the baseline, from the top
    std::vector<std::uint8_t> coverage;
};

/// Draws a text in DejaVu Sans. Invalid UTF-8 and missing letters become boxes.
/// @param size  height of a line, pixels
[[nodiscard]] TextMask draw_text(std::string_view utf8, double size);

}  // namespace quasimc

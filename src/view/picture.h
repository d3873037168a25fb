#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace quasimc {

/// Red, green, blue.
using Color = std::array<std::uint8_t, 3>;

/// A picture of at most 256 colours, row by row from the top left corner.
struct Picture {
    std::size_t width = 0, height = 0;
    std::vector<std::uint8_t> pixels;  ///< numbers of colours
    std::vector<Color> palette;

    [[nodiscard]] std::uint8_t& at(std::size_t x, std::size_t y) { return pixels[y * width + x]; }
};

/// Whether to_png can be called: the library was built with libpng.
[[nodiscard]] bool has_png();

/// The bytes of a PNG file. Needs has_png().
/// @throws std::runtime_error  if libpng can't make one
[[nodiscard]] std::string to_png(const Picture& picture);

}  // namespace quasimc

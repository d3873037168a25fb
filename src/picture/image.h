#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace quasimc {

struct Rgb {
    std::uint8_t r = 0, g = 0, b = 0;
    friend bool operator==(const Rgb&, const Rgb&) = default;
};

/// Blends two colours: `part` of the second, the rest of the first.
[[nodiscard]] inline Rgb mixed(const Rgb& a, const Rgb& b, double part) {
    const auto channel = [part](double from, double to) {
        return static_cast<std::uint8_t>(std::lround(from + part * (to - from)));
    };
    return {channel(a.r, b.r), channel(a.g, b.g), channel(a.b, b.b)};
}

/// A picture, row by row from the top left corner.
struct Image {
    std::size_t width = 0, height = 0;
    std::vector<Rgb> pixels;

    Image() = default;
    Image(std::size_t w, std::size_t h, const Rgb& color)
        : width(w), height(h), pixels(w * h, color) {}

    [[nodiscard]] Rgb& at(std::size_t x, std::size_t y) { return pixels[y * width + x]; }
    [[nodiscard]] const Rgb& at(std::size_t x, std::size_t y) const {
        return pixels[y * width + x];
    }
};

/// Whether to_png() can be called: the library was built with libpng, stb_truetype and a font.
[[nodiscard]] bool has_png();

/// The bytes of a PNG file. Needs has_png().
/// @throws std::runtime_error  if libpng fails
[[nodiscard]] std::string to_png(const Image& image);
/// The bytes of a PNG file without a background, from the same picture on white and on black.
[[nodiscard]] std::string to_transparent_png(const Image& on_white, const Image& on_black);

}  // namespace quasimc

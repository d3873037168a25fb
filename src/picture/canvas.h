#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "picture/camera.h"
#include "picture/font.h"
#include "picture/image.h"

namespace quasimc {

/// The alignment of a text at its position.
enum class TextAnchor { start, middle };

/// Style of a text.
struct TextStyle {
    double size = 12;  ///< height of a line, pixels
    TextAnchor anchor = TextAnchor::start;
    Rgb color{30, 30, 30};
    bool has_halo = false;  ///< a white edge, for texts on pictures
};

/// A text in lines that are not wider than a width. What does not fit, and words that are wider,
/// end in "...".
/// @param size   of TextStyle
/// @param lines  the most
[[nodiscard]] std::vector<std::string> folded(
    std::string_view utf8, double size, double width, std::size_t lines);

/// An image to draw on. Points are in pixels from the top left corner, and may lie between pixels.
class Canvas {
  public:
    Canvas(std::size_t width, std::size_t height, const Rgb& background = {255, 255, 255})
        : image_(width, height, background) {}

    [[nodiscard]] const Image& image() const { return image_; }

    /// Copies a picture with its top left corner at a whole pixel.
    void put(const PixelPoint& corner, const Image& picture);
    void polygon(std::span<const PixelPoint> corners, const Rgb& fill);
    void line(const PixelPoint& a, const PixelPoint& b, const Rgb& color, double width);
    void rectangle(const PixelPoint& corner, double width, double height, const Rgb& fill);
    void disk(const PixelPoint& center, double radius, const Rgb& fill);
    /// Needs has_png(). @param position  on the baseline
    void text(const PixelPoint& position, std::string_view utf8, const TextStyle& style);

  private:
    void draw_mask(const PixelPoint& corner, const TextMask& mask, const Rgb& color);
    void blend(std::size_t x, std::size_t y, const Rgb& color, double part);

    Image image_;
};

}  // namespace quasimc

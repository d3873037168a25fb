#pragma once

#include <span>
#include <string_view>

#include "picture/camera.h"
#include "picture/image.h"

namespace quasimc {

/// The alignment of a text at its position.
enum class TextAnchor { start, middle };

/// Style of a text.
struct TextStyle {
    double size = 12;  ///< height of a line, pixels
    TextAnchor anchor = TextAnchor::start;
    Rgb color{30, 30, 30};
};

/// An image to draw on. Points are in pixels from the top left corner, and may lie between pixels.
class Canvas {
  public:
    Canvas(std::size_t width, std::size_t height) : image_(width, height, {255, 255, 255}) {}

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
    void blend(std::size_t x, std::size_t y, const Rgb& color, double part);

    Image image_;
};

}  // namespace quasimc

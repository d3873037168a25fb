#pragma once

#include <span>
#include <string_view>

#include "picture/camera.h"
#include "picture/image.h"

namespace quasimc {

/// Where a text stands beside its place.
enum class TextAnchor { start, middle };

/// How a text looks.
struct TextStyle {
    double size = 12;  ///< height of a line, pixels
    TextAnchor anchor = TextAnchor::start;
    Rgb color{30, 30, 30};
};

/// An image that is drawn on. Places are pixels from the top left corner, also between them.
class Canvas {
  public:
    Canvas(std::size_t width, std::size_t height) : image_(width, height, {255, 255, 255}) {}

    [[nodiscard]] const Image& image() const { return image_; }

    /// Puts a picture on a place of whole pixels, which its top left corner has.
    void put(const PixelPoint& corner, const Image& picture);
    void polygon(std::span<const PixelPoint> corners, const Rgb& fill);
    void line(const PixelPoint& a, const PixelPoint& b, const Rgb& color, double width);
    void rectangle(const PixelPoint& corner, double width, double height, const Rgb& fill);
    void disk(const PixelPoint& center, double radius, const Rgb& fill);
    /// Needs has_png(). @param place  on the line that letters stand on
    void text(const PixelPoint& position, std::string_view utf8, const TextStyle& style);

  private:
    void blend(std::size_t x, std::size_t y, const Rgb& color, double part);

    Image image_;
};

}  // namespace quasimc

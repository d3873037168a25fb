#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "view/camera.h"
#include "view/image.h"

namespace quasimc {

/// Where a text stands beside its place.
enum class TextAnchor { start, middle, end };

/// How a text looks.
struct TextStyle {
    double size = 12;  ///< height of a line, pixels
    TextAnchor anchor = TextAnchor::start;
    Rgb color{30, 30, 30};
    bool upwards = false;  ///< turned to run from below to above
};

/// Something to draw on. Places are pixels from the top left corner, also between them.
class Canvas {
  public:
    virtual ~Canvas() = default;
    Canvas() = default;
    Canvas(const Canvas&) = delete;
    Canvas& operator=(const Canvas&) = delete;

    /// Its top left corner on a place of whole pixels.
    virtual void image(const PixelPlace& corner, const Image& picture) = 0;
    virtual void polygon(std::span<const PixelPlace> corners, const Rgb& fill) = 0;
    virtual void polyline(std::span<const PixelPlace> places, const Rgb& color, double width) = 0;
    /// @param place  on the line that letters stand on
    virtual void text(const PixelPlace& place, std::string_view utf8, const TextStyle& style) = 0;
    /// The bytes of the file.
    [[nodiscard]] virtual std::string finish() = 0;

    // Made of these.
    void line(const PixelPlace& a, const PixelPlace& b, const Rgb& color, double width);
    void rectangle(const PixelPlace& corner, double width, double height, const Rgb& fill);
    void disk(const PixelPlace& center, double radius, const Rgb& fill);
};

/// Draws a PNG file. Needs has_png() (view/picture.h).
[[nodiscard]] std::unique_ptr<Canvas> make_png_canvas(std::size_t width, std::size_t height);
/// Writes an SVG file: letters stay letters, lines lines. Images in it need has_png().
[[nodiscard]] std::unique_ptr<Canvas> make_svg_canvas(std::size_t width, std::size_t height);

}  // namespace quasimc

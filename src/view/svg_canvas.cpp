#include <iterator>

#include <fmt/format.h>

#include "io/base64.h"
#include "view/canvas.h"

namespace quasimc {
namespace {

std::string css(const Rgb& color) {
    return fmt::format("#{:02x}{:02x}{:02x}", color.r, color.g, color.b);
}

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '&') {
            out += "&amp;";
        } else if (c == '<') {
            out += "&lt;";
        } else if (c == '>') {
            out += "&gt;";
        } else if (byte >= 0x20) {
            out += c;
        }
    }
    return out;
}

std::string places_text(std::span<const PixelPlace> places) {
    std::string out;
    for (const PixelPlace& place : places) {
        fmt::format_to(
            std::back_inserter(out), "{}{:.2f},{:.2f}", out.empty() ? "" : " ", place.x, place.y);
    }
    return out;
}

class SvgCanvas final : public Canvas {
  public:
    SvgCanvas(std::size_t width, std::size_t height)
        : text_(fmt::format(
              "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
              "viewBox=\"0 0 {0} {1}\" font-family=\"DejaVu Sans, Verdana, sans-serif\">\n"
              "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
              width,
              height)) {}

    void image(const PixelPlace& corner, const Image& picture) override {
        add("<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" "
            "href=\"data:image/png;base64,{}\"/>\n",
            corner.x, corner.y, picture.width, picture.height, encode_base64(to_png(picture)));
    }

    void polygon(std::span<const PixelPlace> corners, const Rgb& fill) override {
        add("<polygon points=\"{}\" fill=\"{}\"/>\n", places_text(corners), css(fill));
    }

    void polyline(std::span<const PixelPlace> places, const Rgb& color, double width) override {
        add("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2f}\"/>\n",
            places_text(places), css(color), width);
    }

    void text(const PixelPlace& place, std::string_view utf8, const TextStyle& style) override {
        const char* anchor = style.anchor == TextAnchor::start    ? "start"
                             : style.anchor == TextAnchor::middle ? "middle"
                                                                  : "end";
        // Letters are as high as in the other canvas: the size of a font is less than its lines.
        constexpr double kFontSize = 0.859;
        add("<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.2f}\" text-anchor=\"{}\" "
            "fill=\"{}\"{}>{}</text>\n",
            place.x, place.y, kFontSize * style.size, anchor, css(style.color),
            style.upwards
                ? fmt::format(" transform=\"rotate(-90 {:.2f} {:.2f})\"", place.x, place.y)
                : "",
            escaped(utf8));
    }

    std::string finish() override { return std::move(text_) + "</svg>\n"; }

  private:
    template <typename... Parts>
    void add(fmt::format_string<Parts...> format, Parts&&... parts) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Parts>(parts)...);
    }

    std::string text_;
};

}  // namespace

std::unique_ptr<Canvas> make_svg_canvas(std::size_t width, std::size_t height) {
    return std::make_unique<SvgCanvas>(width, height);
}

}  // namespace quasimc

// Replaces png.cpp and font.cpp where libpng, stb_truetype or the font is not installed.

#include <stdexcept>

#include "picture/font.h"
#include "picture/image.h"

namespace quasimc {

bool has_png() {
    return false;
}

std::string to_png([[maybe_unused]] const Image& image) {
    throw std::logic_error("built without pictures");
}

std::string to_transparent_png(
    [[maybe_unused]] const Image& on_white, [[maybe_unused]] const Image& on_black) {
    throw std::logic_error("built without pictures");
}

TextMask draw_text([[maybe_unused]] std::string_view utf8, [[maybe_unused]] double size) {
    throw std::logic_error("built without pictures");
}

}  // namespace quasimc

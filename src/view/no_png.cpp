// In place of png.cpp and png_canvas.cpp where libpng, stb_truetype or the font is not installed.

#include <stdexcept>

#include "view/canvas.h"
#include "view/image.h"
#include "view/picture.h"

namespace quasimc {
namespace {

[[noreturn]] void refuse() {
    throw std::logic_error("built without pictures");
}

}  // namespace

bool has_png() {
    return false;
}

std::string to_png([[maybe_unused]] const Picture& picture) {
    refuse();
}

std::string to_png([[maybe_unused]] const Image& picture) {
    refuse();
}

std::unique_ptr<Canvas> make_png_canvas(
    [[maybe_unused]] std::size_t width, [[maybe_unused]] std::size_t height) {
    refuse();
}

}  // namespace quasimc

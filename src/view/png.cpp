#include <stdexcept>

#include <png.h>

#include "base/checks.h"
#include "view/image.h"
#include "view/picture.h"

namespace quasimc {
namespace {

std::string write_png(png_image& image, const void* pixels, const void* palette) {
    image.version = PNG_IMAGE_VERSION;
    std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
    png_alloc_size_t size = bytes.size();
    const int done = png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels, 0, palette);
    if (done == 0) {
        throw std::runtime_error(std::string("libpng: ") + image.message);
    }
    bytes.resize(size);
    return bytes;
}

}  // namespace

bool has_png() {
    return true;
}

std::string to_png(const Picture& picture) {
    EXPECT(picture.pixels.size() == picture.width * picture.height);
    EXPECT(!picture.palette.empty() && picture.palette.size() <= 256);
    png_image image{};
    image.width = static_cast<png_uint_32>(picture.width);
    image.height = static_cast<png_uint_32>(picture.height);
    image.format = PNG_FORMAT_RGB_COLORMAP;
    image.colormap_entries = static_cast<png_uint_32>(picture.palette.size());
    return write_png(image, picture.pixels.data(), picture.palette.data());
}

std::string to_png(const Image& picture) {
    static_assert(sizeof(Rgb) == 3);
    EXPECT(picture.pixels.size() == picture.width * picture.height);
    png_image image{};
    image.width = static_cast<png_uint_32>(picture.width);
    image.height = static_cast<png_uint_32>(picture.height);
    image.format = PNG_FORMAT_RGB;
    return write_png(image, picture.pixels.data(), nullptr);
}

}  // namespace quasimc

#include <stdexcept>

#include <png.h>

#include "base/checks.h"
#include "view/picture.h"

namespace quasimc {

bool has_png() {
    return true;
}

std::string to_png(const Picture& picture) {
    EXPECT(picture.pixels.size() == picture.width * picture.height);
    EXPECT(!picture.palette.empty() && picture.palette.size() <= 256);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(picture.width);
    image.height = static_cast<png_uint_32>(picture.height);
    image.format = PNG_FORMAT_RGB_COLORMAP;
    image.colormap_entries = static_cast<png_uint_32>(picture.palette.size());
    std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
    png_alloc_size_t size = bytes.size();
    const int done = png_image_write_to_memory(
        &image, bytes.data(), &size, 0, picture.pixels.data(), 0, picture.palette.data());
    if (done == 0) {
        throw std::runtime_error(std::string("libpng: ") + image.message);
    }
    bytes.resize(size);
    return bytes;
}

}  // namespace quasimc

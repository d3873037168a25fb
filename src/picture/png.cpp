#include <stdexcept>

#include <png.h>

#include "base/checks.h"
#include "picture/image.h"

namespace quasimc {

bool has_png() {
    return true;
}

std::string to_png(const Image& image) {
    static_assert(sizeof(Rgb) == 3);
    EXPECT(image.pixels.size() == image.width * image.height);
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = static_cast<png_uint_32>(image.width);
    png.height = static_cast<png_uint_32>(image.height);
    png.format = PNG_FORMAT_RGB;
    std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(png), '\0');
    png_alloc_size_t size = bytes.size();
    if (png_image_write_to_memory(&png, bytes.data(), &size, 0, image.pixels.data(), 0, nullptr) ==
        0) {
        throw std::runtime_error(std::string("libpng: ") + png.message);
    }
    bytes.resize(size);
    return bytes;
}

}  // namespace quasimc

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <png.h>

#include "base/checks.h"
#include "picture/image.h"

namespace quasimc {

bool has_png() {
    return true;
}

namespace {

/// @param pixels  in this format, row by row
std::string encoded(const Image& image, const void* pixels, png_uint_32 format) {
    EXPECT(image.pixels.size() == image.width * image.height);
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = static_cast<png_uint_32>(image.width);
    png.height = static_cast<png_uint_32>(image.height);
    png.format = format;
    std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(png), '\0');
    png_alloc_size_t size = bytes.size();
    if (png_image_write_to_memory(&png, bytes.data(), &size, 0, pixels, 0, nullptr) == 0) {
        throw std::runtime_error(std::string("libpng: ") + png.message);
    }
    bytes.resize(size);
    return bytes;
}

}  // namespace

std::string to_png(const Image& image) {
    static_assert(sizeof(Rgb) == 3);
    return encoded(image, image.pixels.data(), PNG_FORMAT_RGB);
}

std::string to_transparent_png(const Image& on_white, const Image& on_black) {
    // Where a fraction a of a pixel is covered by the colour c: a c on black, 1 - a more on white.
    static constexpr int kFull = 255;
    std::vector<std::uint8_t> pixels;
    pixels.reserve(4 * on_white.pixels.size());
    for (std::size_t i = 0; i < on_white.pixels.size(); ++i) {
        const Rgb &white = on_white.pixels[i], &black = on_black.pixels[i];
        const int bare = std::max({white.r - black.r, white.g - black.g, white.b - black.b, 0});
        const int covered = kFull - bare;
        const auto channel = [covered](int part) {
            const int own = covered > 0 ? (kFull * part + covered / 2) / covered : 0;
            return static_cast<std::uint8_t>(std::min(own, kFull));
        };
        for (const int value : {black.r, black.g, black.b}) {
            pixels.push_back(channel(value));
        }
        pixels.push_back(static_cast<std::uint8_t>(covered));
    }
    return encoded(on_white, pixels.data(), PNG_FORMAT_RGBA);
}

}  // namespace quasimc

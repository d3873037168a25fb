#include "picture/sky_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/checks.h"
#include "picture/canvas.h"
#include "picture/color_map.h"

namespace quasimc {
namespace {

constexpr std::array<std::uint32_t, 5> kSkyStops{0x080A28, 0x143C8C, 0x50A0DC, 0xF0E1A0, 0xFFFFFF};
constexpr ColorMap kSkyColors{"sky", kSkyStops};
constexpr Rgb kInk{40, 40, 40};
constexpr Rgb kSun{220, 30, 20};
constexpr double kSkyMargin = 15;  // around a sky of 256 pixels

/// The square root of the radiance in the centre of each pixel; NaN beyond the horizon.
std::vector<double> shades_of(const Source& sky, std::size_t size, double radius) {
    const double middle = 0.5 * static_cast<double>(size);
    std::vector<double> shades(size * size, std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < shades.size(); ++i) {
        const std::size_t row = i / size, column = i % size;
        const double east = middle - (static_cast<double>(column) + 0.5);
        const double north = middle - (static_cast<double>(row) + 0.5);
        const double off = std::hypot(east, north);
        if (off < radius) {
            const double zenith = 0.5 * std::numbers::pi * off / radius;
            const double flat = off > 0 ? std::sin(zenith) / off : 0;
            shades[i] =
                std::sqrt(model_of(sky).radiance({flat * east, flat * north, std::cos(zenith)}));
        }
    }
    return shades;
}

void draw_ring(
    Canvas& canvas, const PixelPoint& middle, double radius, const Rgb& color, double width) {
    constexpr int kSides = 120;
    const auto point = [&](int i) {
        const double angle = 2 * std::numbers::pi * i / kSides;
        return PixelPoint{middle.x + radius * std::cos(angle), middle.y + radius * std::sin(angle)};
    };
    for (int i = 0; i < kSides; ++i) {
        canvas.line(point(i), point(i + 1), color, width);
    }
}

}  // namespace

Image plot_sky(const Source& sky, const Vec3& to_sun, std::size_t size) {
    EXPECT(size >= 64 && size <= 4096);
    const double s = static_cast<double>(size) / 256;
    const double center = 128 * s, radius = center - kSkyMargin * s;
    const PixelPoint middle{center, center};
    Image colors(size, size, {255, 255, 255});
    const std::vector<double> shades = shades_of(sky, size, radius);
    double brightest = 0;
    for (const double shade : shades) {
        brightest = std::max(brightest, std::isnan(shade) ? 0 : shade);
    }
    for (std::size_t i = 0; i < shades.size(); ++i) {
        if (!std::isnan(shades[i])) {
            colors.pixels[i] = color_at(kSkyColors, shades[i] / brightest);
        }
    }
    Canvas canvas(size, size);
    canvas.put({0, 0}, colors);
    for (const double elevation_deg : {0.0, 30.0, 60.0}) {
        draw_ring(canvas, middle, radius * (1 - elevation_deg / 90), kInk, s);
    }
    const double out = radius + 0.5 * kSkyMargin * s, down = 4 * s;
    const TextStyle style{.size = 13 * s, .anchor = TextAnchor::middle, .color = kInk};
    canvas.text({center, center - out + down}, "N", style);
    canvas.text({center - out, center + down}, "E", style);
    canvas.text({center, center + out + down}, "S", style);
    canvas.text({center + out, center + down}, "W", style);
    if (to_sun.z > 0) {
        const double flat = std::hypot(to_sun.x, to_sun.y);
        const double off =
            flat > 0 ? radius * std::acos(to_sun.z) / (0.5 * std::numbers::pi) / flat : 0;
        const PixelPoint sun{center - off * to_sun.x, center - off * to_sun.y};
        draw_ring(canvas, sun, 4.5 * s, kSun, s);
        canvas.disk(sun, 1.5 * s, kSun);
    }
    return canvas.image();
}

}  // namespace quasimc

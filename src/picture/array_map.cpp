#include "picture/array_map.h"

#include <algorithm>
#include <cmath>

#include "picture/canvas.h"

namespace quasimc {
namespace {

constexpr double kMapMargin = 20, kMapTitle = 40, kMapLegend = 130, kMapLetters = 16;
/// The longer side of a map, and the least size of a side, pixels.
constexpr double kMapSide = 640, kMinSide = 60;

}  // namespace

Image draw_array_map(const ArrayMap& map) {
    const double across = static_cast<double>(map.columns) * map.aspect;
    const auto up = static_cast<double>(map.rows);
    const double scale = kMapSide / std::max(across, up);
    const double width = std::max(kMinSide, std::round(scale * across));
    const double height = std::max(kMinSide, std::round(scale * up));
    const double tall = std::max(height, 3 * kMinSide);
    Canvas canvas(
        static_cast<std::size_t>(width + 3 * kMapMargin + kMapLegend),
        static_cast<std::size_t>(tall + kMapTitle + 2 * kMapMargin));
    canvas.text({kMapMargin, kMapMargin + kMapLetters}, map.title, {.size = kMapLetters});
    const std::vector<Rgb> colors = colors_of(map.values, map.legend);
    const double left = kMapMargin, top = kMapTitle + kMapMargin;
    for (std::size_t i = 0; i < colors.size(); ++i) {
        // Whole pixels, so that cells have no seams.
        const auto column = static_cast<double>(i % map.columns);
        const std::size_t below_top = map.rows - 1 - i / map.columns;
        const auto row = static_cast<double>(below_top);
        const double x = std::round(width * column / static_cast<double>(map.columns));
        const double y = std::round(height * row / up);
        const double right = std::round(width * (column + 1) / static_cast<double>(map.columns));
        const double below = std::round(height * (row + 1) / up);
        canvas.rectangle({left + x, top + y}, right - x, below - y, colors[i]);
    }
    draw_legend(canvas, map.legend, {left + width + kMapMargin, top}, tall, 1);
    return canvas.image();
}

Image stacked(const std::vector<Image>& images) {
    std::size_t width = 0, height = 0;
    for (const Image& image : images) {
        width = std::max(width, image.width);
        height += image.height;
    }
    Canvas canvas(width, height);
    double top = 0;
    for (const Image& image : images) {
        canvas.put({0, top}, image);
        top += static_cast<double>(image.height);
    }
    return canvas.image();
}

}  // namespace quasimc

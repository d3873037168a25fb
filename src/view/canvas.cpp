#include "view/canvas.h"

#include <array>
#include <cmath>
#include <numbers>

namespace quasimc {

void Canvas::line(const PixelPlace& a, const PixelPlace& b, const Rgb& color, double width) {
    polyline(std::array{a, b}, color, width);
}

void Canvas::rectangle(const PixelPlace& corner, double width, double height, const Rgb& fill) {
    const PixelPlace far{corner.x + width, corner.y + height};
    polygon(
        std::array{corner, PixelPlace{far.x, corner.y}, far, PixelPlace{corner.x, far.y}}, fill);
}

void Canvas::disk(const PixelPlace& center, double radius, const Rgb& fill) {
    std::array<PixelPlace, 40> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const double angle =
            2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners.size());
        corners[i] = {center.x + radius * std::cos(angle), center.y + radius * std::sin(angle)};
    }
    polygon(corners, fill);
}

}  // namespace quasimc

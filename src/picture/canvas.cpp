#include "picture/canvas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace quasimc {
namespace {

/// Whether a point is inside a polygon, by the even-odd rule.
bool is_inside(std::span<const PixelPoint> corners, double x, double y) {
    bool inside = false;
    for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
        const PixelPoint &a = corners[i], &b = corners[j];
        if ((a.y > y) != (b.y > y) && x < a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x)) {
            inside = !inside;
        }
    }
    return inside;
}

/// Pixels that the corners span along an axis.
std::pair<std::size_t, std::size_t> range(
    std::span<const PixelPoint> corners, double PixelPoint::*axis, std::size_t size) {
    double low = corners[0].*axis, high = low;
    for (const PixelPoint& corner : corners) {
        low = std::min(low, corner.*axis);
        high = std::max(high, corner.*axis);
    }
    const double most = static_cast<double>(size);
    return {
        static_cast<std::size_t>(std::clamp(std::floor(low), 0.0, most)),
        static_cast<std::size_t>(std::clamp(std::ceil(high), 0.0, most))};
}

/// The covered fraction of a pixel, by 16 points in it.
double coverage(std::span<const PixelPoint> corners, std::size_t x, std::size_t y) {
    int count = 0;
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
            count += is_inside(
                         corners, static_cast<double>(x) + (i + 0.5) / 4,
                         static_cast<double>(y) + (j + 0.5) / 4)
                         ? 1
                         : 0;
        }
    }
    return count / 16.0;
}

double width_of(std::string_view utf8, double size) {
    return static_cast<double>(draw_text(utf8, size).width);
}

/// The longest beginning with "..." that fits; the text if it fits.
std::string shortened(std::string text, double size, double width) {
    if (width_of(text, size) <= width) {
        return text;
    }
    const auto is_inside_letter = [](char byte) {
        return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
    };
    std::string whole;
    do {
        while (!text.empty() && is_inside_letter(text.back())) {
            text.pop_back();
        }
        if (!text.empty()) {
            text.pop_back();
        }
        whole = text + "\u2026";
    } while (!text.empty() && width_of(whole, size) > width);
    return whole;
}

}  // namespace

std::vector<std::string> folded(
    std::string_view utf8, double size, double width, std::size_t lines) {
    std::vector<std::string> all{""};
    std::string_view rest = utf8;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(' '), rest.size());
        const std::string longer =
            all.back() + (all.back().empty() ? "" : " ") + std::string(rest.substr(0, end));
        if (all.size() == lines) {
            all.back() += (all.back().empty() ? "" : " ") + std::string(rest);
            break;
        }
        if (!all.back().empty() && width_of(longer, size) > width) {
            all.emplace_back();
            continue;
        }
        all.back() = longer;
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    for (std::string& line : all) {
        line = shortened(std::move(line), size, width);
    }
    return all;
}

void Canvas::put(const PixelPoint& corner, const Image& picture) {
    const auto x0 = static_cast<std::size_t>(corner.x), y0 = static_cast<std::size_t>(corner.y);
    for (std::size_t y = 0; y < picture.height && y0 + y < image_.height; ++y) {
        for (std::size_t x = 0; x < picture.width && x0 + x < image_.width; ++x) {
            image_.at(x0 + x, y0 + y) = picture.at(x, y);
        }
    }
}

void Canvas::polygon(std::span<const PixelPoint> corners, const Rgb& fill) {
    const auto [left, right] = range(corners, &PixelPoint::x, image_.width);
    const auto [top, bottom] = range(corners, &PixelPoint::y, image_.height);
    for (std::size_t y = top; y < bottom; ++y) {
        for (std::size_t x = left; x < right; ++x) {
            blend(x, y, fill, coverage(corners, x, y));
        }
    }
}

void Canvas::line(const PixelPoint& a, const PixelPoint& b, const Rgb& color, double width) {
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (length > 0) {
        const double dx = 0.5 * width * (b.x - a.x) / length;
        const double dy = 0.5 * width * (b.y - a.y) / length;
        polygon(
            std::array<PixelPoint, 4>{
                {{a.x - dy, a.y + dx},
                 {b.x - dy, b.y + dx},
                 {b.x + dy, b.y - dx},
                 {a.x + dy, a.y - dx}}},
            color);
    }
}

void Canvas::rectangle(const PixelPoint& corner, double width, double height, const Rgb& fill) {
    const PixelPoint far{corner.x + width, corner.y + height};
    polygon(
        std::array{corner, PixelPoint{far.x, corner.y}, far, PixelPoint{corner.x, far.y}}, fill);
}

void Canvas::disk(const PixelPoint& center, double radius, const Rgb& fill) {
    std::array<PixelPoint, 40> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const double angle =
            2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners.size());
        corners[i] = {center.x + radius * std::cos(angle), center.y + radius * std::sin(angle)};
    }
    polygon(corners, fill);
}

void Canvas::text(const PixelPoint& position, std::string_view utf8, const TextStyle& style) {
    const TextMask mask = draw_text(utf8, style.size);
    const double before =
        style.anchor == TextAnchor::start ? 0 : 0.5 * static_cast<double>(mask.width);
    const PixelPoint corner{position.x - before, position.y - mask.baseline};
    if (style.has_halo) {
        const double edge = style.size / 8;
        for (const double dx : {-edge, 0.0, edge}) {
            for (const double dy : {-edge, 0.0, edge}) {
                draw_mask({corner.x + dx, corner.y + dy}, mask, {255, 255, 255});
            }
        }
    }
    draw_mask(corner, mask, style.color);
}

void Canvas::draw_mask(const PixelPoint& corner, const TextMask& mask, const Rgb& color) {
    for (std::size_t j = 0; j < mask.height; ++j) {
        for (std::size_t i = 0; i < mask.width; ++i) {
            const double x = corner.x + static_cast<double>(i);
            const double y = corner.y + static_cast<double>(j);
            if (x >= 0 && y >= 0) {
                blend(
                    static_cast<std::size_t>(x), static_cast<std::size_t>(y), color,
                    mask.coverage[j * mask.width + i] / 255.0);
            }
        }
    }
}

void Canvas::blend(std::size_t x, std::size_t y, const Rgb& color, double part) {
    if (part > 0 && x < image_.width && y < image_.height) {
        image_.at(x, y) = mixed(image_.at(x, y), color, part);
    }
}

}  // namespace quasimc

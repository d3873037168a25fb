#include "growth/turtle/plain_geometry.h"

#include <array>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "growth/view/surface.h"

namespace quasimc {

template <typename... Values>
void PlainGeometry::line(std::string_view name, const Values&... values) {
    text_ += name;
    (add(values), ...);
    text_ += '\n';
}

PlainGeometry::PlainGeometry(const View& view) {
    for (const auto& [name, surface] : view.surfaces) {
        text_ += fmt::format("surface {}\n", name);
        for (std::size_t i = 0; surface.mesh && i < surface.mesh->size(); ++i) {
            const auto& [a, b, c] = (*surface.mesh)[i];
            line("triangle", a, b, c);
        }
        text_ += "end\n";
    }
    text_ += "model\n";
}

void PlainGeometry::segment(const DrawnSegment& segment, int color) {
    set_color(color);
    if (segment.radius_from == segment.radius_to) {
        line("cylinder", segment.radius_from, segment.from, segment.to);
    } else {
        line("cone", segment.radius_from, segment.from, segment.radius_to, segment.to);
    }
}

void PlainGeometry::polygon(std::span<const Vec3> corners, int color) {
    set_color(color);
    text_ += "polygon";
    for (const Vec3& corner : corners) {
        add(corner);
    }
    text_ += '\n';
}

void PlainGeometry::triangles(std::span<const Triangle> triangles, int color) {
    set_color(color);
    for (const auto& [a, b, c] : triangles) {
        line("triangle", a, b, c);
    }
}

void PlainGeometry::sphere(const Vec3& center, double radius, int color) {
    set_color(color);
    line("sphere", radius, center);
}

void PlainGeometry::disc(const TurtleFrame& frame, double radius, int color) {
    set_color(color);
    line("disc", radius, frame.position, frame.up);
}

void PlainGeometry::surface(const BezierSurface& surface, const Affine& transform, int /*color*/) {
    line(
        std::string("instance ") + surface.name, transform.vector({1, 0, 0}),
        transform.vector({0, 1, 0}), transform.vector({0, 0, 1}), transform.shift);
}

void PlainGeometry::set_color(int color) {
    if (color != color_) {
        color_ = color;
        text_ += fmt::format("color {}\n", color);
    }
}

void PlainGeometry::add(double value) {
    constexpr double kZero = 5e-6;
    constexpr int kDigits = 5;
    std::array<char, 32> buffer{' '};
    const auto end = std::to_chars(
        buffer.begin() + 1, buffer.end(), std::abs(value) < kZero ? 0.0 : value,
        std::chars_format::general, kDigits);
    text_.append(buffer.data(), end.ptr);
}

void PlainGeometry::add(const Vec3& point) {
    add(point.x);
    add(point.y);
    add(point.z);
}

}  // namespace quasimc

#include "coupling/plants/query_graphics.h"

#include <algorithm>

#include "coupling/plants/number_line.h"
#include "growth/view/surface.h"

namespace quasimc {

void QueryGraphics::segment(const DrawnSegment& segment, int /*color*/) {
    const Vec3 &a = segment.from, &b = segment.to;
    other("cylinder", {a.x, a.y, a.z, b.x, b.y, b.z, segment.radius_from, segment.radius_to});
}

void QueryGraphics::triangles(std::span<const Triangle> triangles, int color) {
    for (const Triangle& triangle : triangles) {
        polygon(triangle, color);
    }
}

void QueryGraphics::sphere(const Vec3& center, double radius, int /*color*/) {
    other("sphere", {center.x, center.y, center.z, radius});
}

void QueryGraphics::disc(const TurtleFrame& frame, double radius, int /*color*/) {
    const Vec3 &p = frame.position, &n = frame.up;
    other("disc", {p.x, p.y, p.z, n.x, n.y, n.z, radius});
}

void QueryGraphics::surface(const BezierSurface& surface, const Affine& transform, int color) {
    if (!surface.mesh) {
        return;
    }
    for (std::size_t i = 0; i < surface.mesh->size(); ++i) {
        Triangle triangle = (*surface.mesh)[i];
        for (Vec3& corner : triangle) {
            corner = transform.point(corner);
        }
        polygon(triangle, color);
    }
}

void GraphicsText::polygon(std::span<const Vec3> corners, int /*color*/) {
    text_ += "polygon\n";
    for (const Vec3& corner : corners) {
        for (const double coordinate : {corner.x, corner.y, corner.z}) {
            text_ += ' ';
            append_six_digits(text_, coordinate);
        }
        text_ += '\n';
    }
}

void GraphicsText::other(std::string_view keyword, std::initializer_list<double> numbers) {
    text_ += keyword;
    for (const double number : numbers) {
        text_ += ' ';
        append_six_digits(text_, number);
    }
    text_ += '\n';
}

void PassGraphics::polygon(std::span<const Vec3> corners, int /*color*/) {
    pass_.polygons.push_back(
        {static_cast<std::uint32_t>(pass_.vertices.size()),
         static_cast<std::uint32_t>(corners.size())});
    pass_.polygon_lines.push_back(0);
    ++pass_.queries.back().polygons.count;
    for (const Vec3& corner : corners) {
        pass_.vertices.push_back(
            {six_digits(corner.x), six_digits(corner.y), six_digits(corner.z)});
    }
}

void PassGraphics::other(std::string_view keyword, std::initializer_list<double> /*numbers*/) {
    auto& others = pass_.other_graphics;
    if (std::find(others.begin(), others.end(), keyword) == others.end()) {
        others.emplace_back(keyword);
    }
}

}  // namespace quasimc

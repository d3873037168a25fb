#include "base/vec3.h"
#include "growth/turtle/turtle.h"
#include "growth/view/surface.h"

namespace quasimc {

namespace {

/// The map from a surface's frame (left, heading, up) to that of a turtle, with factors.
Affine surface_transform(const TurtleFrame& frame, const Vec3& factors) {
    const Vec3 x = factors.x * frame.left, y = factors.y * frame.heading, z = factors.z * frame.up;
    return {{Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}}, frame.position};
}

}  // namespace

void Turtle::draw_sphere(const Parameters& parameters) {
    const double radius = diameter(parameters) / 2;
    bounds_.add(state_.frame.position - Vec3{radius, radius, radius});
    bounds_.add(state_.frame.position + Vec3{radius, radius, radius});
    if (Drawing* const drawing = shape()) {
        drawing->sphere(state_.frame.position, radius, state_.color);
    }
}

void Turtle::draw_disc(const Parameters& parameters) {
    if (Drawing* const drawing = shape()) {
        drawing->disc(state_.frame, diameter(parameters) / 2, state_.color);
    }
}

void Turtle::draw_surface(char name, const Parameters& parameters) {
    const auto found = view_.surfaces.find(name);
    if (found == view_.surfaces.end()) {
        return;
    }
    const BezierSurface& surface = found->second;
    const double size = parameters.value_or(0, 1), factor = state_.scale * size;
    const Affine transform =
        surface_transform(state_.frame, state_.scale * parameters.vector_or(0, {size, size, size}));
    if (Drawing* const drawing = shape()) {
        drawing->surface(surface, transform, state_.color);
    }
    if (!surface.control_bounds.empty()) {
        for (const Vec3& corner : corners_of(surface.control_bounds)) {
            bounds_.add(transform.point(corner));
        }
    }
    state_.frame.position =
        surface_transform(state_.frame, {factor, factor, factor}).point(surface.end_point);
    bounds_.add(state_.frame.position);
}

void Turtle::begin_polygon(const Parameters& parameters) {
    if (!polygons_.empty()) {
        warn("a '{' in a polygon begins another polygon");
    }
    Polygon& polygon = polygons_.emplace_back();
    if (const int curve = parameters.integer(0); curve >= 1 && curve <= 4) {
        polygon.curve = static_cast<CylinderCurve>(curve);
    }
}

void Turtle::mark_corner(const Parameters& parameters) {
    if (polygons_.empty()) {
        warn("a '.' outside a polygon is ignored");
    } else {
        add_corner(parts(parameters.value_or(0, 4), 1, "."));
    }
}

void Turtle::add_corner(int strips) {
    if (drawing_ != nullptr) {
        polygons_.back().points.push_back(cylinder_point(strips));
    }
}

void Turtle::end_polygon() {
    end_segment();
    if (polygons_.empty()) {
        warn("a '}' without a '{' before it is ignored");
        return;
    }
    const Polygon polygon = std::move(polygons_.back());
    polygons_.pop_back();
    if (polygon.curve) {
        send_triangles(cylinders_.whole(polygon.points, *polygon.curve));
    } else if (Drawing* const drawing = polygon.points.empty() ? nullptr : shape()) {
        std::vector<Vec3> corners;
        for (const CylinderPoint& point : polygon.points) {
            corners.push_back(point.position);
        }
        drawing->polygon(corners, state_.color);
    }
}

void Turtle::set_contour(const Parameters& parameters) {
    own_settings().cylinder.contour =
        parameters.count() > 0 ? parameters.integer(0) : CylinderSettings::kCircle;
}

void Turtle::set_contour_sides(const Parameters& parameters) {
    constexpr int kMinSides = 3;
    const double sides = parameters.value_or(0, view_.contour_sides);
    if (sides < kMinSides) {
        warn("'@!': a contour has at least 3 sides; 3 are drawn");
    }
    own_settings().cylinder.sides = parts(sides, kMinSides, "@!");
}

void Turtle::set_tangents(const Parameters& parameters) {
    CylinderSettings& cylinder = own_settings().cylinder;
    cylinder.tangent_in = parameters.value_or(0, cylinder.tangent_in);
    cylinder.tangent_out = parameters.value_or(1, parameters.value_or(0, cylinder.tangent_out));
}

void Turtle::set_radius_tangents(const Parameters& parameters) {
    const auto tangent = [&parameters](std::size_t i) {
        const Turn turn = turn_of(parameters[i]);
        const double size = parameters[i + 1];
        return RadiusTangent{size * turn.c, size * turn.s};
    };
    if (parameters.count() >= 2) {
        CylinderSettings& cylinder = own_settings().cylinder;
        cylinder.radius_in = tangent(0);
        cylinder.radius_out = parameters.count() >= 4 ? tangent(2) : cylinder.radius_in;
    }
}

void Turtle::begin_cylinder() {
    end_segment();
    Settings& settings = own_settings();
    settings.from = cylinder_point(0);
    settings.ring = {settings.from.axes, settings.cylinder.sides};
}

void Turtle::end_cylinder_segment(const Parameters& parameters) {
    if (settings().ring.sides == 0) {
        warn("'@Gc' or '@Ge' without a '@Gs' before it is ignored");
        return;
    }
    const CylinderPoint to = cylinder_point(parts(parameters.value_or(0, 4), 1, "@Gc"));
    Settings& settings = own_settings();
    if (drawing_ != nullptr) {
        const CylinderStrips strips = cylinders_.segment(settings.from, to, settings.ring);
        settings.ring = strips.ring;
        send_triangles(strips.triangles);
    }
    settings.from = to;
}

void Turtle::end_cylinder(const Parameters& parameters) {
    end_cylinder_segment(parameters);
    own_settings().ring.sides = 0;
}

void Turtle::set_patch_point(const Parameters& parameters) {
    const auto found = patches_.find(parameters.integer(0));
    const int row = parameters.integer(1), column = parameters.integer(2);
    if (found == patches_.end() || row < 0 || row > 3 || column < 0 || column > 3) {
        warn("'@PC' is skipped: it needs a '@PS' before it, and rows and columns 0 to 3");
        return;
    }
    found->second[static_cast<std::size_t>(4 * row + column)] = state_.frame.position;
}

void Turtle::draw_patch(const Parameters& parameters) {
    const int s = parts(parameters.value_or(1, 4), 1, "@PD");
    const int t = parts(parameters.value_or(2, s), 1, "@PD");
    if (drawing_ == nullptr) {
        return;
    }
    BezierPatch points;
    const auto found = patches_.find(parameters.integer(0));
    if (found == patches_.end() || found->second.size() < points.size()) {
        warn("'@PD' is skipped: the patch has not all 16 control points");
        return;
    }
    for (const auto& [i, point] : found->second) {
        points[i] = point;
    }
    Mesh mesh;
    add_patch_triangles(points, {s, t}, mesh);
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i < mesh.size(); ++i) {
        triangles.push_back(mesh[i]);
    }
    send_triangles(triangles);
}

CylinderPoint Turtle::cylinder_point(int strips) const {
    const TurtleFrame& frame = state_.frame;
    return {frame.position, {frame.heading, frame.up}, radius(), settings().cylinder, strips};
}

void Turtle::send_triangles(const std::vector<Triangle>& triangles) {
    end_segment();
    if (triangles.empty()) {
        return;
    }
    if (Drawing* const drawing = shape()) {
        drawing->triangles(triangles, state_.color);
    }
}

}  // namespace quasimc

#include "growth/turtle/mesh_drawing.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "geometry/shapes/shapes.h"
#include "growth/view/surface.h"

namespace quasimc {

namespace {

using FaceIndex = std::uint32_t;

/// A sphere with poles along z.
Mesh sphere_mesh(const Vec3& center, double radius, FaceIndex n) {
    Mesh mesh;
    mesh.vertices.push_back(center + Vec3{0, 0, radius});
    for (FaceIndex i = 1; i < n; ++i) {
        const double theta = kPi * i / n, across = radius * std::sin(theta);
        for (FaceIndex k = 0; k < n; ++k) {
            const double phi = kFullTurn * k / n;
            mesh.vertices.push_back(
                center +
                Vec3{across * std::cos(phi), across * std::sin(phi), radius * std::cos(theta)});
        }
    }
    mesh.vertices.push_back(center - Vec3{0, 0, radius});
    const auto corner = [n](FaceIndex row, FaceIndex k) { return 1 + row * n + k % n; };
    const FaceIndex last = corner(n - 1, 0);
    for (FaceIndex k = 0; k < n; ++k) {
        mesh.faces.push_back({0, corner(0, k), corner(0, k + 1)});
        for (FaceIndex row = 0; row + 2 < n; ++row) {
            mesh.faces.push_back({corner(row, k), corner(row + 1, k), corner(row + 1, k + 1)});
            mesh.faces.push_back({corner(row, k), corner(row + 1, k + 1), corner(row, k + 1)});
        }
        mesh.faces.push_back({last, corner(n - 2, k + 1), corner(n - 2, k)});
    }
    return mesh;
}

}  // namespace

MeshDrawing::MeshDrawing(int sides) {
    const int count = std::max(3, sides);
    for (int k = 0; k < count; ++k) {
        const double theta = kFullTurn * k / count;
        angles_.push_back({std::cos(theta), std::sin(theta)});
    }
}

DrawnOrgan& MeshDrawing::organ() {
    if (organs_.empty() || organs_.back().module.index != module_.index) {
        organs_.push_back({module_, {}});
    }
    return organs_.back();
}

void MeshDrawing::add(Mesh mesh, int color) {
    std::erase_if(mesh.faces, [&mesh](const Face& face) {
        const auto& [a, b, c] = face;
        const Vec3 area = area_vector({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
        return !is_finite(area) || area == Vec3{};
    });
    if (mesh.empty()) {
        return;
    }
    std::vector<DrawnPart>& parts = organ().parts;
    const auto found = std::find_if(parts.begin(), parts.end(), [color](const DrawnPart& part) {
        return part.color == color && !part.shared;
    });
    if (found != parts.end()) {
        found->triangles.append(mesh);
    } else {
        parts.push_back({color, std::move(mesh), nullptr, {}});
    }
}

void MeshDrawing::add_corners(const Ring& ring, std::vector<Vec3>& corners) const {
    const Vec3 left = ring.radius * ring.axes.left(), up = ring.radius * ring.axes.up;
    for (const Turn& angle : angles_) {
        corners.push_back(ring.center - (angle.c * left + angle.s * up));
    }
}

void MeshDrawing::segment(const DrawnSegment& segment, int color) {
    const Vec3 way = segment.to - segment.from;
    const double size = length(way);
    if (!(size > 0) || !std::isfinite(size)) {
        return;
    }
    // A ring follows its axis by the least rotation: rolls of the turtle would twist the sides. It
    // is too narrow after a bend of more than 60 degrees.
    constexpr double kMinCosine = 0.5;
    const Vec3 along = way / size;
    const bool continues = last_ring_ && last_ring_->center == segment.from &&
                           last_ring_->radius == segment.radius_from &&
                           dot(last_ring_->axes.heading, along) >= kMinCosine;
    const HeadingAndUp axes{segment.frame.heading, segment.frame.up};
    const Ring start =
        continues ? *last_ring_ : Ring{segment.from, segment.radius_from, turned_to(axes, along)};
    last_ring_ = {segment.to, segment.radius_to, turned_to(start.axes, along)};

    // Rings run clockwise about their heading; the upper sides are outward.
    const auto n = static_cast<FaceIndex>(angles_.size());
    Mesh sides;
    sides.vertices.reserve(2 * angles_.size());
    sides.faces.reserve(2 * angles_.size());
    add_corners(start, sides.vertices);
    add_corners(*last_ring_, sides.vertices);
    for (FaceIndex k = 0; k < n; ++k) {
        const FaceIndex next = (k + 1) % n;
        sides.faces.push_back({k, k + n, next});
        sides.faces.push_back({next, k + n, next + n});
    }
    add(std::move(sides), color);
}

void MeshDrawing::polygon(std::span<const Vec3> corners, int color) {
    std::vector<Vec3> different(corners.begin(), corners.end());
    different.erase(std::unique(different.begin(), different.end()), different.end());
    while (different.size() > 1 && different.front() == different.back()) {
        different.pop_back();
    }
    if (different.size() >= 3) {
        add({different, cut_polygon(different).faces}, color);
    }
}

void MeshDrawing::triangles(std::span<const Triangle> triangles, int color) {
    add(std::vector<Triangle>(triangles.begin(), triangles.end()), color);
}

void MeshDrawing::sphere(const Vec3& center, double radius, int color) {
    add(sphere_mesh(center, std::abs(radius), static_cast<FaceIndex>(angles_.size())), color);
}

void MeshDrawing::disc(const TurtleFrame& frame, double radius, int color) {
    const auto n = static_cast<FaceIndex>(angles_.size());
    Mesh disc;
    disc.vertices.push_back(frame.position);
    add_corners({frame.position, radius, {frame.up, -frame.heading}}, disc.vertices);
    for (FaceIndex k = 0; k < n; ++k) {
        disc.faces.push_back({0, 1 + k, 1 + (k + 1) % n});
    }
    add(std::move(disc), color);
}

void MeshDrawing::surface(const BezierSurface& surface, const Affine& transform, int color) {
    if (surface.mesh && !surface.mesh->empty()) {
        organ().parts.push_back({color, {}, surface.mesh, transform});
    }
}

std::vector<DrawnOrgan> MeshDrawing::take_organs() {
    last_ring_.reset();
    return std::exchange(organs_, {});
}

}  // namespace quasimc

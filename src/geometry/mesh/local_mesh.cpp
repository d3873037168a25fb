#include "geometry/mesh/local_mesh.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <unordered_map>
#include <utility>

#include "base/checks.h"
#include "geometry/mesh/outline.h"
#include "geometry/mesh/sliver.h"

namespace quasimc {

namespace {

/// The power of two that takes `half_extent` into (1/2, 1].
double scale_to_unit(double half_extent) {
    if (!(half_extent > 0)) {
        return 1;
    }
    int exponent = 0;
    if (std::frexp(half_extent, &exponent) == 0.5) {
        --exponent;
    }
    constexpr int kLargest = 1000;  // keeps the scale and the neighbours of its square root finite
    return std::ldexp(1.0, std::clamp(-exponent, -kLargest, kLargest));
}

Bounds bounds_of(std::span<const Vec3> points) {
    Bounds bounds;
    for (const Vec3& p : points) {
        EXPECT(is_finite(p));
        bounds.add(p);
    }
    return bounds;
}

/// (points - origin) * scale in single precision, plus padding.
std::vector<float> to_floats(std::span<const Vec3> points, const Vec3& origin, double scale) {
    std::vector<float> floats;
    floats.reserve(3 * points.size() + kVertexPadding);
    for (const Vec3& point : points) {
        const Vec3 p = scale * (point - origin);
        floats.push_back(static_cast<float>(p.x));
        floats.push_back(static_cast<float>(p.y));
        floats.push_back(static_cast<float>(p.z));
    }
    floats.resize(floats.size() + kVertexPadding, 0.0F);
    return floats;
}

/// Makes the prototypes and instances of a scene's local mesh.
class InstanceMaker {
  public:
    explicit InstanceMaker(LocalMesh& mesh) : mesh_(mesh) {}

    void add(const Instance& instance) {
        const auto [known, is_new] = known_.try_emplace(instance.mesh.get(), known_.size());
        if (is_new) {
            add_prototype(instance.mesh);
        }
        // (A (c + v / s) + shift - origin) * scale, for a vertex v relative to the prototype's
        // centre c
        const Frame& frame = frames_[known->second];
        const Affine& a = instance.transform;
        const double factor = mesh_.scale / frame.scale;
        const Vec3 shift = mesh_.to_local(a.point(frame.center));
        LocalInstance& local = mesh_.instances.emplace_back();
        local.prototype = static_cast<std::uint32_t>(known->second);
        const std::array<double, 3> shifts{shift.x, shift.y, shift.z};
        for (std::size_t row = 0; row < 3; ++row) {
            local.matrix[row] = static_cast<float>(factor * a.rows[row].x);
            local.matrix[row + 3] = static_cast<float>(factor * a.rows[row].y);
            local.matrix[row + 6] = static_cast<float>(factor * a.rows[row].z);
            local.matrix[row + 9] = static_cast<float>(shifts[row]);
        }
    }

  private:
    struct Frame {
        Vec3 center;
        double scale = 1;
    };

    void add_prototype(const std::shared_ptr<const Mesh>& mesh) {
        const Bounds bounds = bounds_of(mesh->vertices);
        const Frame& frame = frames_.emplace_back(Frame{bounds.center(), local_scale(bounds)});
        LocalPrototype& prototype = mesh_.prototypes.emplace_back();
        prototype.vertices = to_floats(mesh->vertices, frame.center, frame.scale);
        prototype.mesh = mesh;
        std::vector<Vec3> points;
        for (std::size_t i = 0; i < mesh->vertices.size(); ++i) {
            const float* v = &prototype.vertices[3 * i];
            points.push_back({v[0], v[1], v[2]});
        }
        prototype.outline = outline_points(points, 3 * mesh->size());
    }

    LocalMesh& mesh_;
    std::vector<Frame> frames_;
    std::unordered_map<const Mesh*, std::size_t> known_;
};

/// Lists the triangles that rounding changes, measures the change of the others, and checks for
/// slivers.
void list_thin(const Mesh& mesh, LocalMesh& local) {
    constexpr double kMaxBlur = 1e-3;
    double most = 0;  // squared
    for (std::uint32_t i = 0; i < mesh.faces.size(); ++i) {
        const auto& [a, b, c] = mesh.faces[i];
        const Vec3 exact = local.scale * local.scale * area_vector(mesh[i]);
        const Vec3 corner = local.own_vertex(a);
        const Vec3 edge1 = local.own_vertex(b) - corner;
        const Vec3 edge2 = local.own_vertex(c) - corner;
        local.has_slivers = local.has_slivers || is_sliver(edge1, edge2);
        const Vec3 rounded = cross(edge1, edge2);
        const Vec3 off = rounded - exact;
        const double whole = dot(rounded, rounded);
        if (dot(off, off) > kMaxBlur * kMaxBlur * whole) {
            local.thin.emplace(i, exact);
        } else if (whole > 0) {
            most = std::max(most, dot(off, off) / whole);
        }
    }
    local.most_turned = std::sqrt(most);
}

/// The part of a local mesh without instances.
/// @param bounds  of the whole scene
LocalMesh make_own_part(const Mesh& mesh, const Bounds& bounds) {
    LocalMesh local;
    local.origin = bounds.center();
    local.scale = local_scale(bounds);
    local.vertices = to_floats(mesh.vertices, local.origin, local.scale);
    local.faces = mesh.faces;
    list_thin(mesh, local);
    return local;
}

}  // namespace

double LocalMesh::share_of_thin(std::uint32_t triangle, const Vec3& direction) const {
    const auto found = thin.find(triangle);
    const double rounded = std::abs(dot(across(triangle), direction));
    return found == thin.end() || rounded == 0 ? 1
                                               : std::abs(dot(found->second, direction)) / rounded;
}

double LocalMesh::area_share_of_thin(std::uint32_t triangle) const {
    const auto found = thin.find(triangle);
    const double rounded = length(across(triangle));
    return found == thin.end() || rounded == 0 ? 1 : length(found->second) / rounded;
}

Vec3 LocalMesh::exact_across(std::uint32_t triangle) const {
    const auto found = thin.find(triangle);
    const bool is_thin = found != thin.end() && dot(found->second, found->second) > 0;
    return is_thin ? found->second : across(triangle);
}

Vec3 LocalMesh::instance_vertex(std::uint32_t triangle, int corner) const {
    const std::uint32_t range = ranges.find(triangle);
    const LocalInstance& instance = instances[range];
    const LocalPrototype& prototype = prototypes[instance.prototype];
    const Face& face = prototype.mesh->faces[triangle - ranges.first(range)];
    const float* v = &prototype.vertices[std::size_t{3} * face[static_cast<std::size_t>(corner)]];
    return instance.point({v[0], v[1], v[2]});
}

double local_scale(const Bounds& bounds) {
    const Vec3 half = 0.5 * bounds.size();
    return scale_to_unit(std::max({half.x, half.y, half.z}));
}

LocalMesh make_local_mesh(const std::vector<Triangle>& triangles) {
    return make_local_mesh(std::make_shared<const SceneGeometry>(Mesh(triangles)));
}

LocalMesh make_local_mesh(const std::shared_ptr<const SceneGeometry>& geometry) {
    EXPECT(!geometry->empty());
    Bounds bounds = bounds_of(geometry->mesh().vertices);
    for (const Bounds& box : instance_bounds(geometry->instances())) {
        EXPECT(is_finite(box.low) && is_finite(box.high));
        bounds.add(box.low);
        bounds.add(box.high);
    }
    LocalMesh local = make_own_part(geometry->mesh(), bounds);
    local.owner_of_faces = geometry;
    InstanceMaker maker(local);
    local.instances.reserve(geometry->instances().size());
    for (const Instance& instance : geometry->instances()) {
        maker.add(instance);
    }
    local.ranges = geometry->ranges();
    local.instance_triangles = static_cast<std::uint32_t>(geometry->size() - local.faces.size());
    for_each_outer_vertex(local, [&](const Vec3& p) { local.bounds.add(p); });
    return local;
}

Cell local_cell(const LocalMesh& mesh, const Cell& world) {
    Cell cell = world;
    cell.low_x = mesh.scale * (world.low_x - mesh.origin.x);
    cell.low_y = mesh.scale * (world.low_y - mesh.origin.y);
    cell.size_x = mesh.scale * world.size_x;
    cell.size_y = mesh.scale * world.size_y;
    return cell;
}

std::vector<Vec3> outline_points(const LocalMesh& mesh) {
    const auto for_each = [&](const auto& visit) { for_each_outer_vertex(mesh, visit); };
    return outline_of(for_each, mesh.bounds, std::size_t{3} * mesh.triangle_count());
}

}  // namespace quasimc

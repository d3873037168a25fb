#include "io/meshes/opf_shapes.h"

#include <algorithm>

#include <fmt/format.h>

namespace quasimc {

const OpfMesh* OpfLibrary::find_mesh(std::int64_t shape) const {
    const auto found = shapes.find(shape);
    if (found == shapes.end() || !found->second.mesh) {
        return nullptr;
    }
    const auto mesh = meshes.find(*found->second.mesh);
    return mesh == meshes.end() ? nullptr : &mesh->second;
}

std::string OpfLibrary::material_of(std::int64_t shape) const {
    const auto found = shapes.find(shape);
    return found == shapes.end() || !found->second.material
               ? ""
               : fmt::format("material {}", *found->second.material);
}

std::vector<Vec3> placed_points(const OpfMesh& mesh, const OpfPlace& place) {
    Bounds bounds;
    for (const Vec3& p : mesh.points) {
        bounds.add(p);
    }
    const double from = mesh.points.empty() ? 0 : bounds.low.x;
    const double length = mesh.points.empty() ? 0 : bounds.high.x - from;
    std::vector<Vec3> placed;
    placed.reserve(mesh.points.size());
    for (Vec3 p : mesh.points) {
        if (mesh.is_scaled) {
            const double along = length > 0 ? (p.x - from) / length : 0;
            const double diameter =
                place.diameter_down + along * (place.diameter_up - place.diameter_down);
            p.y *= diameter;
            p.z *= diameter;
        }
        placed.push_back(place.transform.point(p));
    }
    return placed;
}

}  // namespace quasimc

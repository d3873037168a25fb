#include "io/meshes/glb_meshes.h"

#include "base/length_units.h"
#include "geometry/mesh/mesh.h"
#include "io/meshes/file_axes.h"

namespace quasimc {

GlbMeshes::GlbMeshes(const Scene& scene)
    : scene_(scene),
      outward_(to_y_up(scene.orientation().up(), metres_per(scene.length_unit()).value_or(1))),
      numbers_(scene.triangles().mesh().vertices.size(), kNone) {}

Mesh GlbMeshes::mesh(std::uint32_t first, std::uint32_t count) {
    const auto moved = [this](const Vec3& p) {
        return outward_.point(scene_.orientation().outward(p));
    };
    const Mesh& shared = scene_.triangles().mesh();
    std::vector<Triangle> apart;
    std::vector<std::uint32_t> taken;
    Mesh mesh;
    for (std::uint32_t i = first; i < first + count; ++i) {
        if (i >= shared.faces.size()) {
            const Triangle t = scene_.triangles()[i];
            apart.push_back({moved(t[0]), moved(t[1]), moved(t[2])});
            continue;
        }
        Face face = shared.faces[i];
        for (std::uint32_t& vertex : face) {
            if (numbers_[vertex] == kNone) {
                numbers_[vertex] = static_cast<std::uint32_t>(taken.size());
                taken.push_back(vertex);
                mesh.vertices.push_back(moved(shared.vertices[vertex]));
            }
            vertex = numbers_[vertex];
        }
        mesh.faces.push_back(face);
    }
    for (const std::uint32_t vertex : taken) {
        numbers_[vertex] = kNone;
    }
    return apart.empty() ? mesh : Mesh(apart);
}

Vec3 middle_of(const std::vector<Vec3>& points) {
    Bounds bounds;
    for (const Vec3& point : points) {
        bounds.add(point);
    }
    return bounds.empty() ? Vec3{} : bounds.center();
}

}  // namespace quasimc

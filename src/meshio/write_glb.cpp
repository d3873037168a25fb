#include <utility>

#include <nlohmann/json.hpp>

#include "meshio/formats.h"
#include "meshio/glb_parts.h"
#include "scene/scene.h"
#include "text/line_scanner.h"
#include "text/little_endian.h"

namespace quasimc {
namespace {

/// Writes a node and a mesh for each organ of a scene.
class GlbWriter {
  public:
    explicit GlbWriter(const Scene& scene)
        : scene_(scene),
          meshes_(scene),
          points_(parts_.add_view(kGlbPoints)),
          indices_(parts_.add_view(kGlbIndices)) {}

    void write(const TextSink& sink) {
        for (const Organ& organ : scene_.organs()) {
            add_organ(organ);
        }
        std::string materials;
        for (const std::string& name : scene_.material_names()) {
            append_json(materials, {{"name", name}, {"doubleSided", true}});
        }
        std::vector<std::pair<std::string_view, std::string>> members{
            {"scenes", glb_scene(scene_.organs().size())},
            {"nodes", "[" + nodes_ + "]"},
            {"materials", "[" + materials + "]"}};
        if (mesh_count_ > 0) {
            members.emplace_back("meshes", "[" + mesh_list_ + "]");
        }
        parts_.write(members, sink);
    }

  private:
    void add_organ(const Organ& organ) {
        const std::vector<std::pair<RegionIndex, Mesh>> regions = regions_of(organ);
        std::vector<Vec3> points;
        for (const auto& [region, mesh] : regions) {
            points.insert(points.end(), mesh.vertices.begin(), mesh.vertices.end());
        }
        const Vec3 origin = middle_of(points);
        add_node(organ, origin, !regions.empty());
        if (regions.empty()) {
            return;
        }
        Json primitives = Json::array();
        for (const auto& [region, mesh] : regions) {
            primitives.push_back(primitive_of(scene_.regions()[region.value], mesh, origin));
        }
        append_json(mesh_list_, {{"name", organ.name}, {"primitives", primitives}});
        ++mesh_count_;
    }

    /// The meshes of an organ, one per region.
    [[nodiscard]] std::vector<std::pair<RegionIndex, Mesh>> regions_of(const Organ& organ) {
        std::vector<std::pair<RegionIndex, Mesh>> regions;
        const std::uint32_t end = organ.first_triangle + organ.triangle_count;
        for (std::uint32_t first = organ.first_triangle; first < end;) {
            const RegionIndex region = data_of(scene_).region_of(first);
            std::uint32_t last = first + 1;
            while (last < end && data_of(scene_).region_of(last) == region) {
                ++last;
            }
            regions.emplace_back(region, meshes_.mesh(first, last - first));
            first = last;
        }
        return regions;
    }

    void add_node(const Organ& organ, const Vec3& origin, bool has_mesh) {
        Json node = {{"name", organ.name}};
        if (has_mesh) {
            node["mesh"] = mesh_count_;
            node["translation"] = {origin.x, origin.y, origin.z};
        }
        Json& extras = node["extras"];
        extras["id"] = organ.id;
        for (const auto& [key, value] : organ.labels) {
            extras[key == "id" ? "label_id" : key] = value;
        }
        append_json(nodes_, node);
    }

    [[nodiscard]] Json primitive_of(const Region& region, const Mesh& mesh, const Vec3& origin) {
        std::string indices;
        for (const Face& face : mesh.faces) {
            for (const std::uint32_t vertex : face) {
                append_little_endian(indices, vertex);
            }
        }
        const std::size_t points = parts_.add_points(points_, mesh.vertices, origin);
        return {
            {"attributes", {{"POSITION", points}}},
            {"indices", parts_.add_list(indices_, indices)},
            {"material", region.material.value}};
    }

    const Scene& scene_;
    GlbMeshes meshes_;
    GlbParts parts_;
    std::size_t points_, indices_;   // views
    std::string nodes_, mesh_list_;  // texts of lists
    std::size_t mesh_count_ = 0;
};

}  // namespace

void write_glb(const Scene& scene, const TextSink& sink) {
    GlbWriter(scene).write(sink);
}

}  // namespace quasimc

#include <utility>

#include <fmt/format.h>

#include "io/line_scanner.h"
#include "io/little_endian.h"
#include "io/meshes/formats.h"
#include "io/meshes/glb_parts.h"

namespace quasimc {
namespace {

/// Writes the organs of a scene one after the other: a node and a mesh each.
class GlbWriter {
  public:
    explicit GlbWriter(const Scene& scene)
        : scene_(scene),
          meshes_(scene),
          points_(parts_.add_view(kGlbPoints)),
          indices_(parts_.add_view(kGlbIndices)) {}

    void write(const TextSink& sink) {
        nodes_.begin_list(JsonLayout::compact);
        mesh_list_.begin_list(JsonLayout::compact);
        for (const Organ& organ : scene_.organs()) {
            add_organ(organ);
        }
        nodes_.end_list();
        mesh_list_.end_list();
        const std::string meshes = mesh_list_.take();
        parts_.write(
            glb_scene_members(scene_.organs().size()) + ",\"nodes\":" + nodes_.take() +
                (mesh_count_ > 0 ? ",\"meshes\":" + meshes : "") + ",\"materials\":" + materials(),
            sink);
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
        mesh_list_.begin_object(JsonLayout::compact);
        mesh_list_.text("name", organ.name);
        mesh_list_.key("primitives");
        mesh_list_.begin_list(JsonLayout::compact);
        for (const auto& [region, mesh] : regions) {
            add_primitive(scene_.regions()[region.value], mesh, origin);
        }
        mesh_list_.end_list();
        mesh_list_.end_object();
        ++mesh_count_;
    }

    /// The triangles of an organ that are of one material stand together.
    [[nodiscard]] std::vector<std::pair<RegionIndex, Mesh>> regions_of(const Organ& organ) {
        std::vector<std::pair<RegionIndex, Mesh>> regions;
        const std::uint32_t end = organ.first_triangle + organ.triangle_count;
        for (std::uint32_t first = organ.first_triangle; first < end;) {
            const RegionIndex region = scene_.region_of(first);
            std::uint32_t last = first + 1;
            while (last < end && scene_.region_of(last) == region) {
                ++last;
            }
            regions.emplace_back(region, meshes_.mesh(first, last - first));
            first = last;
        }
        return regions;
    }

    void add_node(const Organ& organ, const Vec3& origin, bool has_mesh) {
        nodes_.begin_object(JsonLayout::compact);
        nodes_.text("name", organ.name);
        if (has_mesh) {
            nodes_.count("mesh", mesh_count_);
            add_json_numbers(nodes_, "translation", {origin.x, origin.y, origin.z});
        }
        nodes_.key("extras");
        nodes_.begin_object(JsonLayout::compact);
        nodes_.key("id");
        nodes_.integer(organ.id);
        for (const auto& [key, value] : organ.labels) {
            nodes_.text(key == "id" ? "label_id" : key, value);
        }
        nodes_.end_object();
        nodes_.end_object();
    }

    void add_primitive(const Region& region, const Mesh& mesh, const Vec3& origin) {
        std::string indices;
        for (const Face& face : mesh.faces) {
            for (const std::uint32_t vertex : face) {
                append_little_endian(indices, vertex);
            }
        }
        mesh_list_.begin_object(JsonLayout::compact);
        mesh_list_.key("attributes");
        mesh_list_.begin_object(JsonLayout::compact);
        mesh_list_.count("POSITION", parts_.add_points(points_, mesh.vertices, origin));
        mesh_list_.end_object();
        mesh_list_.count("indices", parts_.add_list(indices_, indices));
        mesh_list_.count("material", region.material.value);
        mesh_list_.end_object();
    }

    [[nodiscard]] std::string materials() const {
        JsonStream json;
        json.begin_list(JsonLayout::compact);
        for (const std::string& name : scene_.material_names()) {
            json.begin_object(JsonLayout::compact);
            json.text("name", name);
            json.boolean("doubleSided", true);
            json.end_object();
        }
        json.end_list();
        return json.take();
    }

    const Scene& scene_;
    GlbMeshes meshes_;
    GlbParts parts_;
    std::size_t points_, indices_;  // views
    JsonStream nodes_, mesh_list_;
    std::size_t mesh_count_ = 0;
};

}  // namespace

void write_glb(const Scene& scene, const TextSink& sink) {
    GlbWriter(scene).write(sink);
}

}  // namespace quasimc

#include "meshio/glb_parts.h"

#include <array>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/length_units.h"
#include "geometry/mesh/mesh.h"
#include "meshio/file_axes.h"
#include "quasimc/error.h"
#include "quasimc/version.h"
#include "text/little_endian.h"

namespace quasimc {
namespace {

constexpr std::uint64_t kGlbHeaders = 12 + 8 + 8;

std::uint64_t padded(std::uint64_t bytes) {
    return (bytes + 3) / 4 * 4;
}

}  // namespace

std::size_t GlbParts::add_view(const GlbNumbers& kind) {
    views_.push_back({kind, 0, std::make_unique<Spool>()});
    return views_.size() - 1;
}

std::size_t GlbParts::add_list(std::size_t view, std::string_view bytes, const Bounds* bounds) {
    View& target = views_[view];
    Json accessor = {
        {"bufferView", view},
        {"byteOffset", target.size},
        {"componentType", target.kind.component_type},
        {"count", bytes.size() / target.kind.bytes},
        {"type", target.kind.type}};
    if (target.kind.is_normalized) {
        accessor["normalized"] = true;
    }
    if (bounds != nullptr && !bounds->empty()) {
        const auto& [low, high] = *bounds;
        accessor["min"] = {low.x, low.y, low.z};
        accessor["max"] = {high.x, high.y, high.z};
    }
    append_json(accessors_, accessor);
    target.bytes->add(bytes);
    target.size += bytes.size();
    return lists_++;
}

std::size_t GlbParts::add_points(
    std::size_t view, const std::vector<Vec3>& points, const Vec3& origin) {
    Bounds bounds;
    std::string bytes;
    for (const Vec3& point : points) {
        const Vec3 p = point - origin;
        const std::array<float, 3> xyz{
            static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
        for (const float number : xyz) {
            append_little_endian(bytes, number);
        }
        bounds.add({xyz[0], xyz[1], xyz[2]});
    }
    return add_list(view, bytes, &bounds);
}

void GlbParts::write(
    const std::vector<std::pair<std::string_view, std::string>>& members, const TextSink& sink) {
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
    constexpr std::uint64_t kArrayBuffer = 34962, kIndexBuffer = 34963;
    Json views = Json::array();
    std::uint64_t bytes = 0;
    for (const View& view : views_) {
        Json& one = views.emplace_back(
            Json{{"buffer", 0}, {"byteOffset", bytes}, {"byteLength", view.size}});
        if (!view.kind.is_index) {
            one["byteStride"] = view.kind.bytes;
        }
        one["target"] = view.kind.is_index ? kIndexBuffer : kArrayBuffer;
        bytes += view.size;
    }
    std::string json = json_text(
        {{"asset", {{"version", "2.0"}, {"generator", "QuasiMC " + std::string(version())}}},
         {"scene", 0},
         {"bufferViews", views},
         {"buffers", Json::array({Json{{"byteLength", bytes}}})}});
    json.pop_back();
    for (const auto& [key, text] : members) {
        json += fmt::format(",\"{}\":{}", key, text);
    }
    json += ",\"accessors\":[" + accessors_ + "]}";
    json.resize(padded(json.size()), ' ');
    if (kGlbHeaders + json.size() + bytes > kMost) {
        throw InputError({{"GLB", "the file would have 4 GiB or more", "GLB files have less", ""}});
    }
    std::string head = "glTF";
    append_little_endian(head, std::uint32_t{2});
    append_little_endian(head, static_cast<std::uint32_t>(kGlbHeaders + json.size() + bytes));
    append_little_endian(head, static_cast<std::uint32_t>(json.size()));
    sink(head + "JSON");
    sink(json);
    std::string binary_head;
    append_little_endian(binary_head, static_cast<std::uint32_t>(bytes));
    sink(binary_head + std::string("BIN\0", 4));
    for (const View& view : views_) {
        view.bytes->copy_to(sink);
    }
}

GlbMeshes::GlbMeshes(const Scene& scene)
    : scene_(scene),
      outward_(to_y_up(scene.orientation().up(), metres_per(scene.length_unit()).value_or(1))),
      numbers_(data_of(scene).triangles().mesh().vertices.size(), kNone) {}

Mesh GlbMeshes::mesh(std::uint32_t first, std::uint32_t count) {
    const auto moved = [this](const Vec3& p) {
        return outward_.point(scene_.orientation().outward(p));
    };
    const Mesh& shared = data_of(scene_).triangles().mesh();
    std::vector<Triangle> apart;
    std::vector<std::uint32_t> taken;
    Mesh mesh;
    for (std::uint32_t i = first; i < first + count; ++i) {
        if (i >= shared.faces.size()) {
            const Triangle t = data_of(scene_).triangles()[i];
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

std::string glb_scene(std::size_t roots) {
    Json nodes = Json::array();
    for (std::size_t i = 0; i < roots; ++i) {
        nodes.push_back(i);
    }
    return json_text(Json::array({Json{{"nodes", nodes}}}));
}

}  // namespace quasimc

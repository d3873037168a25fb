#include "io/meshes/glb_parts.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "base/length_units.h"
#include "geometry/mesh/mesh.h"
#include "io/little_endian.h"
#include "io/meshes/file_axes.h"
#include "quasimc/error.h"
#include "quasimc/version.h"

namespace quasimc {
namespace {

constexpr std::uint64_t kGlbHeaders = 12 + 8 + 8;

std::uint64_t padded(std::uint64_t bytes) {
    return (bytes + 3) / 4 * 4;
}

}  // namespace

GlbParts::GlbParts() {
    accessors_.begin_list(JsonLayout::compact);
}

std::size_t GlbParts::add_view(const GlbNumbers& kind) {
    views_.push_back({kind, 0, std::make_unique<Spool>()});
    return views_.size() - 1;
}

std::size_t GlbParts::add_list(std::size_t view, std::string_view bytes, const Bounds* bounds) {
    View& place = views_[view];
    accessors_.begin_object(JsonLayout::compact);
    accessors_.count("bufferView", view);
    accessors_.count("byteOffset", place.size);
    accessors_.count("componentType", place.kind.component_type);
    accessors_.count("count", bytes.size() / place.kind.bytes);
    accessors_.text("type", place.kind.type);
    if (place.kind.is_normalized) {
        accessors_.boolean("normalized", true);
    }
    if (bounds != nullptr && !bounds->empty()) {
        const auto& [low, high] = *bounds;
        add_json_numbers(accessors_, "min", {low.x, low.y, low.z});
        add_json_numbers(accessors_, "max", {high.x, high.y, high.z});
    }
    accessors_.end_object();
    place.bytes->add(bytes);
    place.size += bytes.size();
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

void GlbParts::write(const std::string& members, const TextSink& sink) {
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
    constexpr std::uint64_t kArrayBuffer = 34962, kIndexBuffer = 34963;
    JsonStream views;
    std::uint64_t bytes = 0;
    views.begin_list(JsonLayout::compact);
    for (const View& view : views_) {
        views.begin_object(JsonLayout::compact);
        views.count("buffer", 0);
        views.count("byteOffset", bytes);
        views.count("byteLength", view.size);
        if (!view.kind.is_index) {
            views.count("byteStride", view.kind.bytes);
        }
        views.count("target", view.kind.is_index ? kIndexBuffer : kArrayBuffer);
        views.end_object();
        bytes += view.size;
    }
    views.end_list();
    accessors_.end_list();
    std::string json = fmt::format(
        "{{{},\"accessors\":{},\"bufferViews\":{},\"buffers\":[{{\"byteLength\":{}}}]}}", members,
        accessors_.take(), views.take(), bytes);
    json.resize(padded(json.size()), ' ');
    if (kGlbHeaders + json.size() + bytes > kMost) {
        throw InputError({{"GLB", "the file would have 4 GiB or more", "no GLB file can", ""}});
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

void add_json_numbers(
    JsonStream& json, std::string_view key, std::initializer_list<double> numbers) {
    json.key(key);
    json.begin_list(JsonLayout::compact);
    for (const double number : numbers) {
        json.number(number);
    }
    json.end_list();
}

std::string glb_scene_members(std::size_t roots) {
    JsonStream json;
    json.begin_list(JsonLayout::compact);
    for (std::size_t i = 0; i < roots; ++i) {
        json.count(i);
    }
    json.end_list();
    return fmt::format(
        "\"asset\":{{\"version\":\"2.0\",\"generator\":\"QuasiMC {}\"}},\"scene\":0,\"scenes\":[{{"
        "\"nodes\":{}}}]",
        version(), json.take());
}

}  // namespace quasimc

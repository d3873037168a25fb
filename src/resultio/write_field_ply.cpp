#include <algorithm>
#include <cctype>
#include <cstdint>

#include <fmt/format.h>

#include "resultio/field_formats.h"
#include "scene/scene.h"
#include "text/little_endian.h"

namespace quasimc {
namespace {

/// A name of a property is one word.
std::string property_name(std::string name) {
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0 && c < 0x80; },
        '_');
    return name;
}

std::string field_ply_header(const Scene& scene, std::span<const OrganField> fields) {
    const std::size_t triangles = scene.triangle_count();
    std::string text = "ply\nformat binary_little_endian 1.0\n";
    for (const OrganField& field : fields) {
        text += fmt::format(
            "comment {} [{}]\n", property_name(field.name), field.unit.empty() ? "1" : field.unit);
    }
    text += fmt::format(
        "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
        "element face {}\nproperty list uchar uint vertex_indices\nproperty double organ\n",
        3 * triangles, triangles);
    for (const OrganField& field : fields) {
        text += fmt::format("property double {}\n", property_name(field.name));
    }
    return text + "end_header\n";
}

}  // namespace

void write_field_ply(const FieldScene& shown, const TextSink& sink) {
    const Scene& scene = shown.scene;
    const std::vector<OrganField>& fields = shown.fields;
    constexpr std::uint8_t kCorners = 3;
    sink(field_ply_header(scene, fields));
    const auto triangles = static_cast<std::uint32_t>(scene.triangle_count());
    for (std::uint32_t i = 0; i < triangles; ++i) {
        std::string bytes;
        for (const Vec3& corner : data_of(scene).triangles()[i]) {
            const Vec3 p = scene.orientation().outward(corner);
            append_little_endian(bytes, p.x);
            append_little_endian(bytes, p.y);
            append_little_endian(bytes, p.z);
        }
        sink(bytes);
    }
    for (std::uint32_t i = 0; i < triangles; ++i) {
        std::string bytes;
        append_little_endian(bytes, kCorners);
        for (std::uint32_t corner = 0; corner < kCorners; ++corner) {
            append_little_endian(bytes, kCorners * i + corner);
        }
        const std::uint32_t organ = scene.regions()[data_of(scene).region_of(i).value].organ.value;
        append_little_endian(bytes, static_cast<double>(scene.organs()[organ].id));
        for (const OrganField& field : fields) {
            append_little_endian(bytes, field.values[organ]);
        }
        sink(bytes);
    }
}

}  // namespace quasimc

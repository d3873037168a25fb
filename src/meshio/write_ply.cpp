#include <fmt/format.h>

#include "meshio/formats.h"
#include "scene/scene.h"
#include "text/line_scanner.h"
#include "text/little_endian.h"

namespace quasimc {
namespace {

std::string header(const Scene& scene) {
    std::string text = "ply\nformat binary_little_endian 1.0\n";
    for (std::size_t m = 0; m < data_of(scene).materials.size(); ++m) {
        text += fmt::format(
            "comment material {} = {}\n", m, one_line(data_of(scene).materials[m].name()));
    }
    const std::size_t triangles = scene.triangle_count();
    return text + fmt::format(
                      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
                      "element face {}\nproperty list uchar uint vertex_indices\n"
                      "property double organ\nproperty int material\nend_header\n",
                      3 * triangles, triangles);
}

}  // namespace

void write_ply(const Scene& scene, const TextSink& sink) {
    sink(header(scene));
    std::string bytes;
    for (const Triangle triangle : data_of(scene).triangles()) {
        bytes.clear();
        for (const Vec3& corner : triangle) {
            const Vec3 p = scene.orientation().outward(corner);
            append_little_endian(bytes, p.x);
            append_little_endian(bytes, p.y);
            append_little_endian(bytes, p.z);
        }
        sink(bytes);
    }
    for (std::uint32_t i = 0; i < scene.triangle_count(); ++i) {
        const Region& element = scene.regions()[data_of(scene).region_of(i).value];
        bytes.clear();
        append_little_endian(bytes, std::uint8_t{3});
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            append_little_endian(bytes, 3 * i + corner);
        }
        append_little_endian(bytes, static_cast<double>(scene.organs()[element.organ.value].id));
        append_little_endian(bytes, static_cast<std::int32_t>(element.material.value));
        sink(bytes);
    }
}

}  // namespace quasimc

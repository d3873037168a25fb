#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "meshio/formats.h"
#include "scene/scene.h"
#include "text/line_scanner.h"

namespace quasimc {

void write_stl(const Scene& scene, const TextSink& sink) {
    for (const Organ& organ : scene.organs()) {
        std::string text = "solid " + one_line(organ.name) + "\n";
        for (std::uint32_t i = 0; i < organ.triangle_count; ++i) {
            const Triangle triangle = data_of(scene).triangles()[organ.first_triangle + i];
            const Vec3 across = area_vector(triangle);
            const double size = length(across);
            const Vec3 n = scene.orientation().outward(size > 0 ? across / size : Vec3{});
            fmt::format_to(
                std::back_inserter(text), "facet normal {} {} {}\nouter loop\n", n.x, n.y, n.z);
            for (const Vec3& corner : triangle) {
                const Vec3 p = scene.orientation().outward(corner);
                fmt::format_to(std::back_inserter(text), "vertex {} {} {}\n", p.x, p.y, p.z);
            }
            text += "endloop\nendfacet\n";
        }
        sink(text + "endsolid\n");
    }
}

}  // namespace quasimc

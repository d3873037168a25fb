#include <iterator>

#include <fmt/format.h>

#include "meshio/formats.h"
#include "scene/scene.h"
#include "text/line_scanner.h"

namespace quasimc {

void write_tri(const Scene& scene, const TextSink& sink) {
    for (const Organ& organ : scene.organs()) {
        std::string text = fmt::format("# organ {} {}\n", organ.id, shown(organ.name));
        for (std::uint32_t i = 0; i < organ.triangle_count; ++i) {
            std::string_view separator;
            for (const Vec3& corner : data_of(scene).triangles()[organ.first_triangle + i]) {
                const Vec3 p = scene.orientation().outward(corner);
                fmt::format_to(std::back_inserter(text), "{}{} {} {}", separator, p.x, p.y, p.z);
                separator = " ";
            }
            text += '\n';
        }
        sink(text);
    }
}

}  // namespace quasimc

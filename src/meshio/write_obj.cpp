#include <algorithm>
#include <iterator>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "meshio/formats.h"
#include "scene/scene.h"
#include "text/line_scanner.h"

namespace quasimc {
namespace {

/// Makes a name valid in a statement: one line, no comment.
std::string statement_name(std::string name) {
    std::replace_if(
        name.begin(), name.end(),
        [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '#' || c == '\\'; }, '_');
    return name;
}

/// The statements of an organ's elements, one text each.
std::vector<std::string> element_texts(const Scene& scene, const Organ& organ) {
    std::vector<std::string> texts;
    for (std::uint32_t e = 0; e < organ.region_count; ++e) {
        const Region& element = scene.regions()[organ.first_region + e];
        texts.push_back("usemtl " + statement_name(scene.material_name(element)) + "\n");
    }
    for (std::uint32_t i = 0; i < organ.triangle_count; ++i) {
        const std::uint32_t triangle = organ.first_triangle + i;
        std::string& text = texts[data_of(scene).region_of(triangle).value - organ.first_region];
        for (const Vec3& corner : data_of(scene).triangles()[triangle]) {
            const Vec3 p = scene.orientation().outward(corner);
            fmt::format_to(std::back_inserter(text), "v {} {} {}\n", p.x, p.y, p.z);
        }
        text += "f -3 -2 -1\n";
    }
    return texts;
}

}  // namespace

void write_obj(const Scene& scene, const TextSink& sink) {
    std::set<std::string> names;
    for (const Organ& organ : scene.organs()) {
        std::string name = statement_name(organ.name);
        if (!names.insert(name).second) {
            name += fmt::format(" {}", organ.id);
            names.insert(name);
        }
        sink("o " + name + "\n");
        for (const auto& [key, value] : organ.labels) {
            sink(fmt::format("{}{} = {}\n", kObjLabel, one_line(key), one_line(value)));
        }
        for (const std::string& text : element_texts(scene, organ)) {
            sink(text);
        }
    }
}

}  // namespace quasimc

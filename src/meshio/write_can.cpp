#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "meshio/can_label.h"
#include "meshio/formats.h"
#include "scene/scene.h"

namespace quasimc {
namespace {

/// Whether the ids of all organs are labels, as in scenes read from such a file.
bool ids_are_labels(const Scene& scene) {
    const std::int64_t first = CanLabel{.species = 1}.number();
    return std::all_of(scene.organs().begin(), scene.organs().end(), [first](const Organ& organ) {
        return organ.is_ground || organ.id >= first;
    });
}

/// Makes a label for an organ without one: the material is the species, leaves are counted.
std::int64_t made_label(const Scene& scene, std::size_t organ, std::uint32_t triangle) {
    constexpr std::size_t kMaxLeaves = 999;
    if (scene.organs()[organ].is_ground) {
        return 0;
    }
    CanLabel label;
    label.species = scene.regions()[data_of(scene).region_of(triangle).value].material.value + 1;
    label.plant = static_cast<std::int64_t>(organ / kMaxLeaves) + 1;
    label.leaf = static_cast<std::int64_t>(organ % kMaxLeaves) + 1;
    label.element = 1;
    return label.number();
}

}  // namespace

void write_can(const Scene& scene, const TextSink& sink) {
    const bool keeps_ids = ids_are_labels(scene);
    for (std::size_t o = 0; o < scene.organs().size(); ++o) {
        const Organ& organ = scene.organs()[o];
        std::string text;
        for (std::uint32_t i = 0; i < organ.triangle_count; ++i) {
            const std::uint32_t triangle = organ.first_triangle + i;
            const std::int64_t label =
                keeps_ids && !organ.is_ground ? organ.id : made_label(scene, o, triangle);
            fmt::format_to(std::back_inserter(text), "p 1 {:012} 3", label);
            for (const Vec3& corner : data_of(scene).triangles()[triangle]) {
                const Vec3 p = scene.orientation().outward(corner);
                fmt::format_to(std::back_inserter(text), " {} {} {}", p.x, p.y, p.z);
            }
            text += '\n';
        }
        sink(text);
    }
}

}  // namespace quasimc

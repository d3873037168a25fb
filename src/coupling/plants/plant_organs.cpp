#include "coupling/plants/plant_organs.h"

#include <iterator>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "coupling/lighting.h"
#include "scene/scene.h"

namespace quasimc {
namespace {

/// The symbol of a module as text: "L", or its code where it can't be printed.
std::string drawn_symbol(char symbol) {
    const bool is_printable = symbol > ' ' && symbol <= '~';
    return is_printable ? std::string(1, symbol)
                        : fmt::format("#{}", static_cast<int>(static_cast<unsigned char>(symbol)));
}

std::vector<OrganPart> organ_parts(const DrawnOrgan& drawn) {
    std::vector<OrganPart> parts;
    for (const auto& part : drawn.parts) {
        const bool is_empty = part.shared ? part.shared->empty() : part.triangles.empty();
        if (!is_empty) {
            parts.push_back(
                {color_material(part.color), part.triangles, part.shared, part.transform});
        }
    }
    return parts;
}

OrganSpec organ_without_parts(const DrawnModule& module, std::int64_t step) {
    OrganSpec organ;
    organ.id = static_cast<std::int64_t>(module.index) + 1;
    const std::string symbol = drawn_symbol(module.symbol);
    organ.name = fmt::format("{} {}", symbol, *organ.id);
    organ.labels = {
        {"module", symbol},
        {"step", std::to_string(step)},
        {"branch", std::to_string(module.branch)},
        {"order", std::to_string(module.order)}};
    return organ;
}

}  // namespace

std::string color_material(int color) {
    return fmt::format("color {}", color);
}

std::vector<OrganSpec> plant_organs(const MeshDrawing& drawing, std::int64_t step) {
    std::vector<OrganSpec> organs;
    std::unordered_map<std::size_t, std::size_t> organ_of;  // by module: segments may follow late
    for (const DrawnOrgan& drawn : drawing.organs()) {
        std::vector<OrganPart> parts = organ_parts(drawn);
        if (parts.empty()) {
            continue;
        }
        const auto [entry, is_new] = organ_of.try_emplace(drawn.module.index, organs.size());
        if (is_new) {
            organs.push_back(organ_without_parts(drawn.module, step));
        }
        std::vector<OrganPart>& all = organs[entry->second].parts;
        std::move(parts.begin(), parts.end(), std::back_inserter(all));
    }
    return organs;
}

std::optional<Scene> drawn_plant_scene(const MeshDrawing& drawing, std::int64_t step) {
    std::vector<OrganSpec> organs = plant_organs(drawing, step);
    if (organs.empty()) {
        return std::nullopt;
    }
    SceneBuilder builder({{"none"}}, plant_orientation());
    builder.set_length_unit("");  // the plant's lengths have no unit
    std::set<std::string> materials;
    for (OrganSpec& organ : organs) {
        for (const OrganPart& part : organ.parts) {
            if (materials.insert(part.material).second) {
                // Arbitrary optics: this scene is for files and pages without light.
                builder.add_material(lambertian(part.material, {0.5}));
            }
        }
        builder.add_organ(std::move(organ));
    }
    return std::move(builder).build();
}

}  // namespace quasimc

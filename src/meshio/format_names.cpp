// Finds the format of a name or a file extension.

#include <algorithm>
#include <array>

#include "base/text.h"
#include "meshio/formats.h"

namespace quasimc {

std::vector<std::string> writable_formats() {
    std::vector<std::string> names;
    for (const FormatEntry& entry : format_table()) {
        if (entry.write != nullptr) {
            names.emplace_back(entry.name);
        }
    }
    return names;
}

const FormatEntry* find_format(std::string_view name) {
    const std::span<const FormatEntry> table = format_table();
    const auto found = std::find_if(table.begin(), table.end(), [name](const FormatEntry& entry) {
        return entry.name == name;
    });
    return found == table.end() ? nullptr : &*found;
}

namespace {

/// ".obj" of "Plant.OBJ"; "" of a path without a dot.
std::string extension_of(std::string_view path) {
    const std::size_t dot = path.rfind('.');
    return lower_case(dot == std::string_view::npos ? "" : path.substr(dot));
}

}  // namespace

const ForeignFormat* foreign_format_of_path(std::string_view path) {
    constexpr std::string_view kBlender = "write it as OBJ or GLB, with Blender for example";
    constexpr std::string_view kPlantgl =
        "load it in Python with PlantGL, and give the Scene to quasimc.compat.caribu.CaribuScene "
        "or let it write triangles: Scene(\"plant.geom\").save(\"plant.obj\")";
    static constexpr std::array kForeign{
        ForeignFormat{".geom", "a scene of PlantGL", kPlantgl},
        ForeignFormat{".bgeom", "a binary scene of PlantGL", kPlantgl},
        ForeignFormat{
            ".dae", "a COLLADA file",
            "make glTF of it, with Blender or by `assimp export plant.dae plant.glb`"},
        ForeignFormat{".blend", "a file of Blender", kBlender},
        ForeignFormat{".fbx", "an FBX file", kBlender},
        ForeignFormat{".usd", "a USD file", kBlender},
        ForeignFormat{".usdz", "a USD file", kBlender},
        ForeignFormat{".3ds", "a 3DS file", kBlender},
        ForeignFormat{".x3d", "an X3D file", kBlender},
        ForeignFormat{
            ".mtl", "a library of materials of OBJ files", "name the OBJ file that it belongs to"},
        ForeignFormat{
            ".las", "a cloud of points", "make a mesh of its points first, and write it as PLY"},
        ForeignFormat{
            ".laz", "a cloud of points", "make a mesh of its points first, and write it as PLY"}};
    const std::string extension = extension_of(path);
    const auto* const found = std::find_if(
        kForeign.begin(), kForeign.end(),
        [&](const ForeignFormat& format) { return format.extension == extension; });
    return found == kForeign.end() ? nullptr : found;
}

const FormatEntry* format_of_path(std::string_view path) {
    const std::string extension = extension_of(path);
    if (extension.empty()) {
        return nullptr;
    }
    for (const FormatEntry& entry : format_table()) {
        std::string_view rest = entry.extensions;
        while (!rest.empty()) {
            const std::size_t end = std::min(rest.find(' '), rest.size());
            if (rest.substr(0, end) == extension) {
                return &entry;
            }
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
    }
    return nullptr;
}

}  // namespace quasimc

#include "io/meshes/geometry_scene.h"

#include <filesystem>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "scene/scene_builder.h"

namespace quasimc {
namespace {

std::string name_of(const MeshPart& part) {
    return part.material.empty() ? "unnamed" : part.material;
}

void add_materials(const MeshFile& file, SceneBuilder& builder) {
    std::set<std::string> names;
    for (const MeshGroup& group : file.groups) {
        for (const MeshPart& part : group.parts) {
            if (!names.insert(name_of(part)).second) {
                continue;
            }
            SideOptics side;
            side.reflectance = 0.5;  // of no meaning, but that nobody is warned of black materials
            builder.add_material({name_of(part), {side}, {side}});
        }
    }
}

void add_triangles(const MeshFile& file, SceneBuilder& builder) {
    for (const MeshGroup& group : file.groups) {
        for (const MeshPart& part : group.parts) {
            for (std::size_t i = 0; i < part.faces.size(); ++i) {
                OrganSpec organ;
                organ.labels = group.labels;
                organ.parts.push_back({name_of(part), Mesh{file.triangle(part, i)}});
                builder.add_organ(std::move(organ));
            }
        }
    }
}

void add_groups(MeshFile file, SceneBuilder& builder) {
    std::vector<Mesh> meshes = file.take_meshes();
    std::size_t number = 0;
    for (const MeshGroup& group : file.groups) {
        OrganSpec organ;
        organ.id = group.id;
        organ.name = group.name;
        organ.labels = group.labels;
        for (const MeshPart& part : group.parts) {
            organ.parts.push_back({name_of(part), std::move(meshes[number++])});
        }
        builder.add_organ(std::move(organ));
    }
}

}  // namespace

GeometryScene read_geometry_scene(const std::string& path, const FormatEntry& format) {
    const std::filesystem::path whole(path);
    InputFiles files(path == "-" ? std::filesystem::path() : whole.parent_path());
    const std::string name = path == "-" ? path : whole.filename().string();
    const std::string bytes = files.read(name);
    Reporter reporter{path, {}, {}};
    FormatContext context{reporter, files, ""};
    MeshFile file = read_mesh(format, bytes, context);
    reporter.faults.throw_if_any();
    if (file.groups.empty() || file.groups.front().parts.empty() ||
        file.groups.front().parts.front().faces.empty()) {
        throw InputError({{path, "holds no triangle", "", ""}});
    }
    SceneBuilder builder({{"none"}});
    add_materials(file, builder);
    if (format.organs == "each") {
        add_triangles(file, builder);
    } else {
        add_groups(std::move(file), builder);
    }
    return {
        std::move(builder).build(), std::move(reporter.warnings), files.files(),
        format.has_units ? context.length_unit : ""};
}

}  // namespace quasimc

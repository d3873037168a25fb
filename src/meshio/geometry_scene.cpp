#include "meshio/geometry_scene.h"

#include <filesystem>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/number_text.h"
#include "scene/fold_warnings.h"
#include "scene/scene.h"

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
            side.reflectance = 0.5;  // arbitrary, prevents a warning of black materials
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

/// Formats with a writer that store a property: "obj, ply".
std::string keepers(std::string_view word) {
    std::string names;
    for (const FormatEntry& format : format_table()) {
        if (format.write != nullptr && format.keeps.find(word) != format.keeps.npos) {
            names += fmt::format("{}{}", names.empty() ? "" : ", ", format.name);
        }
    }
    return names;
}

}  // namespace

std::vector<Warning> lost_when_written(const FormatEntry& format, const Scene& scene) {
    std::vector<Warning> lost;
    const auto add = [&](bool has_some, const std::string& things, std::string_view word) {
        if (has_some && format.keeps.find(word) == format.keeps.npos) {
            lost.push_back(
                {std::string(format.name),
                 fmt::format(
                     "{} not written: this format does not support them; {} do", things,
                     keepers(word))});
        }
    };
    std::set<std::uint32_t> materials;
    for (const Region& region : scene.regions()) {
        materials.insert(region.material.value);
    }
    std::size_t labelled = 0;
    for (const Organ& organ : scene.organs()) {
        labelled += organ.labels.empty() ? 0 : 1;
    }
    // The name of a single material need not be stored. Species of Caribu are numbers of materials.
    if (materials.size() > 1 && format.keeps.find("species") == format.keeps.npos) {
        add(true, fmt::format("names of {} materials are", materials.size()), "material");
    }
    add(labelled > 0, fmt::format("labels of {} are", counted(labelled, "organ")), "labels");
    return lost;
}

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
        throw InputError({{path, "contains no triangle", "", ""}});
    }
    SceneBuilder builder({{"none"}});
    add_materials(file, builder);
    if (format.organs == "each") {
        add_triangles(file, builder);
    } else {
        add_groups(std::move(file), builder);
    }
    Scene scene = std::move(builder).build();
    std::vector<Warning> warnings = fold_warnings(std::move(reporter.warnings), lint(scene));
    return {
        std::move(scene), std::move(warnings), files.files(),
        format.has_units ? context.length_unit : ""};
}

}  // namespace quasimc

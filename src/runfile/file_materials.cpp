#include "runfile/file_materials.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace quasimc {
namespace {

std::set<std::string> used_names(const MeshFile& mesh) {
    std::set<std::string> names;
    for (const MeshGroup& group : mesh.groups) {
        for (const MeshPart& part : group.parts) {
            names.insert(part.material);
        }
    }
    return names;
}

/// Materials that a file defines, by name; the first of each name.
using Definitions = std::map<std::string_view, const MeshMaterial*>;

Definitions definitions_of(const MeshFile& mesh) {
    Definitions definitions;
    for (const MeshMaterial& material : mesh.materials) {
        if (!material.name.empty()) {
            definitions.emplace(material.name, &material);
        }
    }
    return definitions;
}

/// The material with a name, or null.
const MeshMaterial* definition_of(const std::string& name, const Definitions& definitions) {
    const auto found = definitions.find(name);
    return found == definitions.end() ? nullptr : found->second;
}

/// Describes the optics of a material in its file, which the run file does not define.
std::string describe_optics(const MeshMaterial& material) {
    if (!material.has_optics) {
        return "its library has no colour, and black is used";
    }
    return fmt::format(
        "{} gives reflectance {:.4g}, transmittance {:.4g} in every band",
        material.is_color ? "its diffuse colour" : "that file", material.reflectance,
        material.transmittance);
}

std::pair<double, double> optics_of(const MeshMaterial& material) {
    return {material.reflectance, material.transmittance};
}

MaterialSpec spec_of(std::string name, const MeshMaterial& material, std::size_t bands) {
    SideOptics side;
    side.reflectance = material.reflectance;
    side.transmittance = material.transmittance;
    const std::vector<SideOptics> sides(bands, side);
    return {std::move(name), sides, sides};
}

/// The first few of many, and the number of the others.
std::string listed(const std::vector<std::string>& words, std::string_view separator) {
    constexpr std::size_t kShown = 3;
    const auto end = words.begin() + static_cast<std::ptrdiff_t>(std::min(words.size(), kShown));
    const std::string first =
        fmt::format("{}", fmt::join(std::vector<std::string>(words.begin(), end), separator));
    return words.size() <= kShown
               ? first
               : fmt::format("{}{}and {} more", first, separator, words.size() - kShown);
}

}  // namespace

/// The materials of a file, and the data for warnings about them.
struct FileMaterials::Search {
    const GeometryFile& file;
    TableReader& table;
    SceneBuilder& builder;
    Definitions by_name;
    /// Names known and unknown to the run file, where `material` is for the others.
    std::vector<std::string> known, unknown;
    /// Names of materials that the file defines, and their optics.
    std::vector<std::string> defined;
    std::vector<std::string> definitions;
    std::size_t renamed = 0;

    void warn(std::string text) { table.warn(std::move(text)); }
    void warn_of_definitions();
    void warn_of_unknown();
    void warn_of_unmatched_keys();
};

void FileMaterials::Search::warn_of_definitions() {
    if (defined.empty()) {
        return;
    }
    const std::string clash =
        renamed == 0
            ? ""
            : fmt::format(
                  "; results call {} '{} ...', as other files have other materials of "
                  "the same name",
                  defined.size() == 1 ? "it" : fmt::format("{} of them", renamed), file.name);
    if (defined.size() == 1) {
        warn(fmt::format(
            "the scene has no material '{}' of {}; {}{}", defined[0], file.name, definitions[0],
            clash));
        return;
    }
    std::vector<std::string> words;
    for (std::size_t i = 0; i < defined.size(); ++i) {
        words.push_back(fmt::format("of '{}' {}", defined[i], definitions[i]));
    }
    warn(fmt::format(
        "the scene lacks {} materials of {}; {}{}", defined.size(), file.name, listed(words, "; "),
        clash));
}

/// Warns of keys of `materials` that the file does not use.
void FileMaterials::Search::warn_of_unmatched_keys() {
    const std::set<std::string> used = used_names(file.mesh);
    const auto is_used = [&](const std::string& name) {
        return used.contains(name) || std::any_of(
                                          file.mesh.aliases.begin(), file.mesh.aliases.end(),
                                          [&](const auto& alias) { return alias.second == name; });
    };
    for (const auto& [name, run_name] : file.keys.by_file_name) {
        if (!is_used(name)) {
            warn(fmt::format("materials contains '{}', which {} does not use", name, file.name));
        }
    }
}

/// Warns of materials that are unknown to the run file; if all are, `material` is meant for all.
void FileMaterials::Search::warn_of_unknown() {
    if (known.empty() || unknown.empty()) {
        return;
    }
    warn(
        unknown.size() == 1
            ? fmt::format(
                  "the scene has no material '{}' of {}; '{}' is used", unknown[0], file.name,
                  *file.keys.material)
            : fmt::format(
                  "the scene lacks {} materials of {} ('{}'); '{}' is used", unknown.size(),
                  file.name, listed(unknown, "', '"), *file.keys.material));
}

std::optional<std::string> FileMaterials::from_run_file(
    const GeometryFile& file, const std::string& name) {
    const auto alias = file.mesh.aliases.find(name);
    const std::string& other = alias == file.mesh.aliases.end() ? name : alias->second;
    for (const std::string* each : {&name, &other}) {
        const auto mapped = file.keys.by_file_name.find(*each);
        if (mapped != file.keys.by_file_name.end()) {
            return mapped->second;
        }
    }
    const std::string of_file = file.name + " ";
    for (const std::string& each : {of_file + name, of_file + other, name, other}) {
        if (!each.empty() && context_.materials.contains(each)) {
            matched_.insert(each);
            return each;
        }
    }
    return std::nullopt;
}

void FileMaterials::note(const GeometryFile& file) {
    const Definitions definitions = definitions_of(file.mesh);
    for (const std::string& name : used_names(file.mesh)) {
        const MeshMaterial* material = definition_of(name, definitions);
        // Materials of the run file for this file alone do not affect names of others.
        const std::optional<std::string> given = from_run_file(file, name);
        const bool is_of_all = given && *given != file.name + " " + name;
        if (material != nullptr && !file.keys.material && !is_of_all) {
            defined_[name].insert(optics_of(*material));
        }
    }
}

std::string FileMaterials::name_of(const std::string& file, const MeshMaterial& material) const {
    std::string name = material.name;
    const auto is_taken = [&] {
        const auto plain = defined_.find(name);
        const auto added = added_.find(name);
        return (plain != defined_.end() && plain->second != std::set{optics_of(material)}) ||
               (added != added_.end() && added->second != optics_of(material));
    };
    while (is_taken()) {
        name = fmt::format("{} {}", file, name);
    }
    return name;
}

std::string FileMaterials::find_one(Search& search, const std::string& name) {
    const GeometryFile& file = search.file;
    if (auto given = from_run_file(file, name)) {
        search.known.push_back(name);
        return std::move(*given);
    }
    if (file.keys.material) {
        if (!name.empty()) {
            search.unknown.push_back(name);
        }
        return *file.keys.material;
    }
    const MeshMaterial* material = definition_of(name, search.by_name);
    if (material == nullptr) {
        return missing(search, name);
    }
    std::string run_name = name_of(file.name, *material);
    search.renamed += run_name == name ? 0 : 1;
    search.defined.push_back(name);
    search.definitions.push_back(describe_optics(*material));
    if (added_.emplace(run_name, optics_of(*material)).second) {
        search.builder.add_material(
            spec_of(run_name, *material, context_.bands.size()), search.table.where());
    }
    return run_name;
}

std::string FileMaterials::missing(Search& search, const std::string& name) const {
    const std::string& file = search.file.name;
    if (name.empty()) {
        search.table.fault(
            fmt::format("{} has triangles without a material", file), "", "add material = \"...\"");
    } else {
        search.table.fault(
            fmt::format("the scene has no material '{}' of {}", name, file), "",
            fmt::format(
                "add a material of that name, or materials = {{ \"{}\" = \"...\" }}", name));
    }
    // Any other one, to avoid a further fault that "" does not exist.
    return context_.materials.empty() ? "" : *context_.materials.begin();
}

FoundMaterials FileMaterials::find(
    const GeometryFile& file, TableReader& table, SceneBuilder& builder) {
    Search search{file, table, builder, definitions_of(file.mesh), {}, {}, {}, {}};
    FoundMaterials found;
    for (const std::string& name : used_names(file.mesh)) {
        found[name] = find_one(search, name);
    }
    search.warn_of_definitions();
    search.warn_of_unknown();
    search.warn_of_unmatched_keys();
    return found;
}

void FileMaterials::warn_of_unmatched(Reporter& reporter) const {
    for (const std::string& given : context_.materials) {
        const auto is_meant = [&](const auto& defined) {
            return !defined.first.empty() && given.ends_with(" " + defined.first);
        };
        if (!matched_.contains(given) && std::any_of(defined_.begin(), defined_.end(), is_meant)) {
            reporter.warn(fmt::format(
                "no file of geometry has the material '{}': a material of one file is called by "
                "the path as it is given, a blank, and its name",
                given));
        }
    }
}

}  // namespace quasimc

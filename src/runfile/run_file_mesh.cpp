#include <fmt/format.h>

#include "base/length_units.h"
#include "base/text.h"
#include "runfile/run_file_sections.h"

namespace quasimc {
namespace {

const FormatEntry* read_format(TableReader& table, const std::string& file) {
    std::vector<std::string_view> names;
    for (const FormatEntry& entry : format_table()) {
        names.push_back(entry.name);
    }
    if (table.any("format") != nullptr) {
        const auto name = table.choice("format", names);
        return name ? find_format(*name) : nullptr;
    }
    const FormatEntry* entry = format_of_path(file);
    if (const ForeignFormat* foreign = foreign_format_of_path(file); foreign != nullptr) {
        table.fault_at(
            "file", fmt::format("'{}' is {}, which is not supported", file, foreign->name), "",
            std::string(foreign->advice));
    } else if (entry == nullptr && !file.empty()) {
        table.fault_at(
            "file", fmt::format("the format of '{}' is unclear from its name", file),
            fmt::format("supported formats are {}", joined(names, ", ")),
            "add format if it is one of them, or convert the file");
    }
    return entry;
}

std::size_t triangle_count(const MeshFile& mesh) {
    std::size_t count = 0;
    for (const MeshGroup& group : mesh.groups) {
        for (const MeshPart& part : group.parts) {
            count += part.faces.size();
        }
    }
    return count;
}

/// Reads the file; empty after a fault.
std::optional<MeshFile> read_bytes(
    TableReader& table,
    const std::string& file,
    const FormatEntry& format,
    std::optional<double> plant_metres,
    const RunFileContext& context) {
    Reporter reporter{file, {}, {}};
    const MeshCache::Key key{
        file, std::string(format.name), context.orientation.up(), context.length_unit,
        plant_metres};
    if (const auto known = context.meshes != nullptr ? context.meshes->find(key) : nullptr) {
        reporter.warnings = known->warnings;
        table.reporter().add(reporter);
        return known->mesh;
    }
    MeshFile mesh;
    try {
        const std::string bytes = context.files->read(file);
        const std::size_t slash = file.rfind('/');
        FormatContext inner{
            reporter,
            *context.files,
            slash == std::string::npos ? "" : file.substr(0, slash + 1),
            context.orientation.up(),
            context.length_unit,
            plant_metres};
        mesh = read_mesh(format, bytes, inner);
    } catch (const InputError& error) {
        table.fault_at(
            "file", fmt::format("file '{}' can't be read", file), error.faults().front().why);
        return std::nullopt;
    }
    if (triangle_count(mesh) == 0 && reporter.faults.empty()) {
        table.fault_at("file", fmt::format("file '{}' contains no triangle", file));
    }
    table.reporter().add(reporter);
    if (table.failed()) {
        return std::nullopt;
    }
    if (context.meshes != nullptr) {
        context.meshes->add(
            key,
            std::make_shared<const MeshCache::Parsed>(MeshCache::Parsed{mesh, reporter.warnings}));
    }
    return mesh;
}

/// Reads `plant_unit`: metres per unit of the plants in a scene of plants. Empty if it is absent.
std::optional<double> read_plant_unit(TableReader& table, const FormatEntry* format) {
    const Node* node = table.any("plant_unit");
    if (node == nullptr) {
        return std::nullopt;
    }
    if (format != nullptr && format->read != read_ops) {
        table.fault_at(
            *node, "plant_unit is given", "it is for the plants that a scene (.ops) names",
            "use transform = { scale = ... } to scale another file");
    }
    constexpr Range kMetres{1e-9, 1e9};
    if (node->as<std::string>() == nullptr) {
        return table.real_at("plant_unit", *node, kMetres);
    }
    const std::string& name = *node->as<std::string>();
    const std::optional<double> metres = metres_per(name);
    if (!metres) {
        table.fault_at(
            *node, fmt::format("plant_unit is '{}'", name), "no such unit of length",
            "use \"m\", \"cm\", \"mm\", or a number of metres");
    }
    return metres;
}

}  // namespace

std::optional<NamedMesh> read_named_mesh(TableReader& table, RunFileContext& context) {
    const std::optional<std::string> file = table.required("file", table.text("file"));
    std::vector<NamedMesh> read =
        read_named_meshes(table, std::vector<std::string>{file.value_or("")}, context);
    return file && !read.empty() ? std::optional(std::move(read.front())) : std::nullopt;
}

std::vector<NamedMesh> read_named_meshes(
    TableReader& table, const std::vector<std::string>& files, RunFileContext& context) {
    const FormatEntry* format = read_format(table, files.front());
    const std::optional<double> plant_metres = read_plant_unit(table, format);
    const Node* node = table.any("file");
    if (node != nullptr && node->as<std::string>() != nullptr && files.front().empty()) {
        table.fault_at("file", "file is empty", "give the name of a file");
    }
    std::vector<NamedMesh> meshes;
    for (const std::string& file : files) {
        const FormatEntry* own = file == files.front() ? format : read_format(table, file);
        if (own == nullptr || file.empty()) {
            return {};
        }
        std::optional<MeshFile> mesh = read_bytes(table, file, *own, plant_metres, context);
        if (!mesh) {
            return {};
        }
        meshes.push_back({file, own, std::move(*mesh)});
    }
    return meshes;
}

}  // namespace quasimc

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "meshio/file_axes.h"
#include "runfile/copies.h"
#include "runfile/file_materials.h"
#include "runfile/geometry_organs.h"
#include "runfile/labels_from.h"
#include "runfile/run_file_sections.h"

namespace quasimc {
namespace {

constexpr std::array<std::string_view, 3> kOrganWords{"each", "groups", "one"};

std::map<std::string, std::string> read_material_map(TableReader& table) {
    std::map<std::string, std::string> result;
    const Node* node = table.any("materials");
    const auto* members = node ? node->as<Node::Table>() : nullptr;
    if (node != nullptr && members == nullptr) {
        table.fault_at(
            *node, fmt::format("materials is {}", node->type_name()),
            "it must be a table: name in the file = \"name of a material\"");
    }
    for (std::size_t i = 0; members && i < members->size(); ++i) {
        const Member& member = (*members)[i];
        if (const auto* text = member.node.as<std::string>()) {
            result[member.key] = *text;
        } else {
            table.fault_at(
                member.node, fmt::format("materials.{} is {}", member.key, member.node.type_name()),
                "it must be the name of a material");
        }
    }
    return result;
}

/// A table and the files that it names.
struct Geometry {
    TableReader table;
    GeometryKeys keys;
    std::vector<GeometryFile> files;
};

/// Warns of a scale that is correct only if plants are in the unit of their positions.
void warn_of_second_scale(const Affine& transform, const NamedMesh& named, TableReader& table) {
    constexpr double kRounding = 1e-6;
    const bool is_scaled = std::abs(std::abs(determinant(transform)) - 1) > kRounding;
    if (is_scaled && named.format->read == read_ops && table.any("plant_unit") == nullptr) {
        table.warn(fmt::format(
            "transform scales the plants and positions of {} again: its plants have been converted "
            "from centimetres; remove the scale or give plant_unit",
            named.file));
    }
}

/// The names of files, each once. @returns the index of the file of each name
std::vector<std::size_t> make_unique(std::vector<std::string>& names) {
    std::vector<std::string> unique;
    std::vector<std::size_t> indices;
    for (std::string& name : names) {
        const auto known = std::find(unique.begin(), unique.end(), name);
        indices.push_back(static_cast<std::size_t>(known - unique.begin()));
        if (known == unique.end()) {
            unique.push_back(std::move(name));
        }
    }
    names = std::move(unique);
    return indices;
}

/// Reads `at` with the texts that may have placeholders: sets the copies, and the names of their
/// files, each once.
void read_file_copies(
    TableReader& table,
    const std::string& name,
    RunFileContext& context,
    GeometryKeys& keys,
    std::vector<std::string>& files) {
    const Labels labels = read_labels(table);
    const auto copies = read_copies(table, name.empty() ? files.front() : name, context);
    keys.has_copies = table.any("at") != nullptr;
    if (!keys.has_copies) {
        keys.copies = {{.name = name, .labels = labels}};
    }
    if (!copies) {
        return;
    }
    CopyTexts texts(table, *copies);
    std::vector<std::string> file_of_copy = texts.fill("file", files.front());
    std::vector<Labels> labels_of_copy = texts.labels(labels);
    std::vector<std::string> name_of_copy = texts.names(name, "copy");
    if (file_of_copy.empty() || name_of_copy.empty()) {
        return;
    }
    files = std::move(file_of_copy);
    const std::vector<std::size_t> file_index = make_unique(files);
    for (std::size_t i = 0; i < copies->size(); ++i) {
        keys.copies.push_back(
            {std::move(name_of_copy[i]), std::move(labels_of_copy[i]), (*copies)[i].transform,
             file_index[i]});
    }
}

/// Moves the vertices of a file by the `transform` of its table.
void transform_file(const std::optional<Affine>& transform, NamedMesh& named, TableReader& table) {
    if (transform) {
        warn_of_second_scale(*transform, named, table);
        move_points(*transform, named.mesh.vertices);
    }
}

/// Sets labels by the names in the files, unless they are organs as a whole.
void set_labels_of_groups(
    const LabelsFrom& labels_from,
    const std::optional<std::string>& organs,
    std::vector<NamedMesh>& named,
    TableReader& table) {
    if (organs == "one") {
        table.fault_at(
            "labels_from", "labels_from with organs = \"one\"",
            "names belong to the groups of a file, and the file is one organ",
            "remove one of them");
    } else if (!named.empty()) {
        set_labels_from(labels_from, named, table);
    }
}

/// Reads one table; empty after a fault.
std::optional<Geometry> read_one(const Node& node, RunFileContext& context) {
    constexpr Range kFirstId{-1e15, 1e15};
    TableReader table(node, "geometry", *context.reporter);
    GeometryKeys keys;
    const std::string name = table.text("name").value_or("");
    const MaterialKeys materials{table.text("material"), read_material_map(table)};
    keys.first_id = table.integer("first_id", kFirstId);
    if (!name.empty()) {
        table.rename(fmt::format("geometry '{}'", name));
    }
    keys.measured = table.boolean("measured").value_or(true);
    const std::optional<Affine> transform = read_transform(table);
    std::vector<std::string> files{table.required("file", table.text("file")).value_or("")};
    read_file_copies(table, name, context, keys, files);
    const std::optional<std::string> organs = table.choice("organs", kOrganWords);
    const std::optional<LabelsFrom> labels_from = read_labels_from(table, *context.files);
    std::vector<NamedMesh> named;
    if (keys.copies.empty() && !placeholders_of(files.front()).empty()) {
        // The names of the files are unknown.
        static_cast<void>(table.any("format"));
        static_cast<void>(table.any("plant_unit"));
    } else {
        named = read_named_meshes(table, files, context);
    }
    if (labels_from) {
        check_keys(*labels_from, keys.copies, table);
        set_labels_of_groups(*labels_from, organs, named, table);
    }
    table.finish();
    if (named.empty() || table.failed()) {
        return std::nullopt;
    }
    keys.organs = organs.value_or(std::string(named.front().format->organs));
    std::vector<GeometryFile> read;
    for (NamedMesh& each : named) {
        transform_file(transform, each, table);
        read.push_back({each.file, std::move(each.mesh), materials});
    }
    return Geometry{std::move(table), std::move(keys), std::move(read)};
}

}  // namespace

void read_geometry(TableReader& top, RunFileContext& context, SceneBuilder& builder) {
    std::vector<Geometry> all;
    for (const Node* node : top.tables("geometry")) {
        if (std::optional<Geometry> geometry = read_one(*node, context)) {
            all.push_back(std::move(*geometry));
        }
    }
    // Names follow from the materials of all files, so that the order of the tables does not
    // matter.
    FileMaterials materials(context);
    for (const Geometry& geometry : all) {
        for (const GeometryFile& file : geometry.files) {
            materials.note(file);
        }
    }
    for (Geometry& geometry : all) {
        std::vector<FileOfTable> files;
        for (GeometryFile& file : geometry.files) {
            FoundMaterials found = materials.find(file, geometry.table, builder);
            files.push_back({file.name, std::move(file.mesh), std::move(found)});
        }
        add_geometry(geometry.keys, std::move(files), builder);
    }
    materials.warn_of_unmatched(top.reporter());
}

}  // namespace quasimc

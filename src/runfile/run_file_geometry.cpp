#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "meshio/file_axes.h"
#include "runfile/file_materials.h"
#include "runfile/run_file_sections.h"

namespace quasimc {
namespace {

constexpr std::array<std::string_view, 3> kOrganWords{"each", "groups", "one"};

/// The keys of a [[geometry]] table for the organs of its file.
struct GeometryKeys {
    std::string file, name, organs;
    Labels labels;
    std::optional<std::int64_t> first_id;
    std::optional<Affine> transform;
    /// Transforms of copies, after `transform`; empty: one copy without a transform.
    std::vector<Affine> copies;
};

std::map<std::string, std::string> read_material_map(TableReader& table) {
    std::map<std::string, std::string> result;
    const Node* node = table.any("materials");
    const auto* members = node ? node->as<Node::Table>() : nullptr;
    if (node != nullptr && members == nullptr) {
        table.fault_at(
            *node, fmt::format("materials is {}", node->type_name()),
            "it must be a table: name in the file = \"name of a [[material]]\"");
    }
    for (std::size_t i = 0; members && i < members->size(); ++i) {
        const Member& member = (*members)[i];
        if (const auto* text = member.node.as<std::string>()) {
            result[member.key] = *text;
        } else {
            table.fault_at(
                member.node, fmt::format("materials.{} is {}", member.key, member.node.type_name()),
                "it must be the name of a [[material]]");
        }
    }
    return result;
}

/// Adds the organs of a file to the builder.
class OrganAdder {
  public:
    OrganAdder(const GeometryKeys& keys, const FoundMaterials& materials, SceneBuilder& builder)
        : keys_(keys), materials_(materials), builder_(builder) {}

    void add(MeshFile file) {
        line_word_ = file.line_word;
        if (keys_.organs == "each") {
            add_each_triangle(file);
            return;
        }
        if (keys_.organs == "one" && !keys_.copies.empty()) {
            file.groups = {merged(std::move(file.groups))};
        }
        std::vector<Mesh> meshes = file.take_meshes();
        if (keys_.copies.empty()) {
            add_organs(file.groups, [&](std::size_t part) {
                return OrganPart{"", std::move(meshes[part]), {}, {}};
            });
            return;
        }
        std::vector<std::shared_ptr<const Mesh>> shared;
        shared.reserve(meshes.size());
        for (Mesh& mesh : meshes) {
            shared.push_back(std::make_shared<const Mesh>(std::move(mesh)));
        }
        for (const Affine& copy : keys_.copies) {
            ++copy_;
            add_organs(file.groups, [&](std::size_t part) {
                return OrganPart{"", {}, shared[part], copy};
            });
        }
    }

  private:
    /// Merges groups into one with one part per material, as few large meshes are faster to copy.
    static MeshGroup merged(std::vector<MeshGroup> groups) {
        MeshGroup all;
        for (MeshGroup& group : groups) {
            for (MeshPart& part : group.parts) {
                const auto known = std::find_if(
                    all.parts.begin(), all.parts.end(),
                    [&](const MeshPart& other) { return other.material == part.material; });
                if (known == all.parts.end()) {
                    all.parts.push_back(std::move(part));
                    continue;
                }
                known->faces.insert(known->faces.end(), part.faces.begin(), part.faces.end());
                known->lines.insert(known->lines.end(), part.lines.begin(), part.lines.end());
            }
        }
        return all;
    }

    void add_each_triangle(const MeshFile& file) {
        const std::vector<Affine> once(1);
        for (const Affine& copy : keys_.copies.empty() ? once : keys_.copies) {
            for (const MeshGroup& group : file.groups) {
                for (const MeshPart& part : group.parts) {
                    add_triangles(file, group.labels, part, copy);
                }
            }
        }
    }

    void add_triangles(
        const MeshFile& file, const Labels& labels, const MeshPart& part, const Affine& copy) {
        const std::string material = materials_.at(part.material);
        for (std::size_t i = 0; i < part.faces.size(); ++i) {
            ++count_;
            OrganSpec organ =
                make_organ({}, keys_.name.empty() ? "" : fmt::format("{} {}", keys_.name, count_));
            add_labels(labels, organ);
            organ.where = where(part.lines[i]);
            std::vector<Triangle> triangle{file.triangle(part, i)};
            if (!keys_.copies.empty()) {
                move_triangles(copy, triangle);
            }
            organ.parts.push_back({material, triangle});
            builder_.add_organ(std::move(organ));
        }
    }

    /// @param make_part  makes a part by its index over all groups
    template <typename MakePart>
    void add_organs(const std::vector<MeshGroup>& groups, const MakePart& make_part) {
        std::size_t number = 0;
        const auto add_parts = [&](const MeshGroup& group, OrganSpec& organ) {
            for (const MeshPart& part : group.parts) {
                organ.parts.push_back(make_part(number++));
                organ.parts.back().material = materials_.at(part.material);
            }
        };
        if (keys_.organs == "one") {
            ++count_;
            OrganSpec organ = make_organ({}, name_of(""));
            organ.where = keys_.file;
            for (const MeshGroup& group : groups) {
                add_parts(group, organ);
            }
            builder_.add_organ(std::move(organ));
            return;
        }
        for (const MeshGroup& group : groups) {
            ++count_;
            OrganSpec organ = make_organ(group.id, name_of(group.name));
            organ.where = where(group.parts.front().lines.front());
            add_labels(group.labels, organ);
            add_parts(group, organ);
            builder_.add_organ(std::move(organ));
        }
    }

    /// The given name, the number of the copy if there are several, and the name in the file.
    [[nodiscard]] std::string name_of(const std::string& group) const {
        std::string name = keys_.name;
        if (!keys_.copies.empty()) {
            name = fmt::format("{} {}", name.empty() ? "copy" : name, copy_);
        }
        return name + (name.empty() || group.empty() ? "" : " ") + group;
    }

    /// An organ without parts, with the id in the file, unless the run file numbers organs or there
    /// are copies.
    [[nodiscard]] OrganSpec make_organ(std::optional<std::int64_t> id, std::string name) const {
        OrganSpec organ;
        organ.id = keys_.first_id         ? std::optional(*keys_.first_id + count_ - 1)
                   : keys_.copies.empty() ? id
                                          : std::nullopt;
        organ.name = std::move(name);
        organ.labels = keys_.labels;
        return organ;
    }

    /// Adds the labels of the file, except those that the run file gives.
    void add_labels(const Labels& labels, OrganSpec& organ) const {
        for (const auto& label : labels) {
            const auto is_same = [&](const auto& given) { return given.first == label.first; };
            if (std::none_of(keys_.labels.begin(), keys_.labels.end(), is_same)) {
                organ.labels.push_back(label);
            }
        }
    }

    [[nodiscard]] std::string where(std::uint32_t line) const {
        return line_word_ == "line" ? fmt::format("{}:{}", keys_.file, line)
                                    : fmt::format("{}: {} {}", keys_.file, line_word_, line);
    }

    const GeometryKeys& keys_;
    std::string_view line_word_;
    const FoundMaterials& materials_;
    SceneBuilder& builder_;
    std::int64_t count_ = 0, copy_ = 0;
};

/// A table and the file that it names.
struct Geometry {
    TableReader table;
    GeometryKeys keys;
    GeometryFile file;
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

/// Reads one table; empty after a fault.
std::optional<Geometry> read_one(const Node& node, RunFileContext& context) {
    constexpr Range kFirstId{-1e15, 1e15};
    TableReader table(node, "geometry", *context.reporter);
    GeometryKeys keys;
    keys.name = table.text("name").value_or("");
    keys.labels = read_labels(table);
    GeometryFile file;
    file.keys = {table.text("material"), read_material_map(table)};
    keys.first_id = table.integer("first_id", kFirstId);
    keys.transform = read_transform(table);
    keys.copies = read_copies(table, context.orientation).value_or(std::vector<Affine>());
    const std::optional<std::string> organs = table.choice("organs", kOrganWords);
    std::optional<NamedMesh> named = read_named_mesh(table, context);
    table.finish();
    if (!named || table.failed()) {
        return std::nullopt;
    }
    keys.file = file.name = named->file;
    keys.organs = organs.value_or(std::string(named->format->organs));
    if (keys.transform) {
        warn_of_second_scale(*keys.transform, *named, table);
        move_points(*keys.transform, named->mesh.vertices);
    }
    file.mesh = std::move(named->mesh);
    return Geometry{std::move(table), std::move(keys), std::move(file)};
}

}  // namespace

void read_geometry(TableReader& top, RunFileContext& context, SceneBuilder& builder) {
    if (context.meshes != nullptr) {
        context.meshes->start_point();
    }
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
        materials.note(geometry.file);
    }
    for (Geometry& geometry : all) {
        const FoundMaterials found = materials.find(geometry.file, geometry.table, builder);
        OrganAdder(geometry.keys, found, builder).add(std::move(geometry.file.mesh));
    }
    materials.warn_of_unmatched(top.reporter());
}

}  // namespace quasimc

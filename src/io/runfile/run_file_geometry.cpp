#include <array>
#include <map>

#include <fmt/format.h>

#include "base/text.h"
#include "io/runfile/run_file_sections.h"

namespace quasimc {
namespace {

constexpr std::array<std::string_view, 3> kOrganWords{"each", "groups", "one"};

/// What a [[geometry]] table states of the organs of its file.
struct GeometryKeys {
    std::string file, name, organs;
    Labels labels;
    std::optional<std::string> material;
    std::map<std::string, std::string> materials;
    std::optional<std::int64_t> first_id;
    std::optional<Affine> transform;
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

/// Finds the materials of the run for those of a file.
class MaterialFinder {
  public:
    MaterialFinder(
        const GeometryKeys& keys,
        const MeshFile& mesh,
        TableReader& table,
        RunFileContext& context,
        SceneBuilder& builder)
        : keys_(keys), mesh_(mesh), table_(table), context_(context), builder_(builder) {}

    /// The run's name of a file's material; a fault, once, if there is none.
    std::string find(const std::string& name) {
        const auto [entry, is_new] = found_.try_emplace(name);
        if (is_new) {
            entry->second = find_new(name);
        }
        return entry->second;
    }

  private:
    std::string find_new(const std::string& name) {
        if (const auto mapped = keys_.materials.find(name); mapped != keys_.materials.end()) {
            return mapped->second;
        }
        if (!name.empty() && context_.materials.contains(name)) {
            return name;
        }
        if (keys_.material) {
            if (!name.empty()) {
                warn(fmt::format(
                    "material '{}' of {} is not in the run file; '{}' is used", name, keys_.file,
                    *keys_.material));
            }
            return *keys_.material;
        }
        for (const MeshMaterial& material : mesh_.materials) {
            if (!name.empty() && material.name == name) {
                return add_from_library(material);
            }
        }
        if (name.empty()) {
            table_.fault(
                fmt::format("{} names no material for its triangles", keys_.file), "",
                "add material = \"...\"");
        } else {
            table_.fault(
                fmt::format("material '{}' of {} is not in the run file", name, keys_.file), "",
                fmt::format(
                    "add a [[material]] of that name, or materials = {{ \"{}\" = \"...\" }}",
                    name));
        }
        // Any other one, so that nobody is told besides that "" does not exist.
        return context_.materials.empty() ? "" : *context_.materials.begin();
    }

    std::string add_from_library(const MeshMaterial& material) {
        warn(fmt::format(
            "material '{}' of {} is not in the run file; its diffuse colour gives reflectance "
            "{:.4g}, "
            "transmittance 0 in every band",
            material.name, keys_.file, material.reflectance));
        SideOptics side;
        side.reflectance = material.reflectance;
        const std::vector<SideOptics> sides(context_.bands.size(), side);
        builder_.add_material({material.name, sides, sides}, table_.place());
        context_.materials.insert(material.name);
        return material.name;
    }

    void warn(std::string text) {
        context_.reporter->warnings.push_back({table_.place(), std::move(text)});
    }

    const GeometryKeys& keys_;
    const MeshFile& mesh_;
    TableReader& table_;
    RunFileContext& context_;
    SceneBuilder& builder_;
    std::map<std::string, std::string> found_;
};

/// Adds the organs of a file to the builder.
class OrganAdder {
  public:
    OrganAdder(
        const GeometryKeys& keys,
        std::string_view line_word,
        MaterialFinder& materials,
        SceneBuilder& builder)
        : keys_(keys), line_word_(line_word), materials_(materials), builder_(builder) {}

    void add(std::vector<MeshGroup> groups) {
        if (keys_.organs == "one") {
            add_all_as_one(std::move(groups));
            return;
        }
        for (MeshGroup& group : groups) {
            if (keys_.organs == "each") {
                add_each_triangle(group);
            } else {
                add_group(std::move(group));
            }
        }
    }

  private:
    void add_each_triangle(const MeshGroup& group) {
        for (const MeshPart& part : group.parts) {
            const std::string material = materials_.find(part.material);
            for (std::size_t i = 0; i < part.triangles.size(); ++i) {
                ++count_;
                OrganSpec organ = make_organ(
                    {}, keys_.name.empty() ? "" : fmt::format("{} {}", keys_.name, count_));
                organ.place = place(part.lines[i]);
                organ.parts.push_back({material, std::vector<Triangle>(1, part.triangles[i])});
                builder_.add_organ(std::move(organ));
            }
        }
    }

    void add_group(MeshGroup group) {
        ++count_;
        const std::string separator = keys_.name.empty() || group.name.empty() ? "" : " ";
        std::string name = keys_.name + separator + group.name;
        OrganSpec organ = make_organ(group.id, std::move(name));
        organ.place = place(group.parts.front().lines.front());
        for (MeshPart& part : group.parts) {
            organ.parts.push_back({materials_.find(part.material), std::move(part.triangles)});
        }
        builder_.add_organ(std::move(organ));
    }

    void add_all_as_one(std::vector<MeshGroup> groups) {
        ++count_;
        OrganSpec organ = make_organ({}, keys_.name);
        organ.place = keys_.file;
        for (MeshGroup& group : groups) {
            for (MeshPart& part : group.parts) {
                organ.parts.push_back({materials_.find(part.material), std::move(part.triangles)});
            }
        }
        builder_.add_organ(std::move(organ));
    }

    /// An organ without parts; its id is the file's, unless the run file numbers them.
    [[nodiscard]] OrganSpec make_organ(std::optional<std::int64_t> id, std::string name) const {
        OrganSpec organ;
        organ.id = keys_.first_id ? std::optional(*keys_.first_id + count_ - 1) : id;
        organ.name = std::move(name);
        organ.labels = keys_.labels;
        return organ;
    }

    [[nodiscard]] std::string place(std::uint32_t line) const {
        return line_word_ == "line" ? fmt::format("{}:{}", keys_.file, line)
                                    : fmt::format("{}: {} {}", keys_.file, line_word_, line);
    }

    const GeometryKeys& keys_;
    std::string_view line_word_;
    MaterialFinder& materials_;
    SceneBuilder& builder_;
    std::int64_t count_ = 0;
};

void read_one(const Node& node, RunFileContext& context, SceneBuilder& builder) {
    constexpr Range kFirstId{-1e15, 1e15};
    TableReader table(node, "geometry", *context.reporter);
    GeometryKeys keys;
    keys.name = table.text("name").value_or("");
    keys.labels = read_labels(table);
    keys.material = table.text("material");
    keys.materials = read_material_map(table);
    keys.first_id = table.integer("first_id", kFirstId);
    keys.transform = read_transform(table);
    const std::optional<std::string> organs = table.choice("organs", kOrganWords);
    std::optional<NamedMesh> named = read_named_mesh(table, context);
    table.finish();
    if (!named || table.failed()) {
        return;
    }
    keys.file = named->file;
    keys.organs = organs.value_or(std::string(named->format->organs));
    if (keys.transform) {
        for (MeshGroup& group : named->mesh.groups) {
            for (MeshPart& part : group.parts) {
                move_triangles(*keys.transform, part.triangles);
            }
        }
    }
    MaterialFinder materials(keys, named->mesh, table, context, builder);
    OrganAdder(keys, named->mesh.line_word, materials, builder).add(std::move(named->mesh.groups));
}

}  // namespace

void read_geometry(TableReader& top, RunFileContext& context, SceneBuilder& builder) {
    for (const Node* node : top.tables("geometry")) {
        read_one(*node, context, builder);
    }
}

}  // namespace quasimc
